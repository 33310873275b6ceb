#include "collide/tube_list.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "core/atomic_file.h"
#include "core/text_file.h"

namespace vasa {
namespace {

constexpr int kNumbersPerTube = 32;

// Walks a text line by line and reads numbers off the current line.
class Lines {
 public:
  Lines(std::string name, std::string_view text) : name_(std::move(name)), rest_(text) {}

  /// Moves to the next line; false at the end of the text.
  bool next() {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++number_;
    skipSpace();
    return true;
  }
  bool lineDone() const { return line_.empty(); }

  template <class T>
  bool read(T& value) {
    const auto [end, fault] = std::from_chars(line_.data(), line_.data() + line_.size(), value);
    if (fault != std::errc() || (end != line_.data() + line_.size() && !isSpace(*end))) return false;
    line_.remove_prefix(std::size_t(end - line_.data()));
    skipSpace();
    return true;
  }

  std::size_t bytesLeft() const { return rest_.size(); }
  Error fault(const std::string& cause) const {
    return badInput(name_ + ":" + std::to_string(number_) + ": " + cause);
  }
  Error missing(const std::string& what) const {
    return badInput(name_ + ":" + std::to_string(number_ + 1) + ": the file ends where " + what);
  }

 private:
  static bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void skipSpace() {
    while (!line_.empty() && isSpace(line_.front())) line_.remove_prefix(1);
  }

  std::string name_;
  std::string_view rest_, line_;
  std::size_t number_ = 0;
};

Result<void> readTube(Lines& lines, Bezier& pose0, Bezier& pose1) {
  for (int k = 0; k < kNumbersPerTube; ++k) {
    float value = 0;
    if (!lines.read(value))
      return lines.fault((lines.lineDone()
                              ? std::to_string(k) + " numbers"
                              : "number " + std::to_string(k + 1) + " is unreadable or out of range") +
                         "; a tube needs 32 (4 control points x y z r in each of two poses)");
    if (!std::isfinite(value) || std::abs(value) > kLargestTubeCoordinate)
      return lines.fault("number " + std::to_string(k + 1) +
                         " is not a finite number of at most 1e6; correct it");
    if (k % 4 == 3 && !(value > 0))
      return lines.fault("radius " + std::to_string(value) +
                         " must be positive; correct it or remove the tube");
    (k < 16 ? pose0 : pose1).b[std::size_t(k / 4 % 4)][k % 4] = value;
  }
  if (!lines.lineDone())
    return lines.fault("more than 32 numbers; a tube has 4 control points x y z r in each of two poses");
  return {};
}

Result<TubePair> readPair(Lines& lines, std::uint32_t tubes) {
  std::uint32_t i = 0, j = 0;
  if (!lines.read(i) || !lines.read(j) || !lines.lineDone())
    return lines.fault("expected two tube numbers `i j`");
  if (i >= tubes || j >= tubes)
    return lines.fault("tube " + std::to_string(std::max(i, j)) +
                       " does not exist; the list has tubes 0 to " + std::to_string(std::int64_t(tubes) - 1));
  if (i == j) return lines.fault("tube " + std::to_string(i) + " is paired with itself; remove the line");
  return orderedPair(i, j);
}

Result<TubeList> parse(Lines lines) {
  std::uint32_t tubes = 0, pairs = 0;
  if (!lines.next())
    return lines.missing("its first line `n m` should be: number of tubes, number of excluded pairs");
  if (!lines.read(tubes) || !lines.read(pairs) || !lines.lineDone())
    return lines.fault("expected `n m`: number of tubes, number of excluded pairs");
  // A line holds at least 2 bytes a number and 4 a pair: a false count must not reserve memory it has no
  // lines for.
  if (tubes > lines.bytesLeft() / (2 * kNumbersPerTube - 1) || pairs > lines.bytesLeft() / 3)
    return lines.fault(std::to_string(tubes) + " tubes and " + std::to_string(pairs) +
                       " pairs are announced, more than the file can hold; correct the counts");
  TubeList list;
  for (auto& pose : list.poses) pose.resize(tubes);
  for (std::uint32_t i = 0; i < tubes; ++i) {
    if (!lines.next())
      return lines.missing("tube " + std::to_string(i) + " of " + std::to_string(tubes) +
                           " should be; correct the count or add the lines");
    if (auto read = readTube(lines, list.poses[0][i], list.poses[1][i]); !read) return read.error();
  }
  list.excluded.reserve(pairs);
  for (std::uint32_t k = 0; k < pairs; ++k) {
    if (!lines.next())
      return lines.missing("excluded pair " + std::to_string(k) + " of " + std::to_string(pairs) +
                           " should be; correct the count or add the lines");
    auto pair = readPair(lines, tubes);
    if (!pair) return pair.error();
    list.excluded.push_back(*pair);
  }
  while (lines.next())
    if (!lines.lineDone()) return lines.fault("text after the last announced line; correct the counts");
  return list;
}

template <class T>
void append(std::string& text, T value, char after) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  text.append(buffer, end);
  text.push_back(after);
}

}  // namespace

void TubeList::blend(float share, LargeVector<Bezier>& tubes) const {
  tubes.resize(poses[0].size());
  for (std::size_t i = 0; i < tubes.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) tubes[i].b[k] = glm::mix(poses[0][i].b[k], poses[1][i].b[k], share);
}

Result<TubeList> readTubeList(const std::filesystem::path& path) {
  const auto text = readText(path);
  if (!text) return text.error();
  return parse(Lines(path.string(), *text));
}

Result<void> writeTubeList(const std::filesystem::path& path, const TubeList& list) {
  std::string text;
  append(text, list.poses[0].size(), ' ');
  append(text, list.excluded.size(), '\n');
  for (std::size_t i = 0; i < list.poses[0].size(); ++i) {
    for (const auto& pose : list.poses)
      for (const vec4& point : pose[i].b)
        for (int axis = 0; axis < 4; ++axis) append(text, point[axis], ' ');
    text.back() = '\n';
  }
  for (const TubePair& pair : list.excluded) append(text, pair.i, ' '), append(text, pair.j, '\n');
  return writeFileAtomically(path, text);
}

Result<void> writePairs(const std::filesystem::path& path, std::span<const TubePair> pairs) {
  std::string text;
  for (const TubePair& pair : pairs) append(text, pair.i, ' '), append(text, pair.j, '\n');
  return writeFileAtomically(path, text);
}

}  // namespace vasa
