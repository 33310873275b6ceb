#include "plate/label_choice.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>

#include "body/mirror.h"
#include "curve/bspline.h"

namespace vasa::plate {
namespace {

constexpr int kSamples = 12;         // of a span, at which it is looked for in the picture
constexpr std::size_t kAnchors = 9;  // of a vessel
constexpr float kEnds = 0.08f;       // share of a seen stretch's ends that no line points at
constexpr float kOwnSide = 0.75f;    // share of a paired vessel's points on its own side of the body
// By what a pair's courses may differ: a share of their distance from the middle, and [body heights].
constexpr float kMirrorShare = 0.35f, kMirrorReach = 0.005f;
constexpr int kMirrorSamples = 6;  // along them

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
    if (!word.empty() && word != "left" && word != "right") {
      if (!out.empty()) out += ' ';
      out += word;
    }
    at = end + 1;
  }
  return out;
}

// Whether two vessels lie on either side of the body as mirror images do.
// The vessel on whose side an end hangs; empty where it hangs on none.
std::string hostName(const Network& network, const Vessel& vessel, bool last) {
  const NodeId id = last ? vessel.end : vessel.start;
  if (!id.valid() || !network.node(id).host) return {};
  return lower(network.vessel(network.node(id).host->vessel).name);
}

// Whether two vessels hang on the same one or on a pair, as far as they hang on any.
// @param against  the second one runs the other way
bool hangAlike(const Network& network, const Vessel& a, const Vessel& b, bool against) {
  for (const bool last : {false, true}) {
    const std::string on = hostName(network, a, last), other = hostName(network, b, last != against);
    if (!on.empty() && !other.empty() && on != other && mirrored(on) != other) return false;
  }
  return true;
}

vec3 placeOn(std::span<const vec4> points, float share) {
  const float u = share * float(points.size() - 1);
  const auto first = std::min(std::size_t(u), points.size() - 2);
  return vec3(glm::mix(points[first], points[first + 1], u - float(first)));
}

// Whether two courses are mirror images by what they lie beside the middle: a heart's two arteries are not.
bool runAlike(const Network& network, float middle, const Vessel& a, const Vessel& b, bool against) {
  float beside = 0, apart = 0;
  for (int k = 0; k <= kMirrorSamples; ++k) {
    const float share = float(k) / kMirrorSamples;
    const vec3 here = placeOn(network.pointsOf(a), share),
               there = placeOn(network.pointsOf(b), against ? 1 - share : share);
    beside += (std::abs(here.x - middle) + std::abs(there.x - middle)) / (2 * (kMirrorSamples + 1));
    apart = std::max(apart, glm::distance(vec3(2 * middle - here.x, here.y, here.z), there));
  }
  return apart < kMirrorShare * beside + kMirrorReach * network.bodyHeight();
}

// Which side of the middle a vessel is on: -1, 0, 1.
int sideOf(const Network& network, float middle, const Vessel& vessel) {
  std::size_t left = 0;
  const auto points = network.pointsOf(vessel);
  for (const vec4& point : points) left += point.x > middle;
  const float share = float(left) / float(points.size());
  return share >= kOwnSide ? 1 : share <= 1 - kOwnSide ? -1 : 0;
}

// Whether two vessels lie on either side of the body as mirror images do; scans' run either way.
bool mirrorOneAnother(const Network& network, float middle, const Vessel& a, const Vessel& b) {
  if (sideOf(network, middle, a) * sideOf(network, middle, b) != -1) return false;
  for (const bool against : {false, true})
    if (hangAlike(network, a, b, against) && runAlike(network, middle, a, b, against)) return true;
  return false;
}

// "right branch of ..." is the branch to the right, not one of a pair.
bool sideOfBranch(const std::string& name) {
  return name.find("left branch") != name.npos || name.find("right branch") != name.npos;
}

// "digital vein (3)" is a piece of what has this name.
std::string withoutPiece(std::string name) {
  const auto open = name.rfind(" (");
  if (open == name.npos || open == 0 || name.back() != ')') return name;
  if (name.find_first_not_of("0123456789", open + 2) == name.size() - 1 && name.size() > open + 3)
    name.resize(open);
  return name;
}

