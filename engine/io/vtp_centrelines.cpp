#include <algorithm>
#include <compare>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "io/chain_lines.h"
#include "io/vtp.h"
#include "math/closest_point.h"

// VMTK's centre lines all run from an inlet to an outlet, so the way they have in common is in the file
// several times, nearly but not exactly alike. Here the longest line is taken whole, and of every other one
// what does not run along a line taken before.
namespace vasa {
namespace {

// Two samples tell the same when their centres and their radii differ by less than this share of the radius.
constexpr float kSameCentre = 0.05f, kSameRadius = 0.01f;
constexpr float kDetourRadii = 4, kBifurcationRadii = 4;
// Comparisons with lines taken before; what VMTK writes needs some ten a point. Where one step is as long as
// a thousand others, all of these fall into one cell.
constexpr std::size_t kComparisonsAPoint = 1000, kFreeComparisons = 100'000'000;

using Samples = std::vector<vec4>;

std::uint64_t cellKey(glm::ivec3 cell) {
  const auto part = [](int v) { return std::uint64_t(std::uint32_t(v)) & 0x1fffff; };
  return part(cell.x) | part(cell.y) << 21 | part(cell.z) << 42;
}

// The lines taken so far, found by place. Cells are as wide as the longest step of any line, so that a
// segment near a place has an end in that place's cell or beside it.
class Taken {
 public:
  explicit Taken(float cell) : cell_(cell) {}

  void add(std::uint32_t line, const Samples& samples) {
    for (std::uint32_t i = 0; i < samples.size(); ++i)
      cells_[cellKey(cellOf(samples[i]))].push_back({line, i});
    lines_.resize(std::max<std::size_t>(lines_.size(), line + 1));
    lines_[line] = samples;
  }
  // The sample nearest to where a line passes within the tolerance.
  std::optional<Centrelines::Place> sameAs(const vec4& sample) {
    std::optional<Centrelines::Place> best;
    float least = kSameCentre * sample.w;
    const glm::ivec3 middle = cellOf(sample);
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto cell = cells_.find(cellKey(middle + glm::ivec3(x, y, z)));
          if (cell == cells_.end()) continue;
          comparisons += 2 * cell->second.size();
          for (const auto& [line, i] : cell->second)
            for (const std::uint32_t from : {i, i - 1}) look(sample, line, from, least, best);
        }
    return best;
  }
  std::size_t comparisons = 0;  ///< so far

 private:
  glm::ivec3 cellOf(const vec4& p) const { return glm::ivec3(glm::floor(vec3(p) / cell_)); }
  void look(const vec4& sample, std::uint32_t line, std::uint32_t from, float& least,
            std::optional<Centrelines::Place>& best) const {
    const Samples& samples = lines_[line];
    if (from >= samples.size() - 1) return;  // also before the first
    const vec4 &a = samples[from], &b = samples[from + 1];
    const float t = closestOnSegment(vec3(sample), vec3(a), vec3(b));
    const vec4 at = glm::mix(a, b, t);
    const float distance = glm::distance(vec3(at), vec3(sample));
    if (distance > least || std::abs(at.w - sample.w) > kSameRadius * sample.w) return;
    least = distance;
    best = Centrelines::Place{line, from + (t > 0.5f ? 1u : 0u)};
  }

  float cell_;
  std::unordered_map<std::uint64_t, std::vector<Centrelines::Place>> cells_;
  std::vector<Samples> lines_;
};

void append(Samples& samples, const vec4& sample) {
  if (samples.empty() || vec3(samples.back()) != vec3(sample)) samples.push_back(sample);
}

Samples samplesOf(const VtpLines& file, std::uint32_t line) {
  Samples samples;
  for (const std::uint32_t point : file.lines[line]) append(samples, file.points[point]);
  return samples;
}

// Whether a tract goes on in the next: no farther off than the samples of either, or than a bifurcation is
// long, whose tracts may have been left out.
bool goesOnIn(const Samples& tract, const Samples& next) {
  if (tract.empty() || next.empty()) return true;
  float farthest = kBifurcationRadii * std::max(tract.back().w, next.front().w);
  for (const Samples* samples : {&tract, &next})
    for (std::size_t i = 1; i < samples->size(); ++i)
      farthest = std::max(farthest, glm::distance(vec3((*samples)[i - 1]), vec3((*samples)[i])));
  return glm::distance(vec3(tract.back()), vec3(next.front())) <= farthest;
}

// Whole centre lines: the tracts with the same id, in order. Where files were put together their numbers come
// again: with the first that was there another file's begin. No line leaps to a tract that it does not meet.
std::vector<Samples> wholeLines(const VtpLines& file) {
  const auto *ids = file.find("CenterlineIds"), *tracts = file.find("TractIds");
  struct Tract {
    std::size_t source;  // of the files that were put together
    std::int64_t line, number;
    auto operator<=>(const Tract&) const = default;
  };
  std::map<Tract, std::uint32_t> order;
  std::size_t source = 0;
  for (std::uint32_t i = 0; i < file.lines.size(); ++i) {
    const bool divided = ids && tracts;
    Tract tract{source, divided ? ids->values[i] : i, divided ? tracts->values[i] : 0};
    if (order.contains(tract)) tract.source = ++source;
    order.emplace(tract, i);
  }
  std::vector<Samples> lines;
  const Tract* last = nullptr;
  Samples before;
  for (const auto& [tract, i] : order) {
    Samples samples = samplesOf(file, i);
    const bool isNew = !last || last->source != tract.source || last->line != tract.line;
    if (isNew || !goesOnIn(before, samples)) lines.emplace_back();
    for (const vec4& sample : samples) append(lines.back(), sample);
    last = &tract;
    before = std::move(samples);
  }
  std::erase_if(lines, [](const Samples& samples) { return samples.size() < 2; });
  return lines;
}

float lengthOf(const Samples& samples) {
  float sum = 0;
  for (std::size_t i = 1; i < samples.size(); ++i)
    sum += glm::distance(vec3(samples[i - 1]), vec3(samples[i]));
  return sum;
}

class Merger {
 public:
  explicit Merger(std::vector<Samples> lines) : lines_(std::move(lines)), taken_(cellSize(lines_)) {}

