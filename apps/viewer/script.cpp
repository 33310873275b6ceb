#include "viewer/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/letters.h"
#include "viewer/quoted.h"

namespace vasa::viewer {
namespace {

struct NamedKey {
  const char* name;
  Key key;
};
constexpr NamedKey kKeys[] = {
    {"space", Key::space},
    {"comma", Key::comma},
    {"period", Key::period},
    {"slash", Key::slash},
    {"escape", Key::escape},
    {"enter", Key::enter},
    {"tab", Key::tab},
    {"backspace", Key::backspace},
    {"insert", Key::insert},
    {"delete", Key::del},
    {"right", Key::right},
    {"left", Key::left},
    {"down", Key::down},
    {"up", Key::up},
    {"pageup", Key::pageUp},
    {"pagedown", Key::pageDown},
    {"home", Key::home},
    {"end", Key::end},
    {"shift", Key::leftShift},
    {"control", Key::leftControl},
    {"alt", Key::leftAlt},
    {"rightshift", Key::rightShift},
    {"rightcontrol", Key::rightControl},
    {"rightalt", Key::rightAlt},
};
constexpr const char* kButtons[] = {"left", "right", "middle"};

Key keyNamed(const std::string& given) {
  const std::string name = lowerCase(given);
  for (const NamedKey& known : kKeys)
    if (name == known.name) return known.key;
  if (name.size() == 1 && std::isalnum(static_cast<unsigned char>(name[0])))
    return keyOf(char(std::toupper(static_cast<unsigned char>(name[0]))));
  int number = 0;
  if (name.size() >= 2 && name[0] == 'f' &&
      std::from_chars(name.data() + 1, name.data() + name.size(), number).ptr == name.data() + name.size() &&
      number >= 1 && number <= 12)
    return Key(int(Key::f1) + number - 1);
  return Key::none;
}

std::string wordOf(Key key) {
  for (const NamedKey& known : kKeys)
    if (key == known.key) return known.name;
  if (int(key) < 128 && std::isalnum(int(key))) return std::string(1, char(std::tolower(int(key))));
  if (key >= Key::f1 && key <= Key::f12) return fmt::format("f{}", int(key) - int(Key::f1) + 1);
  return "";
}

std::optional<Button> buttonNamed(const std::string& name) {
  const auto found = std::ranges::find(kButtons, name);
  if (found == std::end(kButtons)) return std::nullopt;
  return Button(found - std::begin(kButtons));
}

std::vector<std::uint32_t> codepoints(const std::string& utf8) {
  std::vector<std::uint32_t> codes;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[i]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    std::uint32_t code = length == 1 ? lead : lead & (0xffu >> (length + 1));
    for (std::size_t k = 1; k < length && i + k < utf8.size(); ++k)
      code = code << 6 | (static_cast<unsigned char>(utf8[i + k]) & 0x3fu);
    codes.push_back(code);
    i += length;
  }
  return codes;
}

// The steps of one line, or what is wrong with it.
class LineReader {
 public:
  LineReader(const std::string& line, std::vector<ScriptStep>& steps) : words_(line), steps_(steps) {}

  std::string read() {
    std::string verb;
    if (!(words_ >> verb) || verb[0] == '#') return "";
    if (verb == "move") return readMove();
    if (verb == "press" || verb == "release") return readButton(verb == "press");
    if (verb == "key" || verb == "hold" || verb == "let") return readKey(verb);
    if (verb == "type") return readText();
    if (verb == "scroll") {
      Scrolled scrolled;
      return words_ >> scrolled.steps && std::isfinite(scrolled.steps) ? addEvent(scrolled)
                                                                       : "scroll wants a number of steps";
    }
    if (verb == "frames") {
      LetFrames frames;
      return words_ >> frames.count && frames.count >= 1 && frames.count <= 100000
                 ? add(frames)
                 : "frames wants a number from 1 to 100000";
    }
    if (verb == "live") {
      GoLive live;
      return words_ >> live.seconds && live.seconds > 0 && live.seconds <= 3600
                 ? add(live)
                 : "live wants seconds, 3600 at most";
    }
    if (verb == "resize") {
      ResizeWindow size;
      const bool good = words_ >> size.width >> size.height && size.width >= 1 && size.height >= 1 &&
                        size.width <= 16384 && size.height <= 16384;
      return good ? add(size) : "resize wants width and height in pixels";
    }
    if (verb == "settle") return add(Settle{});
    if (verb == "close") return addEvent(CloseAsked{});
    if (verb == "drop" || verb == "window" || verb == "picture") return readPath(verb);
    return "'" + verb + "' is nothing a script can do";
  }

