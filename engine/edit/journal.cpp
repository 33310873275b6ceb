#include "edit/journal.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <iterator>
#include <optional>

#include "core/nearest_names.h"
#include "core/text_file.h"

// Every operation lists its words once, in describe(); three kinds of `fields` go through such a list: one
// reads a line, one writes it, one tells how it is written.
namespace vasa {
namespace {

constexpr std::size_t kMostBytes = 4 << 20;
constexpr std::size_t kMostVia = 100;
constexpr double kMostMm = 5000;  // longer than any vessel, so that a slip of the unit is noticed

template <class Value>
using Words = std::initializer_list<std::pair<const char*, Value>>;

const Words<EditSide> kSides{{"left", EditSide::left}, {"right", EditSide::right}, {"front", EditSide::front},
                             {"back", EditSide::back}, {"up", EditSide::up},       {"down", EditSide::down}};
const Words<VesselKind> kKinds{{"artery", VesselKind::artery},
                               {"vein", VesselKind::vein},
                               {"other", VesselKind::other},
                               {"portal", VesselKind::portalVein},
                               {"lymphatic", VesselKind::lymphatic}};

template <class F>
void describe(F& f, RadiusEdit& e) {
  f.name("V", e.vessel), f.number("s0", e.from, 0, 1), f.number("s1", e.to, 0, 1);
  f.number("xF", e.factor, 0.01, 100, 'x'), f.flag("smooth", e.smooth);
  f.must(e.from < e.to, "s0 must be less than s1");
}
template <class F>
void describe(F& f, StenosisEdit& e) {
  f.name("V", e.vessel), f.number("s", e.at, 0, 1), f.number("length_mm", e.lengthMm, 0.1, kMostMm);
  f.number("percent", e.percent, 1, 99), f.maybe("eccentricity", e.eccentricity, 0, 1);
}
template <class F>
void describe(F& f, AneurysmEdit& e) {
  f.name("V", e.vessel), f.number("s", e.at, 0, 1), f.number("length_mm", e.lengthMm, 0.1, kMostMm);
  f.number("diameter_mm", e.diameterMm, 0.1, 500), f.maybeWord("side", e.side, kSides, EditSide::none);
}
template <class F>
void describe(F& f, MoveEdit& e) {
  f.name("V", e.vessel), f.number("s", e.at, 0, 1), f.vector("dx dy dz", e.byMm, kMostMm);
  f.maybe("falloff_mm", e.falloffMm, 0.1, kMostMm);
  f.must(glm::dot(e.byMm, e.byMm) > 0, "dx dy dz must not all be 0");
}
template <class F>
void describe(F& f, StentEdit& e) {
  f.name("V", e.vessel), f.number("s0", e.from, 0, 1), f.number("s1", e.to, 0, 1);
  f.number("radius_mm", e.radiusMm, 0.05, 100);
  f.must(e.from < e.to, "s0 must be less than s1");
}
template <class F>
void describe(F& f, GraftEdit& e) {
  f.name("A", e.vessel), f.number("s", e.at, 0, 1), f.name("B", e.other), f.number("s", e.otherAt, 0, 1);
  f.number("radius_mm", e.radiusMm, 0.05, 100), f.maybeName("name", e.name, "via"), f.places("via", e.via);
  f.must(e.vessel != e.other, "A and B must be two vessels");
}
template <class F>
void describe(F& f, BranchEdit& e) {
  f.name("V", e.vessel), f.number("s", e.at, 0, 1), f.name("name", e.name);
  f.number("radius_mm", e.radiusMm, 0.05, 100), f.number("length_mm", e.lengthMm, 0.1, kMostMm);
  f.vector("dx dy dz", e.direction, kMostMm);
  f.must(glm::dot(e.direction, e.direction) > 0, "dx dy dz must not all be 0");
}
template <class F>
void describe(F& f, OccludeEdit& e) {
  f.name("V", e.vessel), f.number("s", e.at, 0, 1);
}
template <class F>
void describe(F& f, CutEdit& e) {
  f.name("V", e.vessel), f.number("s0", e.from, 0, 1), f.number("s1", e.to, 0, 1);
  f.must(e.from < e.to, "s0 must be less than s1");
}
template <class F>
void describe(F& f, JoinEdit& e) {
  f.name("A", e.vessel), f.name("B", e.other);
  f.must(e.vessel != e.other, "A and B must be two vessels");
}
template <class F>
void describe(F& f, RenameEdit& e) {
  f.name("V", e.vessel), f.name("name", e.name);
}
template <class F>
void describe(F& f, KindEdit& e) {
  f.name("V", e.vessel), f.word("kind", e.kind, kKinds);
}
template <class F>
void describe(F& f, DeleteEdit& e) {
  f.name("V", e.vessel), f.flag("tree", e.tree);
}

constexpr std::array<std::string_view, std::variant_size_v<EditOperation>> kNames{
    "radius",  "stenosis", "aneurysm", "move",   "stent", "graft", "branch",
    "occlude", "cut",      "join",     "rename", "kind",  "delete"};

template <std::size_t I = 0>
std::optional<EditOperation> operationNamed(std::string_view name) {
  if constexpr (I < kNames.size()) {
    if (name == kNames[I]) return EditOperation(std::in_place_index<I>);
    return operationNamed<I + 1>(name);
  } else {
    return std::nullopt;
  }
}

std::string inQuotes(const std::string& name) {
  std::string text(1, '"');
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  text += '"';
  return text;
}

// Tells how an operation is written.
class Grammar {
 public:
  explicit Grammar(std::string_view operation) : text(operation) {}
  void name(const char* what, std::string&) { add(what); }
  void number(const char* what, double&, double, double, char = 0) { add(what); }
  void vector(const char* what, dvec3&, double) { add(what); }
  void maybe(const char* what, double&, double, double) { add(what, true); }
  void flag(const char* what, bool&) { add(what, true); }
  void maybeName(const char* what, std::string&, const char*) { add(what, true); }
  void places(const char* what, std::vector<dvec3>&) { add(fmt::format("{} x y z ...", what).c_str(), true); }
  template <class Value>
  void word(const char*, Value&, Words<Value> words) {
    add(listOf(words).c_str());
  }
  template <class Value>
  void maybeWord(const char*, Value&, Words<Value> words, Value) {
    add(listOf(words).c_str(), true);
  }
  void must(bool, const char*) {}
  std::string text;

