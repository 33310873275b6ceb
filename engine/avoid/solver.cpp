#include "avoid/solver.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "avoid/contact_pool.h"
#include "avoid/pace.h"
#include "core/clock.h"
#include "solids/skin_wall.h"

namespace vasa {
namespace {

// Of the radii: a step in which something comes deeper into another, and no more lies as it lay, is too long.
constexpr float kDeepest = 0.5f;
// Of the radius, counted as a millimetre at least (a bone has no lumen to give way, and its field is no
// finer): likewise in a bone in which it was not at rest, where the way out that was found is about the
// nearest one, and where it is not: there it is half the thickness, as between tubes. With 1 for both the
// scanned body's walk takes a sixth more detections; without a bound on the first it has a jump of 16 mm.
constexpr float kDeepestInBone = 1.5f, kLeastRadius = 1e-3f;
constexpr float kNoLimit = Correction::kNoLimit;

std::uint32_t tubesOf(
    std::span<const BoneContact> contacts,
    bool (*counts)(const BoneContact&) = [](const BoneContact&) { return true; }) {
  std::uint32_t count = 0, last = ~0u;
  for (const BoneContact& contact : contacts)
    if (counts(contact) && std::exchange(last, contact.tube) != contact.tube) ++count;
  return count;
}

// A bone in which the tube was not at rest, to what that is known.
bool isEntered(const BoneContact& contact) { return contact.allowed > -kRestTolerance; }

BoneReport reportOf(std::span<const BoneContact> contacts) {
  BoneReport report{tubesOf(contacts, isEntered),
                    tubesOf(contacts, [](const BoneContact& contact) { return !isEntered(contact); })};
  for (const BoneContact& contact : contacts)
    report.depth = std::max(report.depth, contact.allowed - contact.f);
  return report;
}

}  // namespace

struct Avoider::State {
  State(const Network& own, const Body* body, AvoidOptions chosen)
      : network(own),
        options(chosen),
        interference(own),
        space(own, chosen.bending),
        flow(own),
        pace(own, space),
        sides(own, interference),
        pool(space, interference, sides),
        lastTubes(interference.restTubes().begin(), interference.restTubes().end()),
        lastRotations(own.points().size(), quat(1, 0, 0, 0)),
        turns(interference.layout().count()),
        lastPosed(own.points().begin(), own.points().end()),
        anewTubes(turns.size(), false),
        anewPoints(lastPosed.size(), false),
        shape(lastPosed) {
    if (body) bones = std::make_unique<Bones>(*body, interference.restTubes());
    if (body && chosen.skinWall) wall = std::make_unique<SkinWall>(*body, interference.restTubes());
    correction = accepted = noCorrection();
  }

  // What a step is given, and where what it finds goes.
  struct Input {
    const PosedVessels& posed;
    const VolumeKeeper* volume;
    std::span<vec4> points;
    AvoidReport& report;
    float seconds = 0;
    bool inPlace = false;
  };
  void pose(const PosedVessels& posed);
  Correction noCorrection() const;
  void comeAlong(const Input& in);
  LastShape lastShape(const Input& in) const { return {lastTubes, turns, in.posed.rotations, anewTubes}; }
  bool isTooLong(const Input& in) const;
  void place(const Input& in);
  // Places where vessels interfere; and where they entered bones. What lay in one at rest and comes deeper is
  // held back as well as it goes, and is no reason to begin anew: data that have a vessel in a bone are wrong
  // there by more than that.
  using Trouble = std::pair<std::size_t, std::size_t>;
  enum class Look { first, again, certain };
  void look(const Input& in, std::span<const vec4> points, Look how);
  void lookAtSolids(const Input& in, Bones::Which which);
  bool settled() const;
  void separate(const Input& in);
  void giveWay(const Input& in, bool isLast);
  void solve(const Input& in, bool isLast);
  void solveAnew(const Input& in, bool isLast, float reach);
  void chooseAnew(std::span<const vec4> points, float reach);
  Trouble trouble() const { return {remaining.size(), std::ranges::count_if(boneContacts, isEntered)}; }
  bool isInTrouble() const { return trouble() > Trouble{}; }
  bool halvesMayHelp() const;
  void accept(const PosedVessels& posed);
  void sumUp(const Input& in);

