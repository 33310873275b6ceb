#include "plate/label_choice.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>

#include "curve/bspline.h"
#include "realism/mirror.h"

namespace vasa::plate {
namespace {

constexpr int kSamples = 6;            // of a span, at which it is looked for in the picture
constexpr std::size_t kAnchors = 9;    // of a vessel
constexpr float kEnds = 0.08f;         // share of a seen stretch's ends that no line points at
constexpr float kOwnSide = 0.9f;       // share of a paired vessel's points on its own side of the body
constexpr float kMirrorReach = 0.04f;  // [body heights] by which the ends of a pair may differ

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = char(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string withoutSide(std::string_view name) {
  std::string out;
  for (std::size_t at = 0; at <= name.size();) {
    const std::size_t end = std::min(name.find(' ', at), name.size());
    const std::string_view word = name.substr(at, end - at);
    if (!word.empty() && word != "left" && word != "right")
      out += (out.empty() ? "" : " ") + std::string(word);
    at = end + 1;
  }
  return out;
}

float midline(const Network& network) {
  float low = 1e9f, high = -1e9f;
  for (const vec4& point : network.points()) low = std::min(low, point.x), high = std::max(high, point.x);
  return 0.5f * (low + high);
}

// Whether two vessels lie on either side of the body as mirror images do.
bool mirrorOneAnother(const Network& network, const Vessel& a, const Vessel& b) {
  const float middle = midline(network);
  const auto side = [&](const Vessel& vessel) {
    std::size_t left = 0;
    const auto points = network.pointsOf(vessel);
    for (const vec4& point : points) left += point.x > middle;
    const float share = float(left) / float(points.size());
    return share >= kOwnSide ? 1 : share <= 1 - kOwnSide ? -1 : 0;
  };
  if (side(a) * side(b) != -1) return false;
  const auto flipped = [&](vec4 p) { return vec3(2 * middle - p.x, p.y, p.z); };
  const auto pa = network.pointsOf(a), pb = network.pointsOf(b);
  const float reach = kMirrorReach * network.bodyHeight();
  return glm::distance(flipped(pa.front()), vec3(pb.front())) < reach &&
         glm::distance(flipped(pa.back()), vec3(pb.back())) < reach;
}

class Namer {
 public:
  explicit Namer(const Network& network) : network_(network) {
    for (std::uint32_t v = 0; v < network.vessels().size(); ++v)
      byName_.try_emplace(lower(network.vessels()[v].name), v);
  }

  std::string text(VesselId id) const {
    const Vessel& vessel = network_.vessel(id);
    const std::string name = lower(vessel.name);
    std::string shown = vessel.name;
    if (hasSide(name))
      if (const auto other = byName_.find(mirrored(name)); other != byName_.end() && other->first != name)
        if (mirrorOneAnother(network_, vessel, network_.vessels()[other->second])) shown = withoutSide(shown);
    if (!shown.empty()) shown[0] = char(std::toupper(static_cast<unsigned char>(shown[0])));
    return shown;
  }

 private:
  const Network& network_;
  std::map<std::string, std::uint32_t> byName_;
};

struct Stretch {
  std::vector<vec2> places;
  float length = 0;
};

// The runs of a vessel's centre line over cells that show this vessel.
std::vector<Stretch> seenStretches(const Network& network, std::uint32_t v, std::span<const vec4> points,
                                   const SeenMap& seen, float margin) {
  std::vector<Stretch> stretches;
  const Vessel& vessel = network.vessels()[v];
  bool open = false;
  for (std::uint32_t span = 0; span < vessel.spanCount(); ++span) {
    const Bezier tube = bezierOfSpan(network.pointsOf(vessel, points), span);
    for (int k = 0; k < kSamples; ++k) {
      vec2 cell;
      const bool there = seen.project(vec3(tube.at((float(k) + 0.5f) / kSamples)), cell) &&
                         cell.x >= margin && cell.y >= margin && cell.x < float(seen.width()) - margin &&
                         cell.y < float(seen.height()) - margin &&
                         seen.at(std::uint32_t(cell.x), std::uint32_t(cell.y)) == v;
      if (there && !open) stretches.emplace_back();
      open = there;
      if (!there) continue;
      Stretch& stretch = stretches.back();
      if (!stretch.places.empty()) stretch.length += glm::distance(stretch.places.back(), cell);
      stretch.places.push_back(cell);
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

// All labels that the picture can have, the largest first.
std::vector<VesselLabel> allLabels(const Network& network, std::span<const vec4> points, const SeenMap& seen,
                                   float margin) {
  std::vector<float> areas(network.vessels().size());
  for (const std::uint32_t what : seen.cells())
    if (what < areas.size()) ++areas[what];
  const Namer namer(network);
  std::vector<VesselLabel> labels;
  std::map<std::string, std::size_t> byText;
  std::vector<std::vector<Stretch>> stretches;
  for (std::uint32_t v = 0; v < areas.size(); ++v) {
    if (areas[v] == 0) continue;
    std::string text = namer.text({v});
    if (text.empty()) continue;
    const auto [place, isNew] = byText.try_emplace(text, labels.size());
    if (isNew) labels.push_back({std::move(text), {}, {}, 0, 0}), stretches.emplace_back();
    VesselLabel& label = labels[place->second];
    label.vessels.push_back({v});
    label.area += areas[v];
    for (Stretch& stretch : seenStretches(network, v, points, seen, margin)) {
      label.length += stretch.length;
      stretches[place->second].push_back(std::move(stretch));
    }
  }
  for (std::size_t i = 0; i < labels.size(); ++i) labels[i].anchors = anchorsOf(stretches[i]);
  std::erase_if(labels, [](const VesselLabel& label) { return label.anchors.empty(); });
  std::ranges::stable_sort(labels, std::greater{}, &VesselLabel::area);
  return labels;
}

bool contains(std::span<const VesselId> vessels, VesselId id) {
  return std::ranges::any_of(vessels, [&](VesselId v) { return v.value == id.value; });
}

// The vessels of a name: those that are called so, with or without their side; else those it is a part of,
// if these have one text.
Result<std::vector<VesselId>> vesselsCalled(const Network& network, const std::string& name) {
  const std::string wanted = lower(name);
  const Namer namer(network);
  std::vector<VesselId> exact, bare, partly;
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const std::string own = lower(network.vessels()[v].name);
    if (own == wanted) exact.push_back({v});
    if (lower(namer.text({v})) == wanted) bare.push_back({v});
    if (own.find(wanted) != own.npos) partly.push_back({v});
  }
  if (!exact.empty()) return exact;
  if (!bare.empty()) return bare;
  if (partly.empty())
    return badInput("--labels: no vessel is named '" + name + "'; vasa info --vessels lists them");
  const std::string first = namer.text(partly.front());
  for (const VesselId id : partly)
    if (namer.text(id) != first)
      return badInput("--labels: '" + name + "' is a part of several names, '" + first + "' and '" +
                      namer.text(id) + "'; give the whole name");
  return partly;
}

Result<LabelChoice> chooseByName(const Network& network, std::vector<VesselLabel> all,
                                 const std::string& list) {
  LabelChoice choice;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    std::string name = list.substr(at, end - at);
    at = end + 1;
    name.erase(0, std::min(name.find_first_not_of(' '), name.size()));
    name.erase(name.find_last_not_of(' ') + 1);
    if (name.empty()) continue;
    const auto vessels = vesselsCalled(network, name);
    if (!vessels) return vessels.error();
    const auto label = std::ranges::find_if(all, [&](const VesselLabel& candidate) {
      return std::ranges::any_of(*vessels, [&](VesselId id) { return contains(candidate.vessels, id); });
    });
    if (label == all.end()) {
      choice.unseen.push_back(name);
      continue;
    }
    choice.labels.push_back(std::move(*label));
    all.erase(label);
  }
  return choice;
}

}  // namespace

std::string labelText(const Network& network, VesselId vessel) { return Namer(network).text(vessel); }

Result<LabelChoice> chooseLabels(const Network& network, std::span<const vec4> points, const SeenMap& seen,
                                 const LabelWishes& wishes) {
  std::vector<VesselLabel> all = allLabels(network, points, seen, wishes.margin);
  if (wishes.which != "main" && wishes.which != "all-visible")
    return chooseByName(network, std::move(all), wishes.which);
  if (wishes.which == "main")
    std::erase_if(all, [&](const VesselLabel& label) {
      return label.length < wishes.leastLength || label.area < wishes.leastWidth * label.length;
    });
  if (all.size() > wishes.most) all.resize(wishes.most);
  return LabelChoice{std::move(all), {}};
}

}  // namespace vasa::plate