 private:
  template <class Value>
  static std::string listOf(Words<Value> words) {
    std::string list;
    for (const auto& [word, value] : words) list += fmt::format("{}{}", list.empty() ? "" : "|", word);
    return list;
  }
  void add(const char* what, bool optional = false) {
    text += optional ? fmt::format(" [{}]", what) : fmt::format(" {}", what);
  }
};

class Writer {
 public:
  explicit Writer(std::string_view operation) : text(operation) {}
  void name(const char*, std::string& value) { text += fmt::format(" {}", inQuotes(value)); }
  void number(const char*, double& value, double, double, char mark = 0) {
    text += ' ';
    if (mark) text += mark;
    text += fmt::format("{}", value);
  }
  void vector(const char*, dvec3& value, double) {
    text += fmt::format(" {} {} {}", value.x, value.y, value.z);
  }
  void maybe(const char* what, double& value, double low, double high) {
    if (value != 0) number(what, value, low, high);
  }
  void flag(const char* what, bool& value) {
    if (value) text += fmt::format(" {}", what);
  }
  void maybeName(const char* what, std::string& value, const char*) {
    if (!value.empty()) name(what, value);
  }
  void places(const char* what, std::vector<dvec3>& value) {
    if (value.empty()) return;
    text += fmt::format(" {}", what);
    for (dvec3& place : value) vector("", place, 0);
  }
  template <class Value>
  void word(const char*, Value& value, Words<Value> words) {
    for (const auto& [word, meant] : words)
      if (meant == value) text += fmt::format(" {}", word);
  }
  template <class Value>
  void maybeWord(const char* what, Value& value, Words<Value> words, Value none) {
    if (value != none) word(what, value, words);
  }
  void must(bool, const char*) {}
  std::string text;
};

struct Word {
  std::string text;
  bool isQuoted = false;
};

class Reader {
 public:
  Reader(const std::vector<Word>& words, std::size_t next) : words_(words), next_(next) {}

