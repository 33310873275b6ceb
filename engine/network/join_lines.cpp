#include "network/join_lines.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "core/cancellation.h"
#include "core/disjoint_sets.h"
#include "core/ids.h"
#include "math/closest_point.h"

namespace vasa {
namespace {

constexpr float kStartReach = 1, kEndReach = 0.5f;  // of the other line's radius
constexpr float kSameSample = 0.1f;                 // of a radius: a place so near to a sample is that sample
// A join looks at its host's samples and at all joints: a hundred thousand traces that all join one line
// would take minutes.
constexpr std::size_t kMostComparisons = 200'000'000, kMostWork = 1'000'000'000;

struct Found {
  std::uint32_t line = 0, segment = 0;
  float t = 0, cost = 1;  // distance over reach
};

// Of what nothing says the kind of, it may be either.
bool mayBeOne(VesselKind a, VesselKind b) {
  const auto plain = [](VesselKind kind) { return kind == VesselKind::portalVein ? VesselKind::vein : kind; };
  return plain(a) == plain(b) || a == VesselKind::other || b == VesselKind::other;
}

class Joiner {
 public:
  explicit Joiner(Centrelines& lines)
      : lines_(lines),
        joined_(2 * lines.lines.size()),
        hosts_(joined_.size(), kNone),
        parts_(lines.lines.size()) {
    for (const auto& line : lines.lines) kindOfPart_.push_back(line.kind);
    for (const auto& joint : lines.joints) {
      const std::uint32_t at = joint.host ? joint.host->line : joint.ends.front().line;
      for (const auto& end : joint.ends) unite(end.line, at);
      for (const auto& end : joint.ends) {
        joined_[2 * end.line + end.last] = true, pairs_.insert(pairOf(end.line, at));
        if (joint.host) hosts_[2 * end.line + end.last] = joint.host->line;
      }
    }
    for (const auto& line : lines.lines)
      for (std::size_t i = 0; i < line.samples.size(); ++i)
        cell_ = std::max({cell_, line.samples[i].w,
                          i > 0 ? glm::distance(vec3(line.samples[i]), vec3(line.samples[i - 1])) : 0.0f});
    for (std::uint32_t l = 0; l < lines.lines.size(); ++l)
      for (std::uint32_t i = 0; i < lines.lines[l].samples.size(); ++i)
        cells_[keyOf(cellOf(vec3(lines.lines[l].samples[i])))].push_back({l, i});
  }

  std::size_t run() {
    std::size_t count = 0;
    Checkpoints checkpoints;
    std::vector<std::pair<Centrelines::End, Found>> all;
    for (std::uint32_t l = 0; l < lines_.lines.size(); ++l)
      for (const bool last : {false, true}) {
        checkpoints.pass();
        if (joined_[2 * l + last] || comparisons_ > kMostComparisons) continue;
        if (const auto found = find({l, last})) all.push_back({{l, last}, *found});
      }
    std::ranges::stable_sort(all, {}, [](const auto& one) { return one.second.cost; });
    for (const auto& [end, found] : all) {
      checkpoints.pass();
      work_ += lines_.lines[found.line].samples.size() + lines_.joints.size();
      if (work_ > kMostWork) break;
      if (joined_[2 * end.line + end.last]) continue;
      // Where what it was nearest to turned out to be of another kind the next may do.
      const auto fits = isOfKind(end.line, found.line) ? found : find(end);
      if (fits && take(end, *fits)) ++count;
    }
    return count;
  }

 private:
  static std::uint64_t keyOf(glm::ivec3 cell) {
    const auto part = [](int v) { return std::uint64_t(std::uint32_t(v)) & 0x1fffff; };
    return part(cell.x) | part(cell.y) << 21 | part(cell.z) << 42;
  }
  glm::ivec3 cellOf(vec3 p) const { return glm::ivec3(glm::floor(p / cell_)); }
  vec4& sampleOf(const Centrelines::End& end) {
    auto& samples = lines_.lines[end.line].samples;
    return end.last ? samples.back() : samples.front();
  }

  std::optional<Found> find(const Centrelines::End& end) {
    const vec3 p(sampleOf(end));
    std::optional<Found> best;
    const glm::ivec3 middle = cellOf(p);
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto cell = cells_.find(keyOf(middle + glm::ivec3(x, y, z)));
          if (cell == cells_.end()) continue;
          comparisons_ += 2 * cell->second.size();
          for (const auto& [line, i] : cell->second)
            if (line != end.line && isOfKind(line, end.line))
              for (const std::uint32_t from : {i, i - 1}) look(p, end.last, line, from, best);
        }
    return best;
  }
  // Samples come in as ends are taken, so that a segment is looked for again then.
  Found nearestOn(std::uint32_t line, vec3 p) const {
    const auto& samples = lines_.lines[line].samples;
    Found best{line, 0, 0, 1e30f};
    for (std::uint32_t i = 0; i + 1 < samples.size(); ++i) {
      const float t = closestOnSegment(p, vec3(samples[i]), vec3(samples[i + 1]));
      if (const float d = glm::distance(vec3(glm::mix(samples[i], samples[i + 1], t)), p); d < best.cost)
        best = {line, i, t, d};
    }
    return best;
  }
  void look(vec3 p, bool last, std::uint32_t line, std::uint32_t from, std::optional<Found>& best) const {
    const auto& samples = lines_.lines[line].samples;
    if (from >= samples.size() - 1) return;  // also before the first
    const float t = closestOnSegment(p, vec3(samples[from]), vec3(samples[from + 1]));
    const vec4 at = glm::mix(samples[from], samples[from + 1], t);
    const float cost = glm::distance(vec3(at), p) / ((last ? kEndReach : kStartReach) * at.w);
    if (cost <= 1 && (!best || cost < best->cost)) best = Found{line, from, t, cost};
  }

