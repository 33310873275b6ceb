#include "plate/label_choice.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>

#include "core/letters.h"
#include "curve/bspline.h"
#include "plate/label_names.h"

namespace vasa::plate {
namespace {

constexpr int kSamples = 12;            // of a span, at which it is looked for in the picture
constexpr std::size_t kAnchors = 9;     // of a vessel
constexpr std::size_t kRowAnchors = 3;  // of a vessel that is one of a row
constexpr float kEnds = 0.08f;          // share of a seen stretch's ends that no line points at

struct Stretch {
  std::vector<vec2> places;
  float length = 0;
  float width = 0;   // sum over the places
  float weight = 0;  // square of the radius, summed along it
};

// The runs of a vessel's centre line over cells that show this vessel.
std::vector<Stretch> seenStretches(const Network& network, std::uint32_t v, std::span<const vec4> points,
                                   const SeenMap& seen, const LabelWishes& wishes) {
  std::vector<Stretch> stretches;
  const Vessel& vessel = network.vessels()[v];
  bool open = false;
  for (std::uint32_t span = 0; span < vessel.spanCount(); ++span) {
    const Bezier tube = bezierOfSpan(network.pointsOf(vessel, points), span);
    for (int k = 0; k < kSamples; ++k) {
      vec2 cell;
      const vec4 place = tube.at((float(k) + 0.5f) / kSamples);
      const bool there = seen.project(vec3(place), cell) && cell.x >= 0 && cell.y >= 0 &&
                         cell.x < float(seen.width()) && cell.y < float(seen.height()) &&
                         seen.at(std::uint32_t(cell.x), std::uint32_t(cell.y)) == v &&
                         (!wishes.allowed || wishes.allowed(cell));
      if (there && !open) stretches.emplace_back();
      open = there;
      if (!there) continue;
      Stretch& stretch = stretches.back();
      if (!stretch.places.empty()) {
        const float step = glm::distance(stretch.places.back(), cell);
        stretch.length += step;
        stretch.weight += step * place.w * place.w;
      }
      stretch.places.push_back(cell);
      stretch.width += 2 * place.w * seen.cellsAMetre(vec3(place));
    }
  }
  return stretches;
}

// Places spread over the stretches, the middle of the longest one first.
std::vector<vec2> anchorsOf(std::vector<Stretch>& stretches) {
  std::ranges::stable_sort(stretches, std::greater{}, &Stretch::length);
  std::vector<vec2> anchors;
  for (const Stretch& stretch : stretches) {
    if (anchors.size() >= kAnchors) break;
    if (!anchors.empty() && stretch.length < 0.25f * stretches.front().length) break;
    const std::size_t count = std::min(kAnchors - anchors.size(), std::max<std::size_t>(1, kAnchors / 2 + 2));
    for (std::size_t k = 0; k < count; ++k) {
      // From the middle outwards.
      const float step = float((k + 1) / 2) / float(count / 2 + 1) * (k % 2 ? 1.0f : -1.0f);
      const float share = 0.5f + (0.5f - kEnds) * step;
      const auto at = std::size_t(std::lround(share * float(stretch.places.size() - 1)));
      if (std::ranges::find(anchors, stretch.places[at]) == anchors.end())
        anchors.push_back(stretch.places[at]);
    }
  }
  return anchors;
}

// All labels that the picture can have, the weightiest first.
std::vector<VesselLabel> allLabels(const Network& network, std::span<const vec4> points, const SeenMap& seen,
                                   const LabelWishes& wishes) {
  std::vector<float> areas(network.vessels().size());
  for (const std::uint32_t what : seen.cells())
    if (what < areas.size()) ++areas[what];
  const LabelNames names(network);
  std::vector<VesselLabel> labels;
  std::map<std::string, std::size_t> byText;
  std::vector<std::vector<Stretch>> stretches;
  for (std::uint32_t v = 0; v < areas.size(); ++v) {
    if (areas[v] == 0) continue;
    std::string text = names.of({v});
    if (text.empty()) continue;
    const auto [place, isNew] = byText.try_emplace(text, labels.size());
    if (isNew) labels.push_back({.text = std::move(text)}), stretches.emplace_back();
    VesselLabel& label = labels[place->second];
    label.vessels.push_back({v});
    label.area += areas[v];
    float weight = 0;
    for (Stretch& stretch : seenStretches(network, v, points, seen, wishes)) {
      weight += stretch.weight;
      stretches[place->second].push_back(std::move(stretch));
    }
    label.weight = std::max(label.weight, weight);
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    std::size_t count = 0;
    for (const Stretch& stretch : stretches[i])
      labels[i].width += stretch.width, count += stretch.places.size();
    if (count > 0) labels[i].width /= float(count);
    labels[i].anchors = anchorsOf(stretches[i]);
  }
  std::erase_if(labels, [](const VesselLabel& label) { return label.anchors.empty(); });
  std::ranges::stable_sort(labels, std::greater{}, &VesselLabel::weight);
  return labels;
}

// One label for a row of alike vessels, where its weightiest one stands.
std::vector<VesselLabel> rowsAsOne(std::vector<VesselLabel> labels) {
  std::vector<VesselLabel> rows;
  std::map<std::string, std::size_t> byRow;
  for (VesselLabel& label : labels) {
    std::string row = rowOf(label.text);
    const auto [place, isNew] = byRow.try_emplace(row, rows.size());
    if (isNew) {
      rows.push_back(std::move(label));
      continue;
    }
    VesselLabel& first = rows[place->second];
    first.text = plural(std::move(row));
    first.vessels.insert(first.vessels.end(), label.vessels.begin(), label.vessels.end());
    const auto some = std::min(label.anchors.size(), kRowAnchors);
    first.anchors.insert(first.anchors.end(), label.anchors.begin(),
                         label.anchors.begin() + std::ptrdiff_t(some));
    first.area += label.area;
  }
  return rows;
}

// Leaves out "anterior branch of X" and "lateral X" beside X, or beside the row that X is one of.
void leaveOutKin(std::vector<VesselLabel>& labels) {
  std::set<std::string> named;
  for (const VesselLabel& label : labels) named.insert(lowerCase(label.text));
  std::erase_if(labels, [&](const VesselLabel& label) {
    const std::string parent = namedAfter(label.text);
    return named.contains(parent) || named.contains(lowerCase(plural(rowOf(parent))));
  });
}

bool contains(std::span<const VesselId> vessels, VesselId id) {
  return std::ranges::any_of(vessels, [&](VesselId v) { return v.value == id.value; });
}

// The vessels of a name: those that are called so, with or without their side; else all whose names it is a
// part of.
Result<std::vector<VesselId>> vesselsCalled(const Network& network, const LabelNames& names,
                                            const std::string& name) {
  const std::string wanted = lowerCase(name);
  std::vector<VesselId> exact, bare, partly;
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const std::string own = lowerCase(network.vessels()[v].name);
    if (own == wanted) exact.push_back({v});
    if (lowerCase(names.of({v})) == wanted) bare.push_back({v});
    if (own.find(wanted) != own.npos) partly.push_back({v});
  }
  if (!exact.empty()) return exact;
  if (!bare.empty()) return bare;
  if (partly.empty())
    return badInput("--labels: no vessel is named '" + name + "'; vasa info NET.vasa --vessels lists them");
  return partly;
}

// Where the name at the beginning of a list ends: at the first comma, or behind a vessel's whole name, with
// or without its side, that holds commas itself.
std::size_t endOfName(const Network& network, const LabelNames& names, const std::string& list,
                      std::size_t at) {
  const std::string rest = lowerCase(list.substr(at));
  std::size_t end = std::min(rest.find(','), rest.size());
  if (end == rest.size()) return at + end;
  const auto tryName = [&](const std::string& name) {
    if (name.size() <= end || name.find(',') == name.npos || !rest.starts_with(lowerCase(name))) return;
    const std::size_t next = std::min(rest.find_first_not_of(' ', name.size()), rest.size());
    if (next == rest.size() || rest[next] == ',') end = next;
  };
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v)
    tryName(network.vessels()[v].name), tryName(names.of({v}));
  return at + end;
}