  void name(const char* what, std::string& value) {
    if (!more(what)) return;
    bare_ = !words_[next_].isQuoted;
    value = words_[next_++].text;
    if (value.empty()) fail(fmt::format("{} must not be empty", what));
  }
  void number(const char* what, double& value, double low, double high, char mark = 0) {
    if (!more(what)) return;
    std::string_view text = words_[next_].text;
    if (mark && !text.empty() && text.front() == mark) text.remove_prefix(1);
    const auto [end, cause] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (words_[next_].isQuoted || cause != std::errc() || end != text.data() + text.size() ||
        !(value >= low && value <= high)) {
      breaksName = bare_ && isNoNumber();
      return fail(fmt::format("{} must be a number from {} to {}, not {}", what, low, high, shown()));
    }
    ++next_, bare_ = false;
  }
  void vector(const char* what, dvec3& value, double most) {
    const std::string names(what);
    for (int axis = 0; axis < 3; ++axis)
      number(names.empty() ? "a coordinate" : names.substr(std::size_t(axis) * 3, 2).c_str(), value[axis],
             -most, most);
  }
  void maybe(const char* what, double& value, double low, double high) {
    if (next_ < words_.size()) number(what, value, low, high);
  }
  void flag(const char* what, bool& value) {
    if (next_ < words_.size() && !words_[next_].isQuoted && words_[next_].text == what) value = true, ++next_;
  }
  void maybeName(const char* what, std::string& value, const char* next) {
    if (next_ < words_.size() && (words_[next_].isQuoted || words_[next_].text != next)) name(what, value);
  }
  void places(const char* what, std::vector<dvec3>& value) {
    bool given = false;
    flag(what, given);
    if (!given) return;
    do vector("", value.emplace_back(), kMostMm);
    while (!fault && next_ < words_.size() && value.size() < kMostVia);
  }
  template <class Value>
  void word(const char* what, Value& value, Words<Value> words) {
    if (!more(what)) return;
    std::string list;
    for (const auto& [word, meant] : words) {
      if (!words_[next_].isQuoted && words_[next_].text == word) return value = meant, void(++next_);
      list += fmt::format("{}{}", list.empty() ? "" : ", ", word);
    }
    fail(fmt::format("{} must be one of {}, not {}", what, list, shown()));
  }
  template <class Value>
  void maybeWord(const char* what, Value& value, Words<Value> words, Value) {
    if (next_ < words_.size()) word(what, value, words);
  }
  void must(bool holds, const char* rule) {
    if (!holds) fail(rule);
  }
  void atEnd() {
    if (fault || next_ >= words_.size()) return;
    breaksName = bare_ && isNoNumber();
    fail(fmt::format("{} is one word too many", shown()));
  }
  std::optional<std::string> fault;
  /// A word stands behind a name without quotes where a number or nothing may: the name's next one, likely.
  bool breaksName = false;

 private:
  bool more(const char* what) {
    if (!fault && next_ >= words_.size()) fail(fmt::format("{} is missing", what));
    return !fault;
  }
  bool isNoNumber() const {
    const Word& word = words_[next_];
    return !word.isQuoted && !word.text.empty() &&
           std::string_view("+-.0123456789").find(word.text[0]) == std::string_view::npos;
  }
  std::string shown() const {
    const Word& word = words_[next_];
    return word.isQuoted ? inQuotes(word.text) : fmt::format("'{}'", word.text);
  }
  void fail(std::string what) {
    if (!fault) fault = std::move(what);
  }