  // A way there and back is no second join.
  static std::uint64_t pairOf(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
  }

  // Whether a line hangs on the side of one that hangs on one ... that is the other: an end that is led to
  // such a line would be led by itself.
  bool hangsOn(std::uint32_t line, std::uint32_t other) const {
    std::vector<std::uint32_t> chain{line};
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if (chain[i] == other) return true;
      for (const bool last : {false, true})
        if (const std::uint32_t host = hosts_[2 * chain[i] + last];
            host != kNone && std::ranges::find(chain, host) == chain.end())
          chain.push_back(host);
    }
    return false;
  }

  VesselKind& kindOfPart(std::uint32_t line) { return kindOfPart_[parts_.find(line)]; }
  // What hangs together is arteries or veins, also through lines of which nothing is told.
  bool isOfKind(std::uint32_t a, std::uint32_t b) { return mayBeOne(kindOfPart(a), kindOfPart(b)); }
  void unite(std::uint32_t a, std::uint32_t b) {
    const VesselKind told = kindOfPart(a) != VesselKind::other ? kindOfPart(a) : kindOfPart(b);
    parts_.unite(a, b);
    kindOfPart(a) = told;
  }

  bool take(const Centrelines::End& end, const Found& seen) {
    if (!join(end, seen)) return false;
    unite(end.line, seen.line);
    return true;
  }

  bool join(const Centrelines::End& end, const Found& seen) {
    if (!pairs_.insert(pairOf(end.line, seen.line)).second) return false;
    const Found found = nearestOn(seen.line, vec3(sampleOf(end)));
    auto& host = lines_.lines[found.line].samples;
    const vec4 at = glm::mix(host[found.segment], host[found.segment + 1], found.t);
    for (const bool last : {false, true}) {
      const vec4 tip = last ? host.back() : host.front();
      if (glm::distance(vec3(tip), vec3(at)) <= (joined_[2 * found.line + last] ? kSameSample : 1.0f) * tip.w)
        return meet(end, {found.line, last});
    }
    if (hangsOn(found.line, end.line)) return false;
    leadTo(end, at);
    hosts_[2 * end.line + end.last] = found.line;
    lines_.joints.push_back({Centrelines::Place{found.line, sampleAt(found.line, found.segment, at)}, {end}});
    joined_[2 * end.line + end.last] = true;
    return true;
  }

  bool meet(const Centrelines::End& end, const Centrelines::End& other) {
    const std::uint32_t host = hosts_[2 * other.line + other.last];
    if (host != kNone && hangsOn(host, end.line)) return false;
    hosts_[2 * end.line + end.last] = host;
    leadTo(end, sampleOf(other));
    joined_[2 * end.line + end.last] = true;
    for (auto& joint : lines_.joints)
      if (std::ranges::any_of(joint.ends, [&](const auto& own) {
            return own.line == other.line && own.last == other.last;
          })) {
        joint.ends.push_back(end);
        return true;
      }
    lines_.joints.push_back({std::nullopt, {other, end}});
    joined_[2 * other.line + other.last] = true;
    return true;
  }

  // With its own radius. A tip that is nearer than that is moved: a short step aside would be a kink.
  void leadTo(const Centrelines::End& end, const vec4& place) {
    auto& samples = lines_.lines[end.line].samples;
    vec4& tip = sampleOf(end);
    const vec4 target(vec3(place), tip.w);
    if (glm::distance(vec3(tip), vec3(place)) <= tip.w) {
      const vec4& next = end.last ? samples[samples.size() - 2] : samples[1];
      if (vec3(next) != vec3(place)) tip = target;
      return;
    }
    samples.insert(end.last ? samples.end() : samples.begin(), target);
    if (end.last) return;
    for (auto& joint : lines_.joints)
      if (joint.host && joint.host->line == end.line) ++joint.host->sample;
  }

  std::uint32_t sampleAt(std::uint32_t line, std::uint32_t segment, const vec4& at) {
    auto& host = lines_.lines[line].samples;
    for (const std::uint32_t s : {segment, segment + 1})
      if (glm::distance(vec3(host[s]), vec3(at)) <= kSameSample * at.w) return s;
    host.insert(host.begin() + segment + 1, at);
    for (auto& joint : lines_.joints)
      if (joint.host && joint.host->line == line && joint.host->sample > segment) ++joint.host->sample;
    return segment + 1;
  }

  Centrelines& lines_;
  std::vector<bool> joined_;
  std::vector<std::uint32_t> hosts_;    // of each end the line on whose side it hangs
  DisjointSets parts_;                  // of lines that hang together ...
  std::vector<VesselKind> kindOfPart_;  // ... and the kind that any of them has, at their root
  float cell_ = 1e-6f;
  std::unordered_map<std::uint64_t, std::vector<Centrelines::Place>> cells_;
  std::size_t comparisons_ = 0, work_ = 0;
  std::unordered_set<std::uint64_t> pairs_;  // of lines that are joined
};

}  // namespace

std::size_t joinTouchingLines(Centrelines& lines) { return Joiner(lines).run(); }

}  // namespace vasa
