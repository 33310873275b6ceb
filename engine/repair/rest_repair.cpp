#include "repair/rest_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/cancellation.h"
#include "network/file.h"
#include "network/reshape.h"
#include "repair/rest_parting.h"

namespace vasa {
namespace {

constexpr unsigned kPasses = 4, kSteps = 40;
// A sweep, in the mean. Scanned bodies have up to 0.3; where it is many times that, what lies there is a
// tangle of no vessels, and no way leads out of it.
constexpr std::size_t kMostPairs = 4;
constexpr unsigned kStepsOfMotion = 20;    // the first, before anything is thinned
constexpr float kRepairClearance = 1e-6f;  // [m] well above what detection is exact to
// Of coordinates that two vessels may come nearer by, √3 each, and of radii.
constexpr float kRoundings = 4.5f;

// Two vessels are one told twice where they are so alike along so much of both. (An artery and a vein that
// are merely drawn over one another can go side by side.)
constexpr float kSameAxis = 0.25f;    // of the smaller radius
constexpr float kSameRadius = 1.25f;  // factor
constexpr float kSameCourse = 0.8f;   // |cos|
constexpr float kSameShare = 0.8f;    // of a vessel's spans

using VesselPair = std::pair<std::uint32_t, std::uint32_t>;  // a <= b

VesselPair vesselsOf(const Contact& contact, const NetworkTubes& layout) {
  const std::uint32_t a = layout.address(contact.i).vessel.value, b = layout.address(contact.j).vessel.value;
  return {std::min(a, b), std::max(a, b)};
}

bool alongOneAxis(const Contact& contact, std::span<const Bezier> tubes) {
  const vec4 a = tubes[contact.i].at(contact.s), b = tubes[contact.j].at(contact.t);
  const vec3 alongA = tubes[contact.i].derivative(contact.s), alongB = tubes[contact.j].derivative(contact.t);
  const auto [thin, wide] = std::minmax(a.w, b.w);
  return glm::distance(vec3(a), vec3(b)) < kSameAxis * thin && wide < kSameRadius * thin &&
         std::abs(glm::dot(alongA, alongB)) > kSameCourse * glm::length(alongA) * glm::length(alongB);
}

// Pairs of vessels that tell one course.
std::set<VesselPair> toldTwice(const Network& network, Interference& interference) {
  std::map<VesselPair, std::array<std::set<std::uint32_t>, 2>> spans;
  const NetworkTubes& layout = interference.layout();
  for (const Interference::Place& place : interference.find(network.points())) {
    const VesselPair vessels = vesselsOf(place.contact, layout);
    if (vessels.first == vessels.second || !alongOneAxis(place.contact, interference.tubes())) continue;
    for (const std::uint32_t tube : {place.contact.i, place.contact.j}) {
      const NetworkTubes::Address at = layout.address(tube);
      spans[vessels][at.vessel.value == vessels.second].insert(at.span);
    }
  }
  std::set<VesselPair> twice;
  for (const auto& [vessels, own] : spans)
    if (float(own[0].size()) >= kSameShare * float(network.vessels()[vessels.first].spanCount()) &&
        float(own[1].size()) >= kSameShare * float(network.vessels()[vessels.second].spanCount()))
      twice.insert(vessels);
  return twice;
}

// One pass, with the neighbours of the network that the last one left. @return whether nothing was left to do
bool part(RestParting& parting, const Network& now, const std::set<VesselPair>& twice, float clearance,
          bool thins) {
  Interference interference(now);
  std::vector<Interference::Place> places;
  for (unsigned step = 0; step < kSteps; ++step) {
    checkpoint();
    places.clear();
    for (const Interference::Place& place : interference.find(parting.points(), parting.watched()))
      if (!twice.contains(vesselsOf(place.contact, interference.layout()))) places.push_back(place);
    // A little of the clearance may be lacking: steps come ever nearer to it.
    if (std::ranges::none_of(places, [&](const auto& place) { return place.contact.f < 0.9f * clearance; }))
      return step == 0;
    if (thins || step >= kStepsOfMotion) parting.thin(places, interference.layout(), interference.tubes());
    parting.move(places, interference.layout(), interference.tubes());
  }
  return false;
}

std::vector<RestOverlap> overlapsOf(const Network& network, const std::set<VesselPair>& twice,
                                    OverlapReason otherwise) {
  Interference interference(network);
  std::map<VesselPair, RestOverlap> found;
  for (const Interference::Place& place : interference.find(network.points())) {
    const Contact& contact = place.contact;
    const VesselPair vessels = vesselsOf(contact, interference.layout());
    RestOverlap& overlap =
        found.try_emplace(vessels, RestOverlap{{vessels.first}, {vessels.second}, 0, 0, otherwise})
            .first->second;
    ++overlap.pairs;
    overlap.depth = std::max(overlap.depth, -contact.f);
    const float thin = std::min(interference.tubes()[contact.i].at(contact.s).w,
                                interference.tubes()[contact.j].at(contact.t).w);
    if (-contact.f >= 2 * thin) overlap.reason = OverlapReason::inside;
    if (twice.contains(vessels)) overlap.reason = OverlapReason::twice;
  }
  std::vector<RestOverlap> overlaps;
  for (const auto& [vessels, overlap] : found) overlaps.push_back(overlap);
  std::ranges::stable_sort(overlaps, std::greater<>(), &RestOverlap::depth);
  return overlaps;
}

}  // namespace

std::string_view reasonName(OverlapReason reason) {
  constexpr std::array<std::string_view, 4> kNames{"no room", "inside", "twice", "as told"};
  return kNames[std::size_t(reason)];
}

RestRepair overlapsAtRest(const Network& network) {
  RestRepair repair{.network = network};
  Interference atRest(network);
  repair.pairsBefore = repair.pairsAfter = atRest.restPairCount();
  if (repair.pairsBefore > 0)
    repair.left = overlapsOf(network, toldTwice(network, atRest), OverlapReason::asTold);
  return repair;
}

RestRepair separateAtRest(const Network& network) {
  RestRepair repair = overlapsAtRest(network);
  if (repair.pairsBefore == 0 || repair.pairsBefore > kMostPairs * network.sweepCount()) return repair;
  std::set<VesselPair> twice;
  for (const RestOverlap& overlap : repair.left)
    if (overlap.reason == OverlapReason::twice) twice.emplace(overlap.first.value, overlap.second.value);
  const float clearance = std::max(kRepairClearance, kRoundings * quantisationError(network));
  RestParting parting(network, clearance);
  for (unsigned pass = 0; pass < kPasses; ++pass) {
    const bool done = part(parting, repair.network, twice, clearance, pass > 0);
    auto parted = reshapeNetwork(network, parting.points(), network.bodyHeight());
    if (!parted) break;  // a vessel lost its length or its place: what was reached before stands
    repair.network = std::move(*parted);
    if (done) break;
  }
  repair.left = overlapsOf(repair.network, twice, OverlapReason::noRoom);
  repair.pairsAfter = 0;
  for (const RestOverlap& overlap : repair.left) repair.pairsAfter += overlap.pairs;
  for (std::size_t p = 0; p < network.points().size(); ++p) {
    const vec4 &moved = repair.network.points()[p], &rest = network.points()[p];
    repair.movedMax = std::max(repair.movedMax, glm::distance(vec3(moved), vec3(rest)));
    if (rest.w > 0) repair.thinnedMax = std::max(repair.thinnedMax, 1 - moved.w / rest.w);
  }
  return repair;
}

}  // namespace vasa