  const std::vector<Word>& words_;
  std::size_t next_;
  bool bare_ = false;  // the word before is a name without quotes
};

// Words of a line up to a comment; an error's text where it is malformed.
std::optional<std::string> split(std::string_view line, std::vector<Word>& words) {
  for (std::size_t i = 0; i < line.size();) {
    const char c = line[i];
    if (c == ' ' || c == '\t' || c == '\r') {
      ++i;
      continue;
    }
    if (c == '#') break;
    Word word;
    word.isQuoted = c == '"';
    if (!word.isQuoted) {
      for (; i < line.size() && std::string_view(" \t\r#\"").find(line[i]) == std::string_view::npos; ++i)
        word.text += line[i];
    } else {
      for (++i; i < line.size() && line[i] != '"'; ++i) {
        if (line[i] == '\\' && i + 1 < line.size()) ++i;
        word.text += line[i];
      }
      if (i >= line.size()) return "a name's closing quote is missing";
      ++i;
    }
    for (const char each : word.text)
      if (static_cast<unsigned char>(each) < 0x20) return "a name holds a control character";
    words.push_back(std::move(word));
  }
  return std::nullopt;
}

template <class Operation>
std::string grammarOf(const Operation& operation) {
  Grammar grammar(operationName(operation));
  std::visit([&](auto value) { describe(grammar, value); }, operation);
  return grammar.text;
}

// What was meant where an operation's name is hardly misspelt, else all of them.
std::string meantOperation(const std::string& written) {
  constexpr std::size_t kLongest = 32;  // twice the longest name: what is longer is none of them
  const std::vector<std::string> names(std::begin(kNames), std::end(kNames));
  const std::string all = fmt::format("use one of {}", fmt::join(names, ", "));
  return written.empty() || written.size() > kLongest ? all : didYouMean(written, names, all);
}

}  // namespace

std::string_view operationName(const EditOperation& operation) { return kNames[operation.index()]; }

const std::string& vesselOf(const EditOperation& operation) {
  return std::visit([](const auto& edit) -> const std::string& { return edit.vessel; }, operation);
}

double placeOf(const EditOperation& operation) {
  return std::visit(
      [](const auto& edit) {
        if constexpr (requires { edit.at; })
          return edit.at;
        else if constexpr (requires { edit.from; })
          return 0.5 * (edit.from + edit.to);
        else
          return -1.0;
      },
      operation);
}

std::string journalGrammar() {
  std::string text;
  for (const std::string_view name : kNames) text += grammarOf(*operationNamed(name)) + "\n";
  return text;
}

Result<std::vector<Edit>> parseJournal(std::string_view text, const std::string& name) {
  std::vector<Edit> edits;
  std::vector<Word> words;
  std::uint32_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    const std::string where = fmt::format("{}:{}: ", name, ++number);
    words.clear();
    if (const auto fault = split(line, words))
      return badInput(where + *fault + "; names stand in double quotes");
    if (words.empty()) continue;
    auto operation = words[0].isQuoted ? std::nullopt : operationNamed(words[0].text);
    if (!operation)
      return badInput(fmt::format("{}'{}' is no operation; {}", where, words[0].text,
                                  meantOperation(words[0].isQuoted ? "" : words[0].text)));
    Reader reader(words, 1);
    std::visit([&](auto& value) { describe(reader, value), reader.atEnd(); }, *operation);
    if (reader.fault)
      return badInput(fmt::format("{}{}: {}; write {}{}", where, operationName(*operation), *reader.fault,
                                  grammarOf(*operation),
                                  reader.breaksName ? ", names of several words in double quotes" : ""));
    edits.push_back({std::move(*operation), name, number});
  }
  return edits;
}

Result<std::vector<Edit>> readJournal(const std::filesystem::path& path) {
  const auto text = readText(path, kMostBytes);
  if (!text) return text.error();
  return parseJournal(*text, path.string());
}

std::string journalLine(const EditOperation& operation) {
  Writer writer(operationName(operation));
  std::visit([&](auto value) { describe(writer, value); }, operation);
  return writer.text;
}

}  // namespace vasa
