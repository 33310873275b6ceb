#include "io/bvh.h"

#include <algorithm>

#include "core/atomic_file.h"
#include "io/read_limits.h"
#include "io/words.h"

namespace vasa {
namespace {

constexpr std::size_t kMaximumBytes = std::size_t(1) << 29;
constexpr std::size_t kMostJoints = 4096;
constexpr std::size_t kMaximumMapBytes = std::size_t(1) << 20;
constexpr int kDeepest = 256;
constexpr double kRadians = 3.14159265358979323846 / 180;
constexpr double kFarthest = 1e9;  // in any unit

struct BrokenRule {
  std::size_t line;
  std::string rule;
};

enum class Channel : std::uint8_t { x, y, z, turnX, turnY, turnZ };

class Parser {
 public:
  Parser(std::string_view text, const std::string& name)
      : rest_(withoutByteOrderMark(text)), bytes_(text.size()) {
    motion_.name = name;
  }

  Motion run() {
    if (const std::string_view found = next(); !sameLetters(found, "HIERARCHY"))
      breaks("a motion in .bvh begins with HIERARCHY, found " + quoted(found) + "; export it as BVH");
    expect("ROOT");
    readJoint({}, 0);
    // Some write keywords in capitals, or in none.
    while (sameLetters(peek(), "ROOT")) {
      next();
      readJoint({}, 0);
    }
    readMotion();
    return std::move(motion_);
  }

 private:
  [[noreturn]] void breaks(std::string rule) const { throw BrokenRule{line_, std::move(rule)}; }

  // Words across lines; the line counter follows the last word taken.
  std::string_view next() {
    skipBlanks();
    const std::size_t stop = std::min(rest_.find_first_of(" \t\r\n"), rest_.size());
    const std::string_view word = rest_.substr(0, stop);
    rest_.remove_prefix(stop);
    return word;
  }
  std::string_view peek() {
    skipBlanks();
    return rest_.substr(0, std::min(rest_.find_first_of(" \t\r\n"), rest_.size()));
  }
  void skipBlanks() {
    std::size_t i = 0;
    for (; i < rest_.size() && (rest_[i] == ' ' || rest_[i] == '\t' || rest_[i] == '\r' || rest_[i] == '\n');
         ++i)
      line_ += rest_[i] == '\n';
    rest_.remove_prefix(i);
  }
  std::string_view restOfLine() {
    std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(line.size());
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == line.npos) return {};
    return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
  }
  static std::string quoted(std::string_view word) {
    if (word.empty()) return "the file's end";
    return std::string(1, '\'').append(word.substr(0, 40)).append(1, '\'');
  }
  void expect(std::string_view word) {
    if (const std::string_view found = next(); !sameLetters(found, word))
      breaks("expected " + std::string(word) + ", found " + quoted(found));
  }
  // A word that the next one may follow without a blank.
  void expectMark(std::string_view word) {
    skipBlanks();
    if (!sameLetters(rest_.substr(0, word.size()), word)) return expect(word);
    rest_.remove_prefix(word.size());
  }
  double number(const char* what) {
    double value = 0;
    if (const std::string_view word = next(); !parseNumber(word, value) || std::abs(value) > kFarthest)
      breaks(std::string(what) + " must be a finite number, found " + quoted(word) +
             (word.empty()                  ? "; copy or export the file again"
              : word.find(',') != word.npos ? "; write decimal points, not commas"
                                            : ""));
    return value;
  }
  std::int64_t whole(const char* what, std::int64_t most) {
    std::int64_t value = 0;
    if (const std::string_view word = next(); !parseInteger(word, value) || value < 0 || value > most)
      breaks(std::string(what) + " must be a whole number from 0 to " + std::to_string(most) + ", found " +
             quoted(word));
    return value;
  }
  vec3 offset() {
    expect("OFFSET");
    const double x = number("an offset"), y = number("an offset"), z = number("an offset");
    return {float(x), float(y), float(z)};
  }

