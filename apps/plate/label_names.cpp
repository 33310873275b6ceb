#include "plate/label_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <vector>

#include "body/mirror.h"
#include "core/letters.h"

namespace vasa::plate {
namespace {

constexpr float kOwnSide = 0.75f;  // share of a paired vessel's points on its own side of the body
// By what a pair's courses may differ: a share of their distance from the middle, and [body heights].
constexpr float kMirrorShare = 0.35f, kMirrorReach = 0.005f;
constexpr int kMirrorSamples = 6;  // along them

constexpr std::array<std::string_view, 12> kOrdinals{"first", "second", "third",    "fourth",
                                                     "fifth", "sixth",  "seventh",  "eighth",
                                                     "ninth", "tenth",  "eleventh", "twelfth"};

std::string withCapital(std::string text) {
  if (!text.empty()) text[0] = char(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
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

// The vessel on whose side an end hangs; empty where it hangs on none.
std::string hostName(const Network& network, const Vessel& vessel, bool last) {
  const NodeId id = vessel.node(last);
  if (!id.valid() || !network.node(id).host) return {};
  return lowerCase(network.vessel(network.node(id).host->vessel).name);
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

float middleOf(const Network& network, std::uint32_t vessel) {
  const auto points = network.pointsOf(network.vessels()[vessel]);
  float sum = 0;
  for (const vec4& point : points) sum += point.x;
  return sum / float(points.size());
}

}  // namespace

LabelNames::LabelNames(const Network& network) : network_(network) {
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v)
    byName_.try_emplace(lowerCase(network.vessels()[v].name), v);
  // The body's middle is that of most pairs.
  std::vector<float> middles;
  for (const auto& [name, v] : byName_)
    if (const auto other = otherSideOf(name))
      middles.push_back(0.5f * (middleOf(network, v) + middleOf(network, *other)));
  if (middles.empty()) return;
  const auto half = middles.begin() + std::ptrdiff_t(middles.size() / 2);
  std::ranges::nth_element(middles, half);
  middle_ = *half;
}

std::string LabelNames::of(VesselId id) const {
  const Vessel& vessel = network_.vessel(id);
  const std::string name = lowerCase(vessel.name);
  std::string shown = withoutPiece(vessel.name);
  if (const auto other = otherSideOf(name))
    if (mirrorOneAnother(network_, middle_, vessel, network_.vessels()[*other])) shown = withoutSide(shown);
  return withCapital(std::move(shown));
}

std::optional<std::uint32_t> LabelNames::otherSideOf(const std::string& name) const {
  if (!hasSide(name) || sideOfBranch(name)) return std::nullopt;
  const auto other = byName_.find(mirrored(name));
  return other == byName_.end() ? std::nullopt : std::optional(other->second);
}

std::string rowOf(std::string_view name) {
  std::string row;
  const std::string small = lowerCase(name);
  // A digit's artery or vein; "of hand" and "of aorta" tell more than a place in a row.
  if (const auto of = small.rfind(" of "); of != small.npos)
    for (const std::string_view digit : {"finger", "thumb", "toe"})
      if (small.ends_with(digit)) name = name.substr(0, of);
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t end = std::min(name.find(' ', at), name.size());
    if (std::ranges::find(kOrdinals, std::string_view(small).substr(at, end - at)) == kOrdinals.end()) {
      if (!row.empty()) row += ' ';
      row += name.substr(at, end - at);
    }
    at = end + 1;
  }
  return withCapital(std::move(row));
}

std::string namedAfter(std::string_view name) {
  const std::string small = lowerCase(name);
  const std::size_t side = small.starts_with("left ") ? 5 : small.starts_with("right ") ? 6 : 0;
  for (const std::string_view beside : {"lateral ", "medial "})
    if (small.substr(side).starts_with(beside))
      return small.substr(0, side) + small.substr(side + beside.size());
  constexpr std::string_view kBranch = " branch of ";
  const auto branch = small.find(kBranch);
  return branch == small.npos ? std::string() : small.substr(branch + kBranch.size());
}

std::string plural(std::string name) {
  const std::size_t end = std::min(name.find(" of "), name.size());
  if (end == 0) return name;
  const std::string_view noun = std::string_view(name).substr(0, end);
  if (noun.ends_with("y")) return name.replace(end - 1, 1, "ies");
  return name.insert(end, noun.ends_with("s") || noun.ends_with("ch") ? "es" : "s");
}

bool isNumbered(std::string_view name) {
  const auto digits = name.size() - std::min(name.size(), name.find_last_not_of("0123456789") + 1);
  return digits > 0 && digits < name.size() && name[name.size() - digits - 1] == ' ';
}

}  // namespace vasa::plate