class Namer {
 public:
  explicit Namer(const Network& network) : network_(network) {
    for (std::uint32_t v = 0; v < network.vessels().size(); ++v)
      byName_.try_emplace(lower(network.vessels()[v].name), v);
    // The body's middle is that of most pairs.
    std::vector<float> middles;
    for (const auto& [name, v] : byName_)
      if (const auto other = otherSideOf(name)) middles.push_back(0.5f * (middleOf(v) + middleOf(*other)));
    if (middles.empty()) return;
    const auto half = middles.begin() + std::ptrdiff_t(middles.size() / 2);
    std::ranges::nth_element(middles, half);
    middle_ = *half;
  }

  std::string text(VesselId id) const {
    const Vessel& vessel = network_.vessel(id);
    const std::string name = lower(vessel.name);
    std::string shown = withoutPiece(vessel.name);
    if (const auto other = otherSideOf(name))
      if (mirrorOneAnother(network_, middle_, vessel, network_.vessels()[*other])) shown = withoutSide(shown);
    if (!shown.empty()) shown[0] = char(std::toupper(static_cast<unsigned char>(shown[0])));
    return shown;
  }

 private:
  std::optional<std::uint32_t> otherSideOf(const std::string& name) const {
    if (!hasSide(name) || sideOfBranch(name)) return std::nullopt;
    const auto other = byName_.find(mirrored(name));
    return other == byName_.end() ? std::nullopt : std::optional(other->second);
  }

  float middleOf(std::uint32_t vessel) const {
    const auto points = network_.pointsOf(network_.vessels()[vessel]);
    float sum = 0;
    for (const vec4& point : points) sum += point.x;
    return sum / float(points.size());
  }

  const Network& network_;
  std::map<std::string, std::uint32_t> byName_;
  float middle_ = 0;
};

struct Stretch {
  std::vector<vec2> places;
  float length = 0;
  float width = 0;  // sum over the places
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
      if (!stretch.places.empty()) stretch.length += glm::distance(stretch.places.back(), cell);
      stretch.places.push_back(cell);
      stretch.width += 2 * place.w * seen.cellsAMetre(vec3(place));
    }
  }
  return stretches;
}

// "right leg artery 2": one of many that nobody named.
bool isNumbered(std::string_view name) {
  const auto digits = name.size() - std::min(name.size(), name.find_last_not_of("0123456789") + 1);
  return digits > 0 && digits < name.size() && name[name.size() - digits - 1] == ' ';
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
                                   const LabelWishes& wishes) {
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
    for (Stretch& stretch : seenStretches(network, v, points, seen, wishes))
      stretches[place->second].push_back(std::move(stretch));
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    std::size_t count = 0;
    for (const Stretch& stretch : stretches[i])
      labels[i].width += stretch.width, count += stretch.places.size();
    if (count > 0) labels[i].width /= float(count);
    labels[i].anchors = anchorsOf(stretches[i]);
  }
  std::erase_if(labels, [](const VesselLabel& label) { return label.anchors.empty(); });
  std::ranges::stable_sort(labels, std::greater{}, &VesselLabel::area);
  return labels;
}

bool contains(std::span<const VesselId> vessels, VesselId id) {
  return std::ranges::any_of(vessels, [&](VesselId v) { return v.value == id.value; });
}

// The vessels of a name: those that are called so, with or without their side; else all whose names it is a
// part of.
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
    return badInput("--labels: no vessel is named '" + name + "'; vasa info NET.vasa --vessels lists them");
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

std::string labelText(const Network& network, VesselId vessel) { return Namer(network).text(vessel); }

Result<LabelChoice> chooseLabels(const Network& network, std::span<const vec4> points, const SeenMap& seen,
                                 const LabelWishes& wishes) {
  std::vector<VesselLabel> all = allLabels(network, points, seen, wishes);
  if (wishes.which != "main" && wishes.which != "all-visible")
    return chooseByName(network, std::move(all), wishes.which);
  std::erase_if(all, [&](const VesselLabel& label) {
    const auto meant = [&](VesselId id) { return wishes.of.empty() || wishes.of[id.value]; };
    return isNumbered(label.text) || std::ranges::none_of(label.vessels, meant);
  });
  if (wishes.which == "main")
    std::erase_if(all, [&](const VesselLabel& label) {
      return label.area < wishes.leastArea || label.width < wishes.leastWidth;
    });
  if (all.size() > wishes.most) all.resize(wishes.most);
  return LabelChoice{std::move(all), {}};
}

}  // namespace vasa::plate