  void readJoint(JointId parent, int depth) {
    if (depth > kDeepest) breaks("joints are nested deeper than " + std::to_string(kDeepest));
    if (motion_.joints.size() >= kMostJoints) breaks("more than " + std::to_string(kMostJoints) + " joints");
    const JointId own{std::uint32_t(motion_.joints.size())};
    motion_.joints.push_back({std::string(restOfLine()), parent});
    if (motion_.joints.back().name.empty()) breaks("a joint needs a name");
    expect("{");
    motion_.joints[own.value].offset = offset();
    channels_.emplace_back();
    if (sameLetters(peek(), "CHANNELS")) next(), readChannels(own);
    for (std::string_view word = next(); word != "}"; word = next()) {
      if (sameLetters(word, "JOINT"))
        readJoint(own, depth + 1);
      else if (sameLetters(word, "End"))
        readEnd(own);
      else
        breaks("expected JOINT, End Site or }, found " + quoted(word));
    }
  }
  void readEnd(JointId joint) {
    expect("Site");
    expect("{");
    motion_.joints[joint.value].endOffset = offset();
    expect("}");
  }
  void readChannels(JointId joint) {
    const std::int64_t count = whole("the number of channels", 6);
    for (std::int64_t i = 0; i < count; ++i) {
      static constexpr std::string_view kNames[] = {"Xposition", "Yposition", "Zposition",
                                                    "Xrotation", "Yrotation", "Zrotation"};
      const std::string_view word = next();
      const auto found =
          std::ranges::find_if(kNames, [&](std::string_view name) { return sameLetters(name, word); });
      if (found == std::end(kNames))
        breaks("a channel must be a position or rotation such as Xrotation, found " + quoted(word));
      const auto channel = Channel(found - std::begin(kNames));
      channels_[joint.value].push_back(channel);
      motion_.joints[joint.value].moves |= channel <= Channel::z;
    }
  }

  void readMotion() {
    expect("MOTION");
    expectMark("Frames:");
    motion_.frameCount = std::uint32_t(whole("the number of frames", 10'000'000));
    if (motion_.frameCount == 0) breaks("there are no frames; export the motion again");
    expect("Frame");
    expectMark("Time:");
    const double seconds = number("the frame time");
    if (!(seconds > 1e-5 && seconds < 1e4))
      breaks("the frame time must be above zero seconds, found " + numberText(seconds));
    const double rate = 1 / seconds;
    motion_.framesPerSecond =
        float(std::abs(rate - std::round(rate)) < 0.005 * rate && rate >= 1 ? std::round(rate) : rate);
    const std::size_t total = motion_.frameCount * motion_.joints.size();
    // A value is two bytes of text at least: what is promised but not there costs no memory.
    std::size_t perFrame = 0;
    for (const auto& channels : channels_) perFrame += channels.size();
    if (motion_.frameCount * perFrame > rest_.size() || perFrame == 0)
      breaks("the file holds fewer values than its " + std::to_string(motion_.frameCount) + " frames of " +
             std::to_string(perFrame) + " channels need");
    // Joints without channels take memory in every frame, too.
    if (const std::size_t wanted = total * (sizeof(quat) + sizeof(vec3)), most = partOfMemory(bytes_, 15, 48);
        wanted > most)
      breaks(std::to_string(motion_.frameCount) + " frames of " + std::to_string(motion_.joints.size()) +
             " joints " + beyondMemory(wanted, most) + "; leave out joints that have no channels");
    motion_.rotations.reserve(total);
    motion_.translations.reserve(total);
    for (std::uint32_t frame = 0; frame < motion_.frameCount; ++frame)
      for (std::size_t j = 0; j < motion_.joints.size(); ++j) readValues(j);
  }
  void readValues(std::size_t joint) {
    glm::dquat turn(1, 0, 0, 0);
    vec3 place = motion_.joints[joint].offset;
    for (const Channel channel : channels_[joint]) {
      const double value = number("a channel's value");
      if (channel <= Channel::z)
        place[int(channel)] = float(value);
      else {
        dvec3 axis(0);
        axis[int(channel) - 3] = 1;
        turn = turn * glm::angleAxis(value * kRadians, axis);
      }
    }
    motion_.rotations.push_back(quat(glm::normalize(turn)));
    motion_.translations.push_back(place);
  }

  std::string_view rest_;
  std::size_t bytes_, line_ = 1;
  std::vector<std::vector<Channel>> channels_;
  Motion motion_;
};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == text.npos ? std::string_view{}
                            : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

Result<Motion> parseBvh(std::string_view text, const std::string& name) {
  try {
    return Parser(text, name).run();
  } catch (const BrokenRule& broken) {
    return badInput(name + ":" + std::to_string(broken.line) + ": " + broken.rule);
  }
}

Result<Motion> readBvh(const std::filesystem::path& path) {
  const auto bytes = readFile(path, kMaximumBytes);
  if (!bytes) return bytes.error();
  return parseBvh({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string());
}

Result<JointMap> readJointMap(const std::filesystem::path& path) {
  const auto bytes = readFile(path, kMaximumMapBytes);
  if (!bytes) return bytes.error();
  return parseJointMap({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string());
}

Result<JointMap> parseJointMap(std::string_view text, const std::string& name) {
  JointMap map;
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = nextLine(text);
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const std::size_t sign = line.find('=');
    const std::string_view from = trimmed(line.substr(0, sign));
    if (sign == line.npos || from.empty())
      return badInput(name + ":" + std::to_string(number) +
                      ": a line must be `motion's joint = body's joint`");
    map[std::string(from)] = std::string(trimmed(line.substr(sign + 1)));
  }
  return map;
}

}  // namespace vasa
