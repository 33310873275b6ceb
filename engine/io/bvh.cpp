#include "io/bvh.h"

#include <algorithm>
#include <cmath>

#include "body/clip.h"
#include "body/motion_leaps.h"
#include "body/motion_units.h"
#include "body/rig.h"
#include "core/atomic_file.h"
#include "core/letters.h"
#include "core/log.h"
#include "core/text_file.h"
#include "io/bvh_turns.h"
#include "io/read_limits.h"
#include "io/words.h"

namespace vasa {
namespace {

constexpr std::size_t kMaximumBvhBytes = std::size_t(1) << 29;
constexpr std::size_t kMostJoints = 4096;
constexpr int kDeepest = 256;
constexpr double kFarthest = 1e9;  // in any unit
// No motion is recorded at less than a frame a second, and any is in milliseconds at more than 1 of them.
constexpr double kLongestFrame = 1;                       // [s]
constexpr double kFewestFrames = 20, kMostFrames = 1000;  // a second

struct BrokenLine {
  std::size_t line;
  std::string rule;
};

using Channel = BvhChannel;

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : rest_(text), bytes_(text.size()) {
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
    keepOffsets();
    warnOfRadians();
    passOverRest();
    if (!doubt_.empty()) {
      motion_.turnsDoubted = true;
      logWarning(motion_.name + ": " + doubt_);
    }
    return std::move(motion_);
  }

