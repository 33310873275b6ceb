#include <algorithm>

#include "core/cancellation.h"
#include "core/ids.h"
#include "io/swc.h"

// An SWC file's forest of samples and vessels: both ways.
namespace vasa {
namespace {

// The children of each sample in the file's order, in one list.
class Children {
 public:
  explicit Children(std::span<const SwcSample> samples) : first_(samples.size() + 1) {
    for (const SwcSample& sample : samples)
      if (sample.parent != kNone) ++first_[sample.parent + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    all_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < samples.size(); ++i)
      if (samples[i].parent != kNone) all_[next[samples[i].parent]++] = i;
  }
  std::span<const std::uint32_t> of(std::uint32_t sample) const {
    return std::span(all_).subspan(first_[sample], first_[sample + 1] - first_[sample]);
  }

 private:
  std::vector<std::uint32_t> first_, all_;
};

// How well a child continues the way that led to its parent.
float continuity(std::span<const SwcSample> samples, std::uint32_t before, std::uint32_t at,
                 std::uint32_t child) {
  const auto unit = [&](std::uint32_t from, std::uint32_t to) {
    const vec3 d = samples[to].position - samples[from].position;
    const float length = glm::length(d);
    return length > 0 ? d / length : vec3(0);
  };
  const float straight = before == kNone ? 0 : glm::dot(unit(before, at), unit(at, child));
  const float a = samples[at].radius, b = samples[child].radius;
  return straight + 0.5f * std::min(a, b) / std::max(a, b);
}

class Tree {
 public:
  Tree(std::span<const SwcSample> samples, const std::string& name, VesselKind kind)
      : samples_(samples), name_(name), kind_(kind), children_(samples) {}

  Centrelines run() {
    for (std::uint32_t i = 0; i < samples_.size(); ++i) {
      if (samples_[i].parent != kNone) continue;
      pending_.push_back({kNone, i, {}});
      checkpoints_.pass();
      while (!pending_.empty()) {
        const Start start = pending_.back();
        pending_.pop_back();
        follow(start);
      }
    }
    return std::move(out_);
  }

 private:
  struct Start {
    std::uint32_t fork;   // the sample that it leaves; none at a root
    std::uint32_t first;  // its own first sample
    std::optional<Centrelines::Place> host;
  };

  void follow(const Start& start) {
    Centrelines::Line line{{}, {}, kindOfSwcType(samples_[start.first].type).value_or(kind_), {}};
    const auto number = std::uint32_t(out_.lines.size());
    std::vector<Start> branches;
    if (start.fork != kNone)
      line.samples.push_back(vec4(samples_[start.fork].position, samples_[start.first].radius));
    std::uint32_t before = start.fork, at = start.first;
    while (true) {
      checkpoints_.pass();
      const vec4 section(samples_[at].position, samples_[at].radius);
      if (line.samples.empty() || vec3(line.samples.back()) != vec3(section)) line.samples.push_back(section);
      const auto children = children_.of(at);
      if (children.empty()) break;
      std::uint32_t next = children[0];
      for (const std::uint32_t child : children)
        if (continuity(samples_, before, at, child) > continuity(samples_, before, at, next)) next = child;
      for (const std::uint32_t child : children)
        if (child != next)
          branches.push_back({at, child, Centrelines::Place{number, std::uint32_t(line.samples.size() - 1)}});
      before = at;
      at = next;
    }
    if (line.samples.size() < 2) {
      // No line: what branches off this place branches off the one before, or starts on its own.
      for (Start& branch : branches) branch.host = start.host;
      pending_.insert(pending_.end(), branches.rbegin(), branches.rend());
      return;
    }
    line.name = name_ + " " + std::to_string(number + 1);
    out_.lines.push_back(std::move(line));
    if (start.host) out_.joints.push_back({start.host, {{number, false}}});
    pending_.insert(pending_.end(), branches.rbegin(), branches.rend());
  }