 private:
  template <class Step>
  std::string add(Step step) {
    std::string more;
    if (words_ >> more) return "'" + more + "' is too much";
    steps_.emplace_back(std::move(step));
    return "";
  }
  template <class Event>
  void put(Event event) {
    steps_.emplace_back(std::in_place_type<InputEvent>, std::move(event));
  }
  template <class Event>
  std::string addEvent(Event event) {
    std::string more;
    if (words_ >> more) return "'" + more + "' is too much";
    put(std::move(event));
    return "";
  }
  std::string readMove() {
    PointerMoved moved;
    const bool good = words_ >> moved.place.x >> moved.place.y && std::isfinite(moved.place.x) &&
                      std::isfinite(moved.place.y);
    return good ? addEvent(moved) : "move wants x and y in pixels";
  }
  std::string readButton(bool down) {
    std::string name;
    words_ >> name;
    const auto button = buttonNamed(name);
    return button ? addEvent(ButtonChanged{*button, down})
                  : "'" + name + "' is no button: left, middle or right";
  }
  std::string readKey(const std::string& verb) {
    std::string name;
    words_ >> name;
    const Key key = keyNamed(name);
    if (key == Key::none) {
      std::string known;
      for (const NamedKey& each : kKeys) known += std::string(", ") + each.name;
      return "'" + name + "' is no key's name: a letter, a digit, f1 to f12" + known;
    }
    if (verb == "key") put(KeyChanged{key, true});
    return addEvent(KeyChanged{key, verb == "hold"});
  }
  std::string rest() {
    std::string text;
    std::getline(words_ >> std::ws, text);
    return text;
  }
  std::string readText() {
    std::string text;
    words_.get();  // the blank after the verb; more of them are text
    std::getline(words_, text);
    for (const std::uint32_t code : codepoints(text)) put(TextTyped{code});
    return text.empty() ? "type wants text" : "";
  }
  std::string readPath(const std::string& verb) {
    const auto name = unquotedName(rest());
    if (!name) return "quotes around a file's name are closed, and within them stand \\\\, \\\" and \\xHH";
    const std::string& path = *name;
    if (path.empty()) return verb + " wants a file";
    if (verb != "drop" && lowerCase(std::filesystem::path(path).extension().string()) != ".png")
      return verb + " writes PNG files; end the name in .png";
    if (verb == "drop")
      put(FileDropped{path});
    else
      steps_.emplace_back(SavePicture{path, verb == "window"});
    return "";
  }

  std::istringstream words_;
  std::vector<ScriptStep>& steps_;
};

std::string utf8Of(std::uint32_t code) {
  std::string text;
  if (code < 0x80) return std::string(1, char(code));
  const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  text += char((0xff00u >> (more + 1) & 0xffu) | code >> (6 * more));
  for (int k = more - 1; k >= 0; --k) text += char(0x80 | (code >> (6 * k) & 0x3f));
  return text;
}

struct EventWriter {
  std::string operator()(const PointerMoved& e) const {
    return fmt::format("move {:g} {:g}", e.place.x, e.place.y);
  }
  std::string operator()(const ButtonChanged& e) const {
    return fmt::format("{} {}", e.down ? "press" : "release", kButtons[int(e.button)]);
  }
  std::string operator()(const Scrolled& e) const { return fmt::format("scroll {:g}", e.steps); }
  std::string operator()(const KeyChanged& e) const {
    const std::string name = wordOf(e.key);
    return name.empty() ? "" : (e.down ? "hold " : "let ") + name;
  }
  std::string operator()(const TextTyped& e) const {
    const bool control = e.codepoint < 0x20 || (e.codepoint >= 0x7f && e.codepoint < 0xa0);
    return control ? "" : "type " + utf8Of(e.codepoint);  // a line end would begin a line of its own
  }
  std::string operator()(const WindowResized& e) const {
    return e.width > 0 && e.height > 0 ? fmt::format("resize {} {}", e.width, e.height) : "";
  }
  std::string operator()(const FileDropped& e) const { return "drop " + quotedName(e.path); }
  std::string operator()(const CloseAsked&) const { return "close"; }
};

struct StepWriter {
  std::string operator()(const InputEvent& event) const { return std::visit(EventWriter{}, event); }
  std::string operator()(const LetFrames& frames) const { return fmt::format("frames {}", frames.count); }
  std::string operator()(const GoLive& live) const { return fmt::format("live {:g}", live.seconds); }
  std::string operator()(const Settle&) const { return "settle"; }
  std::string operator()(const ResizeWindow& size) const {
    return fmt::format("resize {} {}", size.width, size.height);
  }
  std::string operator()(const SavePicture& save) const {
    return (save.panels ? "window " : "picture ") + quotedName(save.path.string());
  }
};

}  // namespace

Result<std::vector<ScriptStep>> parseScript(const std::string& text, const std::string& name) {
  std::vector<ScriptStep> steps;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number)
    if (const std::string wrong = LineReader(line, steps).read(); !wrong.empty())
      return badInput(fmt::format("{}:{}: {}; see vasa view --help", name, number, wrong));
  return steps;
}

std::string scriptLine(const ScriptStep& step) { return std::visit(StepWriter{}, step); }

void ScriptRecorder::flush() {
  if (frames_ > 0) text_ += scriptLine(LetFrames{frames_}) + "\n";
  frames_ = 0;
  if (moved_) text_ += scriptLine(*moved_) + "\n";
  moved_.reset();
}

void ScriptRecorder::add(const InputEvent& event) {
  if (frames_ > 0) flush();
  if (std::holds_alternative<PointerMoved>(event)) {
    moved_ = event;
    return;
  }
  flush();
  if (const std::string line = scriptLine(event); !line.empty()) text_ += line + "\n";
}

std::string ScriptRecorder::text() const {
  ScriptRecorder rest = *this;
  rest.flush();
  return "# vasa view session\n" + rest.text_;
}

}  // namespace vasa::viewer