 private:
  [[noreturn]] void breaks(std::string rule) const { throw BrokenLine{line_, std::move(rule)}; }
  void warn(const std::string& what) const {
    logWarning(motion_.name + ":" + std::to_string(line_) + ": " + what);
  }

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
  // Up to the line's end, or to the mark that begins a block.
  std::string_view restOfHead() {
    const std::string_view head = rest_.substr(0, rest_.find_first_of("{\n"));
    rest_.remove_prefix(head.size());
    const std::size_t first = head.find_first_not_of(" \t\r");
    if (first == head.npos) return {};
    return head.substr(first, head.find_last_not_of(" \t\r") - first + 1);
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
  // A comma or semicolon that stands between numbers or behind one, not within one.
  static bool divides(std::string_view word) {
    return word.ends_with(',') || word.find(';') != word.npos ||
           (word.find(',') != word.npos && word.find('.') != word.npos);
  }
  double number(const char* what) { return numberOf(next(), what); }
  double numberOf(std::string_view word, const char* what) const {
    double value = 0;
    if (!parseNumber(word, value) || std::abs(value) > kFarthest)
      breaks(std::string(what) + " must be a finite number, found " + quoted(word) +
             (word.empty()                  ? "; copy or export the file again"
              : divides(word)               ? "; divide numbers by blanks alone"
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
    motion_.joints.push_back({std::string(restOfHead()), parent});
    if (motion_.joints.back().name.empty()) breaks("a joint needs a name");
    expectMark("{");
    channels_.emplace_back();
    const bool channelsFirst = readChannels(own);  // as some write them
    motion_.joints[own.value].offset = offset();
    if (!channelsFirst) readChannels(own);
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
    expectMark("Site");
    restOfHead();  // some name it
    expectMark("{");
    motion_.joints[joint.value].endOffset = offset();
    expect("}");
  }
  bool readChannels(JointId joint) {
    if (!sameLetters(peek(), "CHANNELS")) return false;
    next();
    const std::int64_t count = whole("the number of channels", 6);
    for (std::int64_t i = 0; i < count; ++i) {
      static constexpr std::string_view kNames[] = {"Xposition", "Yposition", "Zposition",
                                                    "Xrotation", "Yrotation", "Zrotation"};
      const std::string_view word = next();
      const auto found =
          std::ranges::find_if(kNames, [&](std::string_view name) { return sameLetters(name, word); });
      if (found == std::end(kNames))
        breaks("a channel must be a position or rotation such as Xrotation, found " + quoted(word) +
               "; export turns as three angles about the axes");
      const auto channel = Channel(found - std::begin(kNames));
      channels_[joint.value].push_back(channel);
      motion_.joints[joint.value].moves |= channel <= Channel::z;
    }
    return true;
  }

  void readMotion() {
    if (const std::string_view found = next(); !sameLetters(found, "MOTION"))
      breaks("expected MOTION, found " + quoted(found) +
             "; export the skeleton of one person with its motion");
    expectMark("Frames");
    expectMark(":");
    motion_.frameCount = std::uint32_t(whole("the number of frames", 10'000'000));
    if (motion_.frameCount == 0) breaks("there are no frames; export the motion again");
    expect("Frame");
    expectMark("Time");
    expectMark(":");
    const double seconds = number("the frame time");
    if (!(seconds > 1e-5))
      breaks("the frame time must be above zero seconds, found " + numberText(seconds) +
             "; write 1 divided by the frames a second, 0.0333333 for 30");
    if (seconds > kLongestFrame)
      breaks("the frame time of " + numberText(seconds) +
             " s is longer than a second; it is in seconds, not milliseconds: write " +
             numberText(std::round(1e4 * seconds) / 1e7) + " if it was meant as those" +
             (seconds >= kFewestFrames && seconds <= kMostFrames
                  ? ", and " + numberText(std::round(1e6 / seconds) / 1e6) +
                        " if it was meant as frames a second"
                  : ""));
    motion_.framesPerSecond = float(likelyRate(1 / seconds));
    const std::size_t total = motion_.frameCount * motion_.joints.size();
    // A value is two bytes of text at least: what is promised but not there costs no memory.
    for (const auto& channels : channels_) perFrame_ += channels.size();
    if (motion_.frameCount * perFrame_ > rest_.size() || perFrame_ == 0)
      breaks("the file holds fewer values than its " + std::to_string(motion_.frameCount) + " frames of " +
             std::to_string(perFrame_) + " channels need");
    // Joints without channels take memory in every frame, too.
    if (const std::size_t wanted = total * (sizeof(quat) + sizeof(vec3)), most = partOfMemory(bytes_, 15, 48);
        wanted > most)
      breaks(std::to_string(motion_.frameCount) + " frames of " + std::to_string(motion_.joints.size()) +
             " joints " + beyondMemory(wanted, most) + "; leave out joints that have no channels");
    motion_.rotations.reserve(total);
    motion_.translations.reserve(total);
    values_.resize(perFrame_);
    BvhSteps steps(motion_);
    for (std::uint32_t frame = 0; frame < motion_.frameCount; ++frame) {
      readFrame(frame);
      steps.take(frame, values_);
      const double* value = values_.data();
      for (std::size_t j = 0; j < motion_.joints.size(); ++j) value = poseJoint(j, value);
    }
    doubt_ = steps.otherTurns(motion_, channels_);
  }

  // A frame is a row, or several where the first one is, and always ends with a row: what does not fit the
  // hierarchy is found before it shifts all values behind it.
  void readFrame(std::uint32_t frame) {
    std::size_t found = readRow(0), rows = 1;
    const std::size_t firstLine = line_, ofFirst = found;
    if (found == 0)
      breaks("the file ends after " + std::to_string(frame) + " of its " +
             std::to_string(motion_.frameCount) +
             " frames; copy or export it again, or write that number behind Frames:");
    while (found < perFrame_ && (frame == 0 || wrapped_)) {
      const std::size_t more = readRow(found);
      if (more == 0) break;
      found += more, ++rows;
    }
    wrapped_ |= rows > 1;
    if (found == perFrame_) return;
    // Of a first frame that fits no rows nobody knows how many were meant for it.
    const bool one = rows == 1 || frame == 0;
    line_ = firstLine;
    breaks(
        (one ? "this row holds " + std::to_string(ofFirst)
             : "the " + std::to_string(rows) + " rows from here hold " + std::to_string(found)) +
        " values, and the hierarchy has " + std::to_string(perFrame_) +
        " channels; export the motion again (a joint that is taken out of the hierarchy leaves its columns)");
  }
  // The values of the next line that has any, behind those that a frame has already; those beyond a frame are
  // counted only.
  std::size_t readRow(std::size_t have) {
    skipBlanks();
    std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(line.size());
    std::size_t count = 0;
    for (std::string_view word = nextWord(line); !word.empty(); word = nextWord(line), ++count)
      if (have + count < perFrame_) values_[have + count] = numberOf(word, "a channel's value");
    return count;
  }
  // Some give every joint channels for its place and record none: a joint that is on the one above it in
  // every frame, and is not by its OFFSET, stays where that has it. A root's OFFSET says nothing.
  void keepOffsets() {
    const std::size_t joints = motion_.joints.size();
    std::size_t kept = 0;
    for (std::size_t j = 0; j < joints; ++j) {
      Motion::Joint& joint = motion_.joints[j];
      if (!joint.moves || !joint.parent.valid() || joint.offset == vec3(0)) continue;
      bool recorded = false;
      for (std::uint32_t frame = 0; frame < motion_.frameCount && !recorded; ++frame)
        recorded = motion_.translation(frame, j) != vec3(0);
      if (recorded) continue;
      joint.moves = false, ++kept;
      for (std::uint32_t frame = 0; frame < motion_.frameCount; ++frame)
        motion_.translations[frame * joints + j] = joint.offset;
    }
    if (kept > 0)
      logWarning(motion_.name + ": the places of " + std::to_string(kept) + " of " + std::to_string(joints) +
                 " joints are zero in every frame, as where none were recorded; their OFFSETs are taken");
  }
  // Who moves at all turns some joint farther.
  void warnOfRadians() const {
    if (motion_.frameCount > 1 && mostTurn_ > 0.5 && mostTurn_ < double(2 * kPi))
      logWarning(motion_.name + ": no joint turns by more than " +
                 numberText(std::round(10 * mostTurn_) / 10) +
                 " degrees in any frame; if the file has radians, write degrees");
  }
  // Some put marks of an end behind the last row.
  void passOverRest() {
    const std::size_t last = rest_.find_last_not_of(std::string_view(" \t\r\n\0\x1a", 6));
    rest_ = rest_.substr(0, last == rest_.npos ? 0 : last + 1);
    if (const std::string_view word = peek(); sameLetters(word, "HIERARCHY")) {
      warn("another motion begins here, and is not read; put it into a file of its own");
    } else if (!word.empty()) {
      warn(std::to_string(1 + std::ranges::count(rest_, '\n')) +
           " lines from here on are not read: Frames: is " + std::to_string(motion_.frameCount) +
           "; give their number there where they are frames, too");
    }
  }

  const double* poseJoint(std::size_t joint, const double* value) {
    const auto& channels = channels_[joint];
    const std::span values(value, channels.size());
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (channels[c] > Channel::z) mostTurn_ = std::max(mostTurn_, std::abs(values[c]));
    addBvhPose(channels, values, nullptr, motion_, joint);
    return value + channels.size();
  }

  std::string_view rest_;
  std::size_t bytes_, line_ = 1;
  double mostTurn_ = 0;         // as a channel has it
  std::size_t perFrame_ = 0;    // values
  std::vector<double> values_;  // of one frame
  bool wrapped_ = false;        // a frame takes several rows
  std::string doubt_;           // of the order of turns
  std::vector<std::vector<Channel>> channels_;
  Motion motion_;
};

// What a motion that is well formed may still have wrong, and what is done about it.
Motion inOrder(Motion motion) {
  const auto warn = [&](const std::string& what) { logWarning(motion.name + ": " + what); };
  if (const std::size_t people = peopleMoved(motion); people > 1)
    warn("it holds " + std::to_string(people) +
         " people, of whom one moves a body; export each into a file of its own");
  const Rig rig = rigOf(motion);
  if (sidesSwapped(rig))
    warn(
        "its feet point backwards for what its joints call left and right: sides seem swapped, and bodies, "
        "which go by names where no --joint-map says otherwise, are turned around; name them as the person "
        "sees them");
  const MotionUnits units = motionUnits(motion, rig.parts.of);
  if (!units.one()) warn(describeUnits(units));
  motion = inOneUnit(std::move(motion), units);
  if (const auto leaps = leapsOf(motion, rig.parts.of); !leaps.empty())
    warn(std::to_string(leaps.size()) +
         " of its frames go on from the one before as no person does, the first is frame " +
         std::to_string(leaps.front()) +
         ": a tracker lost its person there, or another pose was put in front; mend them in the program that "
         "recorded them, or choose frames without them (--frames FIRST:LAST)");
  return motion;
}

}  // namespace

Result<Motion> parseBvh(std::string_view text, const std::string& name) {
  std::string kept;
  const auto plain = plainText(text, name, kept);
  if (!plain) return plain.error();
  try {
    return inOrder(Parser(*plain, name).run());
  } catch (const BrokenLine& broken) {
    return badInput(name + ":" + std::to_string(broken.line) + ": " + broken.rule);
  }
}

Result<Motion> readBvh(const std::filesystem::path& path) {
  const auto bytes = readFile(path, kMaximumBvhBytes);
  if (!bytes) return bytes.error();
  return parseBvh({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string());
}

}  // namespace vasa