  /// Nothing where it takes too long.
  std::optional<Centrelines> run() {
    std::size_t most = kFreeComparisons;
    for (const Samples& line : lines_) most += kComparisonsAPoint * line.size();
    std::vector<std::uint32_t> order(lines_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::vector<float> lengths;
    for (const Samples& line : lines_) lengths.push_back(lengthOf(line));
    std::ranges::stable_sort(order, std::greater{}, [&](std::uint32_t i) { return lengths[i]; });
    for (const std::uint32_t i : order) {
      takeWhatIsNew(lines_[i], most);
      if (taken_.comparisons > most) return std::nullopt;
    }
    return std::move(out_);
  }

 private:
  static float cellSize(const std::vector<Samples>& lines) {
    float longest = 1e-6f;
    for (const Samples& line : lines)
      for (std::size_t i = 1; i < line.size(); ++i)
        longest =
            std::max({longest, glm::distance(vec3(line[i - 1]), vec3(line[i])), kSameCentre * line[i].w});
    return longest;
  }

  // A run of samples that no line taken before has, led to those beside it.
  void takeWhatIsNew(const Samples& line, std::size_t mostComparisons) {
    std::vector<std::optional<Centrelines::Place>> known;
    for (const vec4& sample : line) {
      if (taken_.comparisons > mostComparisons) return;
      known.push_back(taken_.sameAs(sample));
    }
    for (std::size_t i = 0; i < line.size();) {
      if (known[i]) {
        ++i;
        continue;
      }
      const std::size_t first = i;
      while (i < line.size() && !known[i]) ++i;
      const auto before = first > 0 ? known[first - 1] : std::nullopt,
                 after = i < line.size() ? known[i] : std::nullopt;
      addRun({line.begin() + std::ptrdiff_t(first), line.begin() + std::ptrdiff_t(i)}, before, after);
    }
  }

  void addRun(Samples own, std::optional<Centrelines::Place> before,
              std::optional<Centrelines::Place> after) {
    const auto placeOf = [&](const Centrelines::Place& p) {
      return vec3(out_.lines[p.line].samples[p.sample]);
    };
    Samples samples;
    if (before) samples.push_back(vec4(placeOf(*before), own.front().w));
    for (const vec4& sample : own) append(samples, sample);
    if (after) append(samples, vec4(placeOf(*after), own.back().w));
    if (samples.size() < 2) return;
    if (before && after && before->line == after->line && runsWithin(samples, *before, *after)) return;
    const auto number = std::uint32_t(out_.lines.size());
    out_.lines.push_back({{}, {}, VesselKind::other, std::move(samples)});
    taken_.add(number, out_.lines.back().samples);
    if (before) out_.joints.push_back({before, {{number, false}}});
    if (after) out_.joints.push_back({after, {{number, true}}});
  }

  // Where the same way was traced twice the traces part by a little now and then, within the vessel; what
  // leaves it is a way of its own, however short.
  bool runsWithin(const Samples& run, Centrelines::Place before, Centrelines::Place after) {
    const Samples& host = out_.lines[before.line].samples;
    const std::size_t first = std::min(before.sample, after.sample),
                      last = std::max(before.sample, after.sample);
    if (lengthOf(run) >= kDetourRadii * host[first].w) return false;
    taken_.comparisons += run.size() * (last - first + 1);
    return std::ranges::all_of(run, [&](const vec4& sample) {
      for (std::size_t i = first; i <= last; ++i) {
        const vec4 &a = host[i], &b = host[std::min(i + 1, last)];
        const vec4 at = glm::mix(a, b, closestOnSegment(vec3(sample), vec3(a), vec3(b)));
        if (glm::distance(vec3(at), vec3(sample)) <= at.w) return true;
      }
      return false;
    });
  }

  std::vector<Samples> lines_;
  Taken taken_;
  Centrelines out_;
};

struct PlaceOrder {
  bool operator()(const vec3& a, const vec3& b) const {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  }
};

// Joins free ends that lie exactly on a sample of another line.
void joinAtSamePlace(Centrelines& lines) {
  std::map<vec3, std::vector<Centrelines::Place>, PlaceOrder> inside;
  std::vector<std::pair<vec3, Centrelines::End>> ends;
  for (std::uint32_t i = 0; i < lines.lines.size(); ++i) {
    const auto& samples = lines.lines[i].samples;
    for (std::uint32_t k = 1; k + 1 < samples.size(); ++k) inside[vec3(samples[k])].push_back({i, k});
    ends.push_back({vec3(samples.front()), {i, false}});
    ends.push_back({vec3(samples.back()), {i, true}});
  }
  std::vector<std::uint8_t> joined(ends.size(), 0);
  for (const auto& joint : lines.joints)
    for (const auto& end : joint.ends) joined[2 * end.line + end.last] = 1;
  std::map<vec3, std::uint32_t, PlaceOrder> jointAt;
  for (const auto& [place, end] : ends) {
    if (joined[2 * end.line + end.last]) continue;
    const auto [found, fresh] = jointAt.emplace(place, std::uint32_t(lines.joints.size()));
    if (fresh) lines.joints.emplace_back();
    lines.joints[found->second].ends.push_back(end);
  }
  for (const auto& [place, number] : jointAt) {
    auto& joint = lines.joints[number];
    const auto hosts = inside.find(place);
    if (hosts == inside.end()) continue;
    std::set<std::uint32_t> own;
    for (const auto& end : joint.ends) own.insert(end.line);
    const auto other =
        std::ranges::find_if(hosts->second, [&](const auto& host) { return !own.contains(host.line); });
    if (other != hosts->second.end()) joint.host = *other;
  }
  std::erase_if(lines.joints, [](const auto& joint) { return !joint.host && joint.ends.size() < 2; });
}

}  // namespace

Result<Centrelines> centrelinesOfVtp(const VtpLines& file, const std::string& name, VesselKind kind) {
  const auto *vessels = file.find("VesselIds"), *kinds = file.find("VesselKinds");
  Centrelines result;
  if (vessels) {
    for (std::uint32_t i = 0; i < file.lines.size(); ++i) {
      Samples samples = samplesOf(file, i);
      if (samples.size() < 2) continue;
      const auto id = std::size_t(std::max(vessels->values[i], 0));
      const int told = kinds ? kinds->values[i] : -1;
      result.lines.push_back({id < file.names.size() ? file.names[id] : std::string{},
                              {},
                              told >= 0 && told <= int(VesselKind::other) ? VesselKind(told) : kind,
                              std::move(samples)});
    }
  } else {
    // VMTK numbers its lines; others' are cut up anyhow.
    auto whole = wholeLines(file);
    auto merged = Merger(file.find("CenterlineIds") ? std::move(whole) : chainLines(whole)).run();
    if (!merged)
      return badInput("its lines lie so close to one another that telling them apart takes more than " +
                      std::to_string(kComparisonsAPoint) +
                      " comparisons a point; leave out lines that are traced several times, or long steps");
    result = std::move(*merged);
    for (auto& line : result.lines) line.kind = kind;
  }
  for (std::size_t i = 0; i < result.lines.size(); ++i)
    if (result.lines[i].name.empty()) result.lines[i].name = name + " " + std::to_string(i + 1);
  joinAtSamePlace(result);
  return result;
}

VtpLines vtpOfCentrelines(const Centrelines& centrelines) {
  VtpLines file;
  std::vector<std::int32_t> numbers, zeros, kinds;
  for (std::uint32_t i = 0; i < centrelines.lines.size(); ++i) {
    const auto& line = centrelines.lines[i];
    std::vector<std::uint32_t> cell;
    for (const vec4& sample : line.samples) {
      cell.push_back(std::uint32_t(file.points.size()));
      file.points.push_back(sample);
    }
    file.lines.push_back(std::move(cell));
    file.names.push_back(line.name);
    numbers.push_back(std::int32_t(i));
    zeros.push_back(0);
    kinds.push_back(std::int32_t(line.kind));
  }
  file.cellArrays = {{"CenterlineIds", numbers}, {"TractIds", zeros},    {"GroupIds", numbers},
                     {"Blanking", zeros},        {"VesselIds", numbers}, {"VesselKinds", kinds}};
  return file;
}

}  // namespace vasa
