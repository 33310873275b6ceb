#include <algorithm>
#include <limits>
#include <tuple>

#include "avoid/solver_state.h"

// What is tried once a frame is certified, for what it says besides: sides and bones. Whatever comes of it stands only if
// it is better and still certified.
namespace vasa {
namespace {

constexpr unsigned kBringBack = 3;  // times that more rounds are tried for the sides
// The same for what is in bones: how many times, and how many of them in vain; of so many rounds.
constexpr unsigned kLeaveBones = 5, kInVain = 2, kRoundsToLeave = 5;
constexpr float kVolumeError = 1e-4f;  // relative, that is borne for it
// No more points than so many, and one in so many, may be moved farther for that.
constexpr float kFar = 4;  // radii
constexpr std::size_t kFew = 16, kOneIn = 1000;
// Detours: how wide they may have to be, by the radii at rest; how often all are tried, each on its own and then in a row.
constexpr float kWidths[] = {1, 0.5f, kLeastLumen};
constexpr unsigned kAlone = 2, kInARow = 3;
constexpr float kOneStretch = 6;     // spans between places that go the same way around
constexpr unsigned kReach = 4;       // times that motions are mended for what hangs on itself
constexpr unsigned kNarrowings = 16;

constexpr std::pair<std::size_t, std::size_t> kNone{};

bool isNew(const BoneContact& contact) { return contact.allowed == 0; }

}  // namespace

Avoider::State::Outcome Avoider::State::present(std::span<const vec4> points) const {
  return {changed.size(), reportOf(boneContacts), tubesOf(skinContacts), {points.begin(), points.end()}, volumeOutcome};
}

// As certified, and none the worse otherwise.
bool Avoider::State::isFreerOfBones(const Outcome& than) {
  const auto in = [](const BoneReport& own) { return std::tuple(own.contacts, own.deeper, own.depth); };
  return changed.size() <= than.changed && in(reportOf(boneContacts)) < in(than.bones) && tubesOf(skinContacts) <= than.inSkin &&
         certificateOf(places, &remaining).holds();
}

void Avoider::State::restore(const Outcome& outcome, const PosedVessels& posed, std::span<vec4> points, AvoidReport& report) {
  std::ranges::copy(outcome.points, points.begin());
  volumeOutcome = outcome.volume;
  look(posed, points, Bones::Which::nearAtLast, report);
  certificateOf(places, &remaining);
}

// Some rounds more where vessels have ended on the wrong side of one another, without what was asked for between them on
// the way there. The best of what comes of them stands: as certified as before, and fewer on a wrong side.
void Avoider::State::bringBack(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report) {
  if (changed.empty()) return;
  Outcome best = present(points);
  bool isBest = true;
  for (unsigned attempt = 0; attempt < kBringBack && !changed.empty(); ++attempt) {
    pool.forget(changed);
    tryAgain(options.rounds, posed, volume, points, report);
    isBest = changed.size() < best.changed && certificateOf(places, &remaining).holds();
    if (isBest) best = present(points);
  }
  if (!isBest) restore(best, posed, points, report);
}

bool Avoider::State::isJump(std::span<const vec4> from, std::span<const vec4> to) const {
  std::size_t far = 0;
  for (std::size_t p = 0; p < to.size(); ++p) far += glm::distance(vec3(from[p]), vec3(to[p])) > kFar * network.points()[p].w;
  return far > kFew + to.size() / kOneIn;
}

// The same where they have ended in a bone that they were not in at rest, without what pushes them against the way out
// from where they are now. Only what moves few points far stands: from frame to frame, a jump is seen more than a vessel
// in a bone.
void Avoider::State::leaveBones(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report) {
  if (reportOf(boneContacts).contacts == 0) return;
  Outcome best = present(points);
  const std::vector<vec4> start = best.points;
  bool isBest = true;
  for (unsigned attempt = 0, vain = 0; attempt < kLeaveBones && vain < kInVain && reportOf(boneContacts).contacts > 0; ++attempt) {
    boneConstraints.turnTo(boneContacts);
    tryAgain(std::min(kRoundsToLeave, options.rounds), posed, volume, points, report);
    isBest = volumeOutcome.largestError <= std::max(best.volume.largestError, kVolumeError) && !isJump(start, points) && isFreerOfBones(best);
    if (isBest) best = present(points);
    else ++vain;
  }
  if (!isBest) restore(best, posed, points, report);
}

// What is in a bone that it was not in at rest, and what is in the way of another vessel.
std::vector<Stretch> Avoider::State::stretchesInTheWay() {
  std::vector<Stretch> stretches;
  const auto add = [&](std::uint32_t tube, float at) {
    const auto [vessel, span] = interference.layout().address(tube);
    const float u = float(span) + at;
    if (stretches.empty() || stretches.back().vessel != vessel || u - stretches.back().to >= kOneStretch) stretches.push_back({vessel, u, u});
    stretches.back().from = std::min(stretches.back().from, u);
    stretches.back().to = std::max(stretches.back().to, u);
  };
  for (const BoneContact& contact : boneContacts)
    if (isNew(contact)) add(contact.tube, contact.s);
  for (const Interference::Place& place : remaining) {
    add(place.contact.i, place.contact.s);
    add(place.contact.j, place.contact.t);
  }
  return stretches;
}

// A vessel's: in bones, and with other vessels.
std::pair<std::size_t, std::size_t> Avoider::State::contactsOf(VesselId vessel) const {
  const auto isOwn = [&](std::uint32_t tube) { return interference.layout().address(tube).vessel == vessel; };
  return {std::ranges::count_if(boneContacts, [&](const BoneContact& own) { return isNew(own) && isOwn(own.tube); }),
          std::ranges::count_if(remaining, [&](const Interference::Place& place) {
            return isOwn(place.contact.i) || isOwn(place.contact.j);
          })};
}

// Moves the points of a detour, and what hangs on them, and gives the vessels that changed their volume again.
void Avoider::State::take(const Detour& detour, float factor, const VolumeKeeper* volume, std::span<vec4> points) {
  const std::vector<vec4> start(points.begin(), points.end()), wide = widePoints(volume, points);
  const std::uint32_t begin = network.vessel(detour.vessel).firstPoint + detour.firstPoint, end = begin + std::uint32_t(detour.motions.size());
  std::fill(z.begin(), z.end(), vec3(0));
  std::vector<vec3> reached(detour.motions.size(), vec3(0));
  for (unsigned round = 0; round < kReach; ++round) {
    std::ranges::copy(start, points.begin());
    for (std::uint32_t p = begin; p < end; ++p) z[p] += detour.motions[p - begin] - reached[p - begin];
    space.apply(z, points);
    for (std::uint32_t p = begin; p < end; ++p) reached[p - begin] = vec3(points[p] - start[p]);
  }
  gaveWay |= factor < 1;
  most.assign(points.size(), std::numeric_limits<float>::infinity());
  for (std::uint32_t p = 0; p < points.size(); ++p)
    if (p < begin || p >= end) most[p] = points[p].w < wide[p].w ? points[p].w : most[p];
    else if (factor < 1) most[p] = factor * network.points()[p].w;
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    if (std::ranges::equal(Network::pointsOf(vessel, std::span<const vec4>(start)), Network::pointsOf(vessel, points))) continue;
    for (std::uint32_t p = vessel.firstPoint; p < vessel.firstPoint + vessel.pointCount; ++p) points[p].w = std::min(network.points()[p].w, most[p]);
    if (volume) volume->keep({v}, points, most, volumeOutcome);
  }
}