  std::span<const SwcSample> samples_;
  std::string name_;
  VesselKind kind_;
  Children children_;
  std::vector<Start> pending_;
  Checkpoints checkpoints_;
  Centrelines out_;
};

class Forest {
 public:
  explicit Forest(const Centrelines& centrelines)
      : lines_(centrelines), first_(centrelines.lines.size() + 1) {
    for (std::size_t i = 0; i < lines_.lines.size(); ++i)
      first_[i + 1] = first_[i] + std::uint32_t(lines_.lines[i].samples.size());
    neighbours_.resize(first_.back());
    same_.resize(first_.back());
    for (std::uint32_t i = 0; i < first_.back(); ++i) same_[i] = i;
    for (const auto& joint : lines_.joints) unite(joint);
    for (std::uint32_t line = 0; line < lines_.lines.size(); ++line)
      for (std::uint32_t s = first_[line]; s + 1 < first_[line + 1]; ++s) link(s, s + 1);
  }

  std::vector<SwcSample> run() {
    numberOf_.assign(first_.back(), kNone);
    for (std::uint32_t s = 0; s < first_.back(); ++s)
      if (same_[s] == s && numberOf_[s] == kNone) grow(s);
    return std::move(out_);
  }

 private:
  std::uint32_t sampleOf(const Centrelines::End& end) const {
    return end.last ? first_[end.line + 1] - 1 : first_[end.line];
  }
  // An end and the place it meets are one sample, the host's.
  void unite(const Centrelines::Joint& joint) {
    const std::uint32_t target =
        joint.host ? first_[joint.host->line] + joint.host->sample : sampleOf(joint.ends.front());
    for (const auto& end : joint.ends) same_[sampleOf(end)] = target;
  }
  std::uint32_t root(std::uint32_t s) const {
    while (same_[s] != s) s = same_[s];
    return s;
  }
  void link(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    if (a == b) return;
    neighbours_[a].push_back(b);
    neighbours_[b].push_back(a);
  }
  void put(std::uint32_t s, std::uint32_t parent) {
    const auto number = std::upper_bound(first_.begin(), first_.end(), s) - first_.begin() - 1;
    const Centrelines::Line& line = lines_.lines[std::size_t(number)];
    const vec4 at = line.samples[s - first_[std::size_t(number)]];
    out_.push_back({std::int64_t(out_.size()) + 1, swcTypeOf(line.kind), vec3(at), at.w, parent});
  }
  // Depth first, so that a line's samples follow one another. A sample that is reached twice closes a loop:
  // its double becomes a tip.
  void grow(std::uint32_t start) {
    struct Step {
      std::uint32_t sample, from;
    };
    std::vector<Step> stack{{start, kNone}};
    while (!stack.empty()) {
      const auto [s, from] = stack.back();
      stack.pop_back();
      const std::uint32_t parent = from == kNone ? kNone : numberOf_[from];
      if (numberOf_[s] != kNone) {
        if (out_[parent].parent != numberOf_[s]) put(s, parent);
        continue;
      }
      numberOf_[s] = std::uint32_t(out_.size());
      put(s, parent);
      bool cameFrom = false;
      for (auto it = neighbours_[s].rbegin(); it != neighbours_[s].rend(); ++it) {
        if (*it == from && !cameFrom) {
          cameFrom = true;
          continue;
        }
        if (numberOf_[*it] == kNone) stack.push_back({*it, s});
      }
    }
  }

  const Centrelines& lines_;
  std::vector<std::uint32_t> first_, same_, numberOf_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
  std::vector<SwcSample> out_;
};

}  // namespace

// SWC's own types are 0 to 5 (undefined, soma, axon, dendrites, branch), users' begin at 6; in tens they are
// ours.
constexpr std::int64_t kFirstType = 10;

std::optional<VesselKind> kindOfSwcType(std::int64_t type) {
  const std::int64_t kind = type - kFirstType;
  if (kind < 0 || kind >= std::int64_t(VesselKind::other)) return std::nullopt;
  return VesselKind(kind);
}

std::int64_t swcTypeOf(VesselKind kind) {
  return kind == VesselKind::other ? 0 : kFirstType + std::int64_t(kind);
}

Centrelines centrelinesOfSwc(std::span<const SwcSample> samples, const std::string& name,
                             VesselKind otherwise) {
  return Tree(samples, name, otherwise).run();
}

std::vector<SwcSample> swcOfCentrelines(const Centrelines& centrelines) { return Forest(centrelines).run(); }

}  // namespace vasa