Result<LabelChoice> chooseByName(const Network& network, std::vector<VesselLabel> all,
                                 const std::string& list) {
  LabelChoice choice;
  const LabelNames names(network);
  for (std::size_t at = 0; at <= list.size();) {
    at = std::min(list.find_first_not_of(' ', at), list.size());
    const std::size_t end = endOfName(network, names, list, at);
    std::string name = list.substr(at, end - at);
    at = end + 1;
    name.erase(name.find_last_not_of(' ') + 1);
    if (name.empty()) continue;
    const auto vessels = vesselsCalled(network, names, name);
    if (!vessels) return vessels.error();
    const auto isMeant = [&](const VesselLabel& label) {
      return std::ranges::any_of(*vessels, [&](VesselId id) { return contains(label.vessels, id); });
    };
    const auto meant = std::stable_partition(all.begin(), all.end(), std::not_fn(isMeant));
    std::move(meant, all.end(), std::back_inserter(choice.labels));
    all.erase(meant, all.end());
    if (std::ranges::none_of(choice.labels, isMeant)) choice.unseen.push_back(name);
  }
  return choice;
}

}  // namespace

Result<LabelChoice> chooseLabels(const Network& network, std::span<const vec4> points, const SeenMap& seen,
                                 const LabelWishes& wishes) {
  std::vector<VesselLabel> all = allLabels(network, points, seen, wishes);
  if (wishes.which != "main" && wishes.which != "all-visible")
    return chooseByName(network, std::move(all), wishes.which);
  std::erase_if(all, [&](const VesselLabel& label) {
    const auto meant = [&](VesselId id) { return wishes.of.empty() || wishes.of[id.value]; };
    return isNumbered(label.text) || std::ranges::none_of(label.vessels, meant);
  });
  if (wishes.which == "main") {
    std::erase_if(all, [&](const VesselLabel& label) {
      return label.area < wishes.leastArea || label.width < wishes.leastWidth;
    });
    all = rowsAsOne(std::move(all));
    leaveOutKin(all);
  }
  if (all.size() > wishes.most) all.resize(wishes.most);
  return LabelChoice{std::move(all), {}};
}

}  // namespace vasa::plate