// In the end, rings at nodes, too, and volume is given up for it.
void Avoider::State::narrowAtBones(const PosedVessels& posed, std::span<vec4> points, AvoidReport& report) {
  std::vector<BoneContact> contacts;
  std::ranges::copy_if(boneContacts, std::back_inserter(contacts), isNew);
  most.assign(points.size(), std::numeric_limits<float>::infinity());
  narrow(network, interference.layout(), contacts, interference.tubes(), points, true, most);
  for (std::size_t p = 0; p < points.size(); ++p) points[p].w = std::min(points[p].w, most[p]);
  gaveWay = true;
  look(posed, points, Bones::Which::nearAtLast, report);
}

// Where that does not help, ways around for the stretches that are still in a bone (avoid/detour.h), all else held where
// it is: each on its own, if that is better; then one after the other, for a detour takes what hangs on it along, which
// then needs one itself.
void Avoider::State::goAroundBones(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report) {
  if (reportOf(boneContacts).contacts == 0) return;
  Outcome best = present(points);
  bool isBest = true;
  const auto judge = [&] {
    isBest = isFreerOfBones(best);
    if (isBest) best = present(points);
    return isBest;
  };
  const auto goAround = [&](const Stretch& stretch, const auto& isGood) {
    const Outcome before = present(points);
    for (const float width : kWidths) {
      const Detour detour = [&] {
        StageClock clock(report.solveMs);
        return findDetour(network, interference, *bones, stretch, points, width);
      }();
      if (detour.motions.empty()) continue;
      take(detour, width, volume, points);
      look(posed, points, Bones::Which::nearAtLast, report);
      if (isGood()) return;
      restore(before, posed, points, report);
    }
  };
  for (unsigned pass = 0; pass < kAlone && best.bones.contacts > 0; ++pass)
    for (const Stretch& stretch : stretchesInTheWay()) {
      if (contactsOf(stretch.vessel) == kNone) continue;
      goAround(stretch, [&] {
        if (judge()) return true;
        if (certificateOf(places, &remaining).holds()) return false;
        giveWay(posed, volume, points, report);
        return judge();
      });
    }
  for (unsigned pass = 0; pass < kInARow && best.bones.contacts > 0; ++pass) {
    for (const Stretch& stretch : stretchesInTheWay()) {
      const auto own = contactsOf(stretch.vessel);
      if (own == kNone) continue;
      goAround(stretch, [&] {
        certificateOf(places, &remaining);
        return contactsOf(stretch.vessel) < own && changed.size() <= best.changed;
      });
    }
    if (judge()) continue;
    if (!certificateOf(places, &remaining).holds()) giveWay(posed, volume, points, report);
    if (judge() || best.bones.contacts == 0) continue;
    narrowAtBones(posed, points, report);
    judge();
  }
  if (!isBest) restore(best, posed, points, report);
  isBest = true;
  for (unsigned round = 0; round < kNarrowings && best.bones.contacts > 0; ++round) {
    narrowAtBones(posed, points, report);
    judge();
  }
  if (!isBest) restore(best, posed, points, report);
}

}  // namespace vasa
