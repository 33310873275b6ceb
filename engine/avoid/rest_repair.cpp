#include "avoid/rest_repair.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include "avoid/contact_pool.h"

namespace vasa {
namespace {

static const unsigned kRounds = getenv("RN") ? atoi(getenv("RN")) : 15, kSweeps = 40;
constexpr unsigned kThinnings = 30;
constexpr float kClearance = 6e-5f;  // [m] file formats round coordinates and radii by up to 15 µm: two of each
constexpr float kPace = 1 / 60.0f;   // [s] that what has no leverage may move in one round (ContactPool)
static const float kThinnest = getenv("RT") ? atof(getenv("RT")) : 0.4f;    // of a radius
constexpr float kSpare = 0.998f;     // a little more than is asked for, so that it is settled in few rounds

// Lowers the radii at a place by what is lacking there: the thinner tube first, which is the smaller change.
void thin(const Network& network, const NetworkTubes& layout, const Contact& contact, std::span<const Bezier> shape, std::span<vec4> points) {
  float lack = kClearance - contact.f;
  std::array<std::pair<std::uint32_t, float>, 2> tubes{{{contact.i, contact.s}, {contact.j, contact.t}}};
  if (shape[contact.j].at(contact.t).w < shape[contact.i].at(contact.s).w) std::swap(tubes[0], tubes[1]);
  for (const auto& [tube, at] : tubes) {
    const auto [vessel, span] = layout.address(tube);
    const std::uint32_t first = network.vessel(vessel).firstPoint + span;
    const float radius = shape[tube].at(at).w, rest = bezierOfSpan(network.pointsOf(network.vessel(vessel)), span).at(at).w;
    const float wanted = std::max(radius - lack, std::min(radius, kThinnest * rest)), factor = radius > 0 ? kSpare * wanted / radius : 1;
    lack -= radius - wanted;
    for (std::uint32_t p = first; p < first + 4; ++p)
      points[p].w = std::min(points[p].w, std::max(points[p].w * factor, kThinnest * network.points()[p].w));
    if (lack <= 0) return;
  }
}

}  // namespace

RestRepair separateAtRest(const Network& network) {
  Interference interference(network);
  const RestSides sides(network, interference);
  const MotionSpace space(network, 30, !getenv("NOMASS"));
  ContactPool pool(space, interference, sides);
  const std::vector<quat> turns(interference.layout().count(), quat(1, 0, 0, 0)), rotations(network.points().size(), quat(1, 0, 0, 0));
  const std::vector<float> moved(turns.size(), 0);
  RestRepair repair{{network.points().begin(), network.points().end()}, interference.restPairCount()};
  if (repair.pairsBefore == 0) return repair;
  std::vector<vec3> z(space.variableCount(), vec3(0));
  MotionSpace motion = space;
  pool.clear(getenv("RP") ? atof(getenv("RP")) : 0.0055f);
  pool.keepApart(kClearance, getenv("RR") ? atof(getenv("RR")) : 1);
  const auto apply = [&] {
    for (std::size_t p = 0; p < repair.points.size(); ++p) repair.points[p] = vec4(vec3(network.points()[p]), repair.points[p].w);
    motion.apply(z, repair.points);
  };
  const auto overlaps = [](const Interference::Place& place) { return place.contact.f < 0; };
  auto places = interference.find(repair.points, kClearance);
  if (getenv("RDBG"))
    for (const auto& pl : places) if (overlaps(pl)) {
      const auto& c = pl.contact; const auto a = interference.layout().address(c.i), b = interference.layout().address(c.j);
      fprintf(stderr, "PAIR\t%s\t%u/%u\t%s\t%u/%u\t%.2f\t%.2f\t%.2f\t%.2f\n", network.vessel(a.vessel).name.c_str(), a.span, network.vessel(a.vessel).spanCount(), network.vessel(b.vessel).name.c_str(), b.span, network.vessel(b.vessel).spanCount(), c.f*1e3, interference.tubes()[c.i].at(c.s).w*1e3, interference.tubes()[c.j].at(c.t).w*1e3, glm::distance(vec3(interference.tubes()[c.i].at(c.s)), vec3(interference.tubes()[c.j].at(c.t)))*1e3);
    }
  for (unsigned round = 0; round < kRounds + kThinnings && std::ranges::any_of(places, overlaps); ++round) {
    if (round >= kRounds)
      for (const Interference::Place& place : places)
        if (overlaps(place)) thin(network, interference.layout(), place.contact, interference.tubes(), repair.points);
    pool.refresh(interference.tubes(), z);
    pool.add(places, {}, interference.tubes(), {interference.restTubes(), turns, moved, rotations}, z);
    pool.ascend(kSweeps, z);
    apply();
    places = interference.find(repair.points, kClearance);
  }
  repair.pairsAfter = std::size_t(std::ranges::count_if(places, overlaps));
  for (std::size_t p = 0; p < repair.points.size(); ++p) {
    const vec4 &now = repair.points[p], &rest = network.points()[p];
    repair.movedMax = std::max(repair.movedMax, glm::distance(vec3(now), vec3(rest)));
    if (rest.w > 0) repair.thinnedMax = std::max(repair.thinnedMax, 1 - now.w / rest.w);
  }
  return repair;
}

}  // namespace vasa