  const Network& network;
  AvoidOptions options;
  Interference interference;
  MotionSpace space;
  CorrectionFlow flow;
  Pace pace;
  std::unique_ptr<Bones> bones;
  std::unique_ptr<SkinWall> wall;
  RestSides sides;
  ContactPool pool;
  Correction accepted, correction;  // of the last step, and of this one
  Trouble acceptedTrouble;          // likewise
  std::vector<Bezier> lastTubes;    // of the last admissible shape
  std::vector<quat> lastRotations, turns;
  std::vector<vec4> lastPosed;
  std::vector<char> anewTubes, anewPoints;  // of vessels that start from the pose alone ...
  std::span<const char> unpaced;            // ... of points that may jump, or none
  std::vector<vec4> shape;                  // being made
  // What single functions work in, kept so that a step allocates nothing.
  std::vector<BoneContact> entered;
  std::vector<vec4> wide;
  std::vector<float> widestBefore;
  std::vector<vec3> centres;
  std::vector<char> isIn;
  std::vector<Interference::Place> found, remaining,
      unsettled;                                // by a look(), while a step is made, and after the last one
  std::span<const Interference::Place> places;  // of the last look, as the next
  float margin = -1;                            // of the last look ...
  bool sameMargin = false;                      // ... which the one before it had, too
  std::span<const BoneContact> boneContacts;
  std::vector<BoneContact> skinContacts, solids;  // solids: bones and skin together
  std::vector<BoneContact> left;                  // in bones, after the last step
  std::vector<RestSides::Turned> turned;
  std::vector<NarrowPlace> narrowed;
  AvoidReport refused;  // what steps took that were not made, since the last one that was
  VolumeKeeper::Outcome volumeOutcome;
  VolumeKeeper::Memory volumes;  // of the last round's shape: most vessels are not moved again
};

void Avoider::State::pose(const PosedVessels& posed) {
  if (bones) bones->pose(posed.jointMatrices);
  if (wall) wall->pose(posed.jointMatrices);
  for (std::uint32_t tube = 0; tube < turns.size(); ++tube) {
    const auto [vessel, span] = interference.layout().address(tube);
    const std::uint32_t point = network.vessel(vessel).firstPoint + span + 1;
    turns[tube] = posed.rotations[point] * glm::conjugate(lastRotations[point]);
  }
}

Correction Avoider::State::noCorrection() const {
  return {std::vector(space.variableCount(), vec3(0)), std::vector(network.points().size(), kNoLimit)};
}

// What the last step's correction has become.
void Avoider::State::comeAlong(const Input& in) {
  correction = accepted;
  if (in.inPlace) return;
  flow.fade(in.seconds, correction);
  flow.carry(lastRotations, in.posed.rotations, correction.motions);
}

// The shape that belongs to a correction.
void Avoider::State::place(const Input& in) {
  const std::span<const vec4> rest = network.points();
  for (std::size_t p = 0; p < in.points.size(); ++p) in.points[p] = vec4(vec3(in.posed.points[p]), rest[p].w);
  space.apply(correction.motions, in.points);
  if (in.volume) volumeOutcome = in.volume->run(in.points, correction.widest, volumes);
  for (std::size_t p = 0; p < in.points.size(); ++p)
    in.points[p].w = std::min(in.points[p].w, correction.widest[p]);
}

// At first everything; then, from round to round, at what moved; in the end exactly, for the certificate.
void Avoider::State::look(const Input& in, std::span<const vec4> points, Look how) {
  in.report.certifyMs = 0;
  {
    StageClock clock(in.report.certifyMs);
    const float wanted = how == Look::certain ? 0 : kContactMargin;
    sameMargin = std::exchange(margin, wanted) == wanted;
    places = interference.find(points, margin);
    certificateOf(places, &remaining);
  }
  in.report.detectMs += in.report.certifyMs;
  lookAtSolids(in, how == Look::first ? Bones::Which::all : Bones::Which::nearAtLast);
}

void Avoider::State::lookAtSolids(const Input& in, Bones::Which which) {
  if (!bones) return;
  StageClock clock(in.report.boneMs);
  boneContacts = bones->contacts(interference.tubes(), lastTubes, which, anewTubes, interference.moved());
  if (!wall) return;
  skinContacts.clear();
  wall->addContacts(interference.tubes(), bones->partCount(), skinContacts);
}

bool Avoider::State::settled() const {
  return remaining.empty() && boneContacts.empty() && skinContacts.empty();
}

void Avoider::State::separate(const Input& in) {
  if (!in.inPlace) {
    StageClock clock(in.report.solveMs);
    sides.findTurned(interference.tubes(), in.posed.rotations, turned);
    pool.addSides(turned, interference.tubes(), pace.slow(), correction.motions);
  }
  for (unsigned round = 0; round < options.rounds; ++round) {
    {
      StageClock clock(in.report.solveMs);
      solids.assign(boneContacts.begin(), boneContacts.end());
      solids.insert(solids.end(), skinContacts.begin(), skinContacts.end());
      pool.refresh(interference.tubes(), correction.motions);
      const bool areNew = round == 0 || !sameMargin;
      pool.add(places, solids, interference.tubes(), lastShape(in),
               areNew ? std::span<const char>() : interference.moved(), correction.motions);
      if (pool.size() == 0) return;
      ++in.report.rounds;
      // In the last rounds the least lack counts.
      pool.ascend(options.sweeps, round + 2 < options.rounds ? Correction::kNegligible : 0,
                  correction.motions);
      pace.keep(accepted.motions, correction.motions, unpaced);
      place(in);
    }
    look(in, in.points, Look::again);
    if (settled()) return;
  }
}

// Radii at interfering places and in bones are capped, and the rest of each vessel takes its volume; in the
// end, where that only moves the trouble about, volume is given up for the certificate.
void Avoider::State::giveWay(const Input& in, bool isLast) {
  for (unsigned round = 0; round < options.rounds; ++round) {
    const bool lastResort = 2 * round >= options.rounds;
    if (!isInTrouble()) return;
    widestBefore.assign(correction.widest.begin(), correction.widest.end());
    {
      StageClock clock(in.report.solveMs);
      entered.clear();
      std::ranges::copy_if(boneContacts, std::back_inserter(entered), isEntered);
      if (lastResort)
        for (const Interference::Place& place : remaining)
          for (const std::uint32_t tube : {place.contact.i, place.contact.j}) {
            const Vessel& vessel = network.vessel(interference.layout().address(tube).vessel);
            for (std::uint32_t p = vessel.firstPoint; p < vessel.firstPoint + vessel.pointCount; ++p)
              correction.widest[p] = std::min(correction.widest[p], in.points[p].w);
          }
      narrow(network, interference.layout(), remaining, entered, interference.tubes(), in.points, lastResort,
             correction.widest);
      if (correction.widest == widestBefore) continue;  // nothing gives way, and all lies as it lay
      place(in);
    }
    look(in, in.points, isLast ? Look::certain : Look::again);
  }
}

void Avoider::State::solve(const Input& in, bool isLast) {
  separate(in);
  if (isLast) look(in, in.points, Look::certain);
}

// The vessels that are in trouble, and those within reach of the places.
void Avoider::State::chooseAnew(std::span<const vec4> points, float reach) {
  centres.clear();
  isIn.assign(network.vessels().size(), false);
  const auto add = [&](std::uint32_t tube, float s) {
    centres.push_back(vec3(interference.tubes()[tube].at(s)));
    isIn[interference.layout().address(tube).vessel.value] = true;
  };
  for (const Interference::Place& place : remaining) {
    add(place.contact.i, place.contact.s);
    add(place.contact.j, place.contact.t);
  }
  for (const BoneContact& contact : boneContacts)
    if (isEntered(contact)) add(contact.tube, contact.s);
  for (std::size_t v = 0; v < isIn.size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    const bool isNear =
        isIn[v] || std::ranges::any_of(Network::pointsOf(vessel, points), [&](const vec4& point) {
          return std::ranges::any_of(centres,
                                     [&](vec3 centre) { return glm::distance(centre, vec3(point)) < reach; });
        });
    std::fill_n(anewPoints.begin() + vessel.firstPoint, vessel.pointCount, isNear);
  }
  for (std::uint32_t tube = 0; tube < anewTubes.size(); ++tube)
    anewTubes[tube] = anewPoints[network.vessel(interference.layout().address(tube).vessel).firstPoint];
}

// Vessels that got caught, as where one limb goes through another, start from the pose as it is and go to the
// sides of one another and of bones on which they were at rest. That is kept where it leaves less trouble.
// With what lies near they keep the pace; with all, which is for vessels that interfere, none: better a jump
// than a wrong shape.
void Avoider::State::solveAnew(const Input& in, bool isLast, float reach) {
  const Correction tried = correction;
  const Trouble before = trouble();
  chooseAnew(in.points, reach);
  unpaced = reach == kNoLimit ? std::span<const char>(anewPoints) : std::span<const char>();
  comeAlong(in);
  for (std::size_t p = 0; p < anewPoints.size(); ++p) {
    if (!anewPoints[p]) continue;
    correction.motions[p] = vec3(0);
    if (!pace.isEnd(p)) correction.widest[p] = kNoLimit;  // an end's ring belongs to others, too
  }
  pool.clear();
  place(in);
  look(in, in.points, Look::first);
  solve(in, isLast);
  giveWay(in, isLast);
  std::ranges::fill(anewTubes, false);
  std::ranges::fill(anewPoints, false);
  if (trouble() < before) return;
  correction = tried;
  place(in);
  look(in, in.points, isLast ? Look::certain : Look::first);
  if (isLast) lookAtSolids(in, Bones::Which::all);  // from the sides that count again
}

// Whether the motion has brought something so far into something else's way that the side it came from is a
// guess.
bool Avoider::State::isTooLong(const Input& in) const {
  const std::span<const Bezier> tubes = interference.tubes();
  const LastShape last = lastShape(in);
  return std::ranges::any_of(remaining,
                             [&](const Interference::Place& place) {
                               const auto& [i, j, s, t, f, normal] = place.contact;
                               return place.excess() > kDeepest * (tubes[i].at(s).w + tubes[j].at(t).w) &&
                                      !keepsSide(place.contact, tubes, last);
                             }) ||
         std::ranges::any_of(boneContacts, [&](const BoneContact& contact) {
           const float radius = std::max(tubes[contact.tube].at(contact.s).w, kLeastRadius);
           const bool isSure = glm::dot(contact.normal, contact.nearestNormal) > kSameWayOut;
           return isEntered(contact) &&
                  contact.allowed - contact.f > (isSure ? kDeepestInBone : 2 * kDeepest) * radius;
         });
}

void Avoider::State::accept(const PosedVessels& posed) {
  std::ranges::copy(interference.tubes(), lastTubes.begin());
  std::ranges::copy(posed.rotations, lastRotations.begin());
  std::ranges::copy(posed.points, lastPosed.begin());
  accepted = correction;
  acceptedTrouble = trouble();
  if (bones) bones->keepPose();
}

// Not where nothing is ever moved apart, and not for what the last step could not mend either.
bool Avoider::State::halvesMayHelp() const { return options.rounds > 0 && trouble() > acceptedTrouble; }

void Avoider::State::sumUp(const Input& in) {
  AvoidReport& report = in.report;
  narrowed.clear();
  if (std::ranges::any_of(correction.widest, [](float widest) { return widest < kNoLimit; })) {
    wide.assign(in.points.begin(), in.points.end());
    for (std::size_t p = 0; p < wide.size(); ++p) wide[p].w = network.points()[p].w;
    if (in.volume) in.volume->run(wide);
    narrowed = narrowPlaces(network, wide, in.points);
  }
  report.after = certificateOf(places);
  unsettled = remaining;
  left.assign(boneContacts.begin(), boneContacts.end());
  report.bonesAfter = reportOf(boneContacts);
  report.skinContactsAfter = tubesOf(skinContacts);
  report.volume = volumeOutcome;
  report.narrowSpans = std::uint32_t(narrowed.size());
  for (const NarrowPlace& narrow : narrowed) report.leastLumen = std::min(report.leastLumen, narrow.factor);
  report.constraints = std::uint32_t(pool.size());
  double sum = 0;
  for (std::size_t p = 0; p < in.points.size(); ++p) {
    const float by = glm::distance(vec3(in.posed.points[p]), vec3(in.points[p]));
    report.movedMax = std::max(report.movedMax, by);
    sum += double(by) * by;
  }
  if (!in.points.empty()) report.movedRms = float(std::sqrt(sum / double(in.points.size())));
}

void AvoidReport::addTimes(const AvoidReport& earlier) {
  detectMs += earlier.detectMs;
  boneMs += earlier.boneMs;
  solveMs += earlier.solveMs;
  rounds += earlier.rounds;
}

Avoider::Avoider(const Network& network, const Body* body, AvoidOptions options)
    : state_(std::make_unique<State>(network, body, options)) {}
Avoider::~Avoider() = default;
Avoider::Avoider(Avoider&&) noexcept = default;

AvoidReport Avoider::start(const Correction& correction, const PosedVessels& posed,
                           const VolumeKeeper* volume, std::span<vec4> points) {
  State& state = *state_;
  state.correction = correction.motions.empty() ? state.noCorrection() : correction;
  AvoidReport report;
  const State::Input in{posed, volume, state.shape, report};
  state.refused = {};
  state.pool.clear();
  state.pose(posed);
  state.place(in);
  state.interference.layout().shape(state.shape, state.lastTubes);
  if (state.bones) state.bones->keepPose();
  state.look(in, state.shape, State::Look::certain);
  state.lookAtSolids(in, Bones::Which::all);
  state.accept(posed);
  state.sumUp(in);
  std::ranges::copy(state.shape, points.begin());
  return report;
}

std::optional<AvoidReport> Avoider::step(const PosedVessels& posed, const VolumeKeeper* volume,
                                         const Stride& stride, std::span<vec4> points) {
  State& state = *state_;
  AvoidReport report;
  const State::Input in{posed, volume, state.shape, report, stride.seconds, stride.inPlace};
  state.pool.clear();
  state.pose(posed);
  state.pace.begin(state.lastPosed, posed.points, stride.seconds);
  {
    StageClock clock(report.solveMs);
    state.comeAlong(in);
    state.place(in);
  }
  const auto refuse = [&] {
    state.refused.addTimes(report);
    return std::optional<AvoidReport>();
  };
  state.look(in, state.shape, State::Look::first);
  if (!stride.atAnyLength && state.isTooLong(in)) return refuse();
  state.solve(in, stride.isLast);
  if (!stride.atAnyLength && state.halvesMayHelp()) return refuse();
  state.giveWay(in, stride.isLast);
  if (state.isInTrouble()) state.solveAnew(in, stride.isLast, kNearPace);
  if (!state.remaining.empty()) state.solveAnew(in, stride.isLast, kNoLimit);
  report.addTimes(std::exchange(state.refused, {}));
  state.accept(posed);
  state.sumUp(in);
  std::ranges::copy(state.shape, points.begin());
  return report;
}

PosedLook Avoider::look(const PosedVessels& posed, std::span<const vec4> points) {
  State& state = *state_;
  if (state.bones) state.bones->pose(posed.jointMatrices);
  AvoidReport report;
  std::vector<vec4> own(points.begin(), points.end());
  state.look({posed, nullptr, own, report}, points, State::Look::first);
  return {certificateOf(state.places, &state.found), reportOf(state.boneContacts),
          tubesOf(state.skinContacts)};
}

const Correction& Avoider::correction() const { return state_->accepted; }
std::span<const Interference::Place> Avoider::remaining() const { return state_->unsettled; }
std::span<const NarrowPlace> Avoider::narrowed() const { return state_->narrowed; }
std::span<const BoneContact> Avoider::inBones() const { return state_->left; }
JointId Avoider::jointOfBone(std::uint32_t part) const { return state_->bones->jointOf(part); }
std::span<const Interference::Place> Avoider::found() const { return state_->found; }
const NetworkTubes& Avoider::layout() const { return state_->interference.layout(); }
std::size_t Avoider::restPairCount() const { return state_->interference.restPairCount(); }
std::size_t Avoider::restBoneContactCount() const {
  return state_->bones ? state_->bones->restContactCount() : 0;
}
std::size_t Avoider::neighbourCount() const { return state_->interference.neighbourCount(); }

}  // namespace vasa
