#include "solids/bones.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "body/skinning.h"
#include "collide/distance_field.h"
#include "core/parallel.h"
#include "math/aabb.h"
#include "math/direction.h"
#include "solids/solid_parts.h"

namespace vasa {
namespace {

constexpr int kLeastPieces = 3, kMostPieces = 6;  // of one tube
constexpr std::size_t kTubesPerTask = 64;
constexpr float kWidest = 0.6f;  // of the field's band: radius of a ball that is looked at
constexpr int kRing = 8;
constexpr float kSearchStep = 0.001f;  // [m] of the search for the way out, at least
constexpr float kStride = 0.8f;        // ... and of the distance
constexpr float kSteepest = 1.7321f;   // a field's slope along each axis is at most 1
constexpr float kRounding = 1e-6f;     // [m] of what a field gives for a place
constexpr float kUnknown = std::numeric_limits<float>::lowest();  // how far a tube is from entering, at least
constexpr float kAnywhere = std::numeric_limits<float>::lowest();  // how deep a tube may be
constexpr float kMovedFar = 0.002f;  // [m] less brings no tube from beyond a field's band into a part

vec3 placed(const mat4& matrix, vec3 p) { return vec3(matrix * vec4(p, 1)); }

// By control points, at most; wider or thinner counts, too.
float distanceMoved(const Bezier& a, const Bezier& b) {
  float most = 0;
  for (int k = 0; k < 4; ++k)
    most = std::max(most, glm::distance(vec3(a.b[k]), vec3(b.b[k])) + std::abs(a.b[k].w - b.b[k].w));
  return most;
}

int piecesOf(const Bezier& rest) {
  const float length = glm::distance(vec3(rest.b[0]), vec3(rest.b[3])),
              largest = std::max(rest.b[0].w, rest.b[3].w);
  return largest > 0 ? std::clamp(int(std::ceil(length / largest)), kLeastPieces, kMostPieces) : kMostPieces;
}

Aabb placed(const mat4& matrix, const Aabb& box) {
  Aabb out;
  for (int corner = 0; corner < 8; ++corner)
    out.add(placed(matrix, {corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                            corner & 4 ? box.high.z : box.low.z}));
  return out;
}

// Bernstein's polynomials at the places of a tube of so many pieces.
const auto kWeights = [] {
  std::array<std::array<vec4, kMostPieces + 1>, kMostPieces + 1> weights{};
  for (int pieces = 1; pieces <= kMostPieces; ++pieces)
    for (int k = 0; k <= pieces; ++k) weights[pieces][k] = bernstein(float(k) / float(pieces));
  return weights;
}();

}  // namespace

struct Bones::State {
  struct Solid {
    std::uint32_t joint;
    DistanceField field;
    mat4 matrix{1}, inverse{1};  // as bound -> posed, and back
    mat4 inverseBefore{1};       // of the pose before
    // Tube, and f < 0: how deep it may be; sorted. Where even the axis of a thin one lies in the part, that
    // is anywhere: the ways out of a rib lead to all sides there, and what keeps to one in a round keeps to
    // another in the next. Not so of the great vessels in the heart.
    std::vector<std::pair<std::uint32_t, float>> atRest = {};

    float allowed(std::uint32_t tube) const {
      const auto at = std::lower_bound(atRest.begin(), atRest.end(), tube,
                                       [](const auto& a, std::uint32_t b) { return a.first < b; });
      return at != atRest.end() && at->first == tube ? at->second : 0;
    }
  };
  struct Near {
    std::uint32_t tube, part;
    float allowed;
    float f = 0;  // no more than it was anywhere on the tube when all were looked at
  };
  struct Seen {  // a pair when it was looked at last, maybe some frames ago
    std::uint32_t part, tube;
    float f;
    Bezier shape;  // in the part's own space
    bool before(std::uint32_t otherPart, std::uint32_t otherTube) const {
      return part != otherPart ? part < otherPart : tube < otherTube;
    }
  };
  struct Tubes {
    std::span<const Bezier> now, last;
    std::span<const char> anew, moved;
    bool stays(std::uint32_t tube) const { return !moved.empty() && !moved[tube]; }
  };
  std::vector<Bezier> rest;  // tubes
  std::vector<Solid> solids;
  std::vector<JointId> carriers;                    // of them
  std::vector<Bezier> base;                         // the shape when all were looked at last
  std::vector<int> pieces;                          // a tube each
  std::vector<Aabb> boxes;                          // of the parts in the pose
  std::vector<std::vector<BoneContact>> found;      // a task each
  std::vector<std::vector<Near>> near;              // of the last look at all tubes, a task each
  std::vector<std::vector<Seen>> seen, seenBefore;  // likewise; by part, then tube
  std::vector<BoneContact> contacts;
  std::size_t restContacts = 0;
  std::uint64_t key = 0;         // of the fields, where they are kept ...
  std::uint32_t keptBricks = 0;  // ... and how much of them is

  void keepFields();
  void lookAtAll(std::size_t task, const Tubes& tubes, std::vector<BoneContact>& out);
  void lookAtNear(std::size_t task, const Tubes& tubes, std::vector<BoneContact>& out);
  void findNewlyNear(std::size_t task, const Tubes& tubes);
  bool mayTouch(const Aabb& box, std::uint32_t part) const;
  std::optional<bool> lookIfThin(Near& at, const Bezier& shape) const;
  Bezier inPart(std::uint32_t part, Bezier shape) const;
  bool look(Near& at, const Bezier& shape, const Tubes& tubes, std::vector<BoneContact>& out) const;
  vec3 home(const Near& at, float s, const Tubes& tubes) const;
  bool isFree(const vec4& ball, std::uint32_t part) const;
  void leave(const Solid& solid, vec3 from, vec3 towards, float radius, BoneContact& contact) const;
};

// Where the way out is, in the part's own space.
void Bones::State::leave(const Solid& solid, vec3 from, vec3 towards, float radius,
                         BoneContact& contact) const {
  const DistanceField::Sample sample = solid.field.at(from);
  vec3 surface = from - sample.distance * unitOr(sample.gradient, vec3(0)), normal = sample.gradient;
  contact.nearestPoint = placed(solid.matrix, surface);
  contact.nearestNormal = mat3(solid.matrix) * unitOr(normal, vec3(0));
  const float way = glm::distance(from, towards);
  const auto distanceAt = [&](float at) { return solid.field.distance(glm::mix(from, towards, at)); };
  // Through the part to the place at rest: in within a radius, and out again.
  float inside = 2, outside = 1;
  if (way > kSearchStep && solid.field.distance(towards) > 0) {
    for (float at = 0; at < 1;) {
      const float distance = distanceAt(at);
      if (distance < 0)
        inside = at;
      else if (inside <= 1) {
        outside = at;
        break;
      } else if (at * way > radius)
        break;
      at += std::max(kSearchStep, kStride * std::abs(distance)) / way;
    }
  }
  if (inside <= 1) {
    for (int k = 0; k < 8; ++k) {
      const float middle = 0.5f * (inside + outside);
      (distanceAt(middle) >= 0 ? outside : inside) = middle;
    }
    surface = glm::mix(from, towards, outside);
    normal = solid.field.at(surface).gradient;
  }
  normal = unitOr(normal, unitOr(towards - from, vec3(0, 1, 0)));
  contact.point = placed(solid.matrix, surface);
  contact.normal = glm::normalize(mat3(solid.matrix) * normal);
}

// Where the place was before, or at rest, as the part sees it: the side of the part to which it belongs.
vec3 Bones::State::home(const Near& at, float s, const Tubes& tubes) const {
  if (!tubes.anew.empty() && tubes.anew[at.tube]) return vec3(rest[at.tube].at(s));
  return placed(solids[at.part].inverseBefore, vec3(tubes.last[at.tube].at(s)));
}

// Whether a ball in the pose touches no part but its own.
bool Bones::State::isFree(const vec4& ball, std::uint32_t own) const {
  const vec3 centre(ball);
  for (std::uint32_t part = 0; part < solids.size(); ++part)
    if (part != own && boxes[part].overlaps({centre, centre}) &&
        solids[part].field.clearance(placed(solids[part].inverse, centre)) < ball.w)
      return false;
  return true;
}

// What most tubes need: the same for one that is thin and enters nowhere, all its places at once. Nothing for
// others.
std::optional<bool> Bones::State::lookIfThin(Near& at, const Bezier& shape) const {
  const DistanceField& field = solids[at.part].field;
  std::array<vec4, kMostPieces + 1> balls;
  std::array<float, kMostPieces + 1> distances;
  const int count = pieces[at.tube] + 1;
  for (int k = 0; k < count; ++k) {
    const vec4& w = kWeights[count - 1][k];
    balls[k] = w.x * shape.b[0] + w.y * shape.b[1] + w.z * shape.b[2] + w.w * shape.b[3];
  }
  field.distances(std::span(balls).first(count), distances);
  float f = std::numeric_limits<float>::max();
  bool inBand = false;
  for (int k = 0; k < count; ++k) {
    if (balls[k].w > kWidest * field.band()) return {};
    f = std::min(f, distances[k] - balls[k].w);
    inBand |= distances[k] < field.band();
  }
  if (f < at.allowed) return {};
  at.f = f;
  return inBand;
}

Bezier Bones::State::inPart(std::uint32_t part, Bezier shape) const {
  for (vec4& b : shape.b) b = vec4(placed(solids[part].inverse, vec3(b)), b.w);
  return shape;
}

// Returns whether the tube is within the field's band somewhere. @param shape  in the part's own space
bool Bones::State::look(Near& at, const Bezier& shape, const Tubes& tubes,
                        std::vector<BoneContact>& out) const {
  const Solid& solid = solids[at.part];
  const DistanceField& field = solid.field;
  if (const std::optional<bool> isNear = lookIfThin(at, shape)) return *isNear;
  bool inBand = false;
  at.f = std::numeric_limits<float>::max();
  vec3 measured(0);  // where the field was read last
  float there = -field.band();
  for (int piece = 0; piece <= pieces[at.tube]; ++piece) {
    const float s = float(piece) / float(pieces[at.tube]);
    const vec4 ball = shape.at(s);
    const vec3 centre(ball);
    // A tube wider than the field's band is a ring of balls that are not.
    const float small = std::min(ball.w, kWidest * field.band()), off = ball.w - small;
    if (off > 0) at.f = kUnknown;  // its ring turns with the tube
    if (off > 0 && field.clearance(centre) > ball.w + field.band()) continue;
    const vec3 along = off > 0 ? unitOr(vec3(shape.derivative(s)), {0, 0, 1}) : vec3(0);
    const vec3 u = off > 0 ? anyPerpendicular(along) : vec3(0), v = glm::cross(along, u);
    BoneContact deepest{.tube = at.tube, .part = at.part, .s = s, .f = at.allowed, .allowed = at.allowed};
    vec3 deepestAside(0);
    for (int k = 0; k < (off > 0 ? kRing : 1); ++k) {
      const float angle = 2 * kPi * float(k) / kRing;
      const vec3 aside = off > 0 ? off * (std::cos(angle) * u + std::sin(angle) * v) : vec3(0);
      const float atLeast = there - kSteepest * glm::distance(measured, centre + aside);
      if (inBand ? atLeast - small >= deepest.f : atLeast >= field.band()) {
        at.f = std::min(at.f, atLeast - small);
        continue;
      }
      const float distance = field.distance(centre + aside);
      measured = centre + aside, there = distance;
      at.f = std::min(at.f, distance - small);
      if (distance >= field.band()) continue;
      inBand = true;
      if (distance - small >= deepest.f) continue;
      deepest.f = distance - small;
      deepestAside = aside;
    }
    if (!deepest.enters()) continue;
    const vec3 from = centre + deepestAside;
    leave(solid, from, home(at, s, tubes) + deepestAside, small, deepest);
    deepest.point -= mat3(solid.matrix) * deepestAside + off * deepest.normal;
    deepest.nearestPoint -= mat3(solid.matrix) * deepestAside + off * deepest.nearestNormal;
    // Beyond where the straight way leaves the part, and in it even so; or into another part that way, and
    // not the other.
    const vec3 now(tubes.now[at.tube].at(s));
    const auto leadsInto = [&](vec3 point, vec3 normal) {
      return !isFree({point + ball.w * normal, ball.w}, at.part);
    };
    if (deepest.nearestNormal != vec3(0) &&
        (glm::dot(deepest.normal, now - deepest.point) >= ball.w + at.allowed ||
         (leadsInto(deepest.point, deepest.normal) &&
          !leadsInto(deepest.nearestPoint, deepest.nearestNormal))))
      deepest.point = deepest.nearestPoint, deepest.normal = deepest.nearestNormal;
    out.push_back(deepest);
  }
  return inBand;
}

// Pairs that have come near one another since, for a tube was moved a long way.
void Bones::State::findNewlyNear(std::size_t task, const Tubes& tubes) {
  const std::size_t begin = task * kTubesPerTask, end = std::min(tubes.now.size(), begin + kTubesPerTask);
  for (std::uint32_t i = std::uint32_t(begin); i < end; ++i) {
    if (tubes.stays(i) || distanceMoved(tubes.now[i], base[i]) < kMovedFar) continue;
    const Aabb box = tubes.now[i].bounds();
    for (std::uint32_t part = 0; part < solids.size(); ++part) {
      if (!boxes[part].overlaps(box)) continue;
      if (std::ranges::any_of(near[task], [&](const Near& at) { return at.tube == i && at.part == part; }))
        continue;
      if (mayTouch(box, part)) near[task].push_back({i, part, solids[part].allowed(i), kUnknown});
    }
  }
}

// ... now, or once what is in the box was moved, though not far.
bool Bones::State::mayTouch(const Aabb& box, std::uint32_t part) const {
  const vec3 middle = placed(solids[part].inverse, 0.5f * (box.low + box.high));
  return solids[part].field.clearance(middle) <= 0.5f * glm::length(box.extent()) + kMovedFar;
}

// Pairs of tubes and parts that may be near one another. One that has moved less against the part, since it
// was looked at, than it was from entering has not entered: most vessels go along with the bones beside them.
void Bones::State::lookAtAll(std::size_t task, const Tubes& tubes, std::vector<BoneContact>& out) {
  const std::span<const Bezier> now = tubes.now;
  std::swap(seen[task], seenBefore[task]);
  seen[task].clear();
  near[task].clear();
  out.clear();
  auto last = seenBefore[task].begin();
  const auto lastEnd = seenBefore[task].end();
  const std::size_t begin = task * kTubesPerTask, end = std::min(now.size(), begin + kTubesPerTask);
  std::array<Aabb, kTubesPerTask> boxesOf;
  Aabb all;
  for (std::size_t i = begin; i < end; ++i) boxesOf[i - begin] = now[i].bounds(), all.add(boxesOf[i - begin]);
  for (std::uint32_t part = 0; part < solids.size(); ++part) {
    if (!boxes[part].overlaps(all)) continue;
    for (std::uint32_t i = std::uint32_t(begin); i < end; ++i) {
      const Aabb& box = boxesOf[i - begin];
      if (!boxes[part].overlaps(box)) continue;
      while (last != lastEnd && last->before(part, i)) ++last;
      const bool known = last != lastEnd && last->part == part && last->tube == i;
      if (!known && !mayTouch(box, part)) continue;
      const Bezier shape = inPart(part, now[i]);
      Near at{i, part, solids[part].allowed(i)};
      if (known) at.f = last->f - kSteepest * distanceMoved(last->shape, shape) - kRounding;
      if (known && at.f > at.allowed) {
        seen[task].push_back(*last);
        near[task].push_back(at);
        continue;
      }
      const bool inBand = look(at, shape, tubes, out);
      seen[task].push_back({part, i, at.f, shape});
      if (inBand) near[task].push_back(at);
    }
  }
}

// What was not moved as far as it was from entering has not entered. @param out  what was found last
void Bones::State::lookAtNear(std::size_t task, const Tubes& tubes, std::vector<BoneContact>& out) {
  findNewlyNear(task, tubes);
  std::erase_if(out, [&](const BoneContact& contact) { return !tubes.stays(contact.tube); });
  for (Near at : near[task])
    if (!tubes.stays(at.tube) &&
        at.f - at.allowed <= kSteepest * distanceMoved(tubes.now[at.tube], base[at.tube]))
      look(at, inPart(at.part, tubes.now[at.tube]), tubes, out);
}

// What was looked at, if that is more than what is kept: for the first tube that comes to a place that was
// never looked at waits for the part's search tree.
void Bones::State::keepFields() {
  std::uint32_t filled = 0;
  std::vector<const DistanceField*> fields;
  for (const Solid& solid : solids) fields.push_back(&solid.field), filled += solid.field.filledBricks();
  if (filled <= keptBricks) return;
  SolidParts::keepFields(key, fields);
  keptBricks = filled;
}

Bones::Bones(const Body& body, std::span<const Bezier> restTubes) : state_(std::make_unique<State>()) {
  const SolidParts parts(body);
  state_->key = parts.key();
  std::vector<DistanceField> fields = parts.fields();
  for (std::size_t k = 0; k < fields.size(); ++k) {
    state_->keptBricks += fields[k].filledBricks();
    state_->solids.push_back({parts.joint(k), std::move(fields[k])});
    state_->carriers.push_back({body.carrier(parts.joint(k))});
  }
  state_->rest.assign(restTubes.begin(), restTubes.end());
  for (const Bezier& tube : restTubes) state_->pieces.push_back(piecesOf(tube));
  pose(skinMatrices(body, restPose(body.skeleton)));
  keepPose();
  contacts(restTubes, restTubes);
  for (const BoneContact& contact : state_->contacts) {
    auto& atRest = state_->solids[contact.part].atRest;
    if (atRest.empty() || atRest.back().first != contact.tube)
      atRest.emplace_back(contact.tube, contact.f), ++state_->restContacts;
    const float radius = restTubes[contact.tube].at(contact.s).w;
    const bool isSunk = contact.f < -radius && radius <= kWidest * state_->solids[contact.part].field.band();
    atRest.back().second = std::min(atRest.back().second, isSunk ? kAnywhere : contact.f);
  }
  state_->keepFields();
}

Bones::~Bones() {
  if (!state_) return;
  try {
    state_->keepFields();
  } catch (const std::exception&) {  // the next run looks again
  }
}
Bones::Bones(Bones&&) noexcept = default;

std::uint32_t Bones::partCount() const { return std::uint32_t(state_->solids.size()); }
JointId Bones::jointOf(std::uint32_t part) const { return state_->carriers[part]; }
std::size_t Bones::restContactCount() const { return state_->restContacts; }
std::size_t Bones::bytes() const {
  std::size_t sum = 0;
  for (const State::Solid& solid : state_->solids) sum += solid.field.bytes();
  return sum;
}

void Bones::keepPose() {
  for (State::Solid& solid : state_->solids) solid.inverseBefore = solid.inverse;
}

void Bones::pose(std::span<const mat4> jointMatrices) {
  state_->boxes.clear();
  for (State::Solid& solid : state_->solids) {
    solid.matrix = jointMatrices[solid.joint];
    solid.inverse = glm::inverse(solid.matrix);
    state_->boxes.push_back(placed(solid.matrix, solid.field.box()));
  }
}

std::span<const BoneContact> Bones::contacts(std::span<const Bezier> tubes, std::span<const Bezier> last,
                                             Which which, std::span<const char> anew,
                                             std::span<const char> moved) {
  State& state = *state_;
  if (which == Which::all) state.base.assign(tubes.begin(), tubes.end());
  const std::size_t tasks = (tubes.size() + kTubesPerTask - 1) / kTubesPerTask;
  state.found.resize(tasks);
  state.near.resize(tasks);
  state.seen.resize(tasks);
  state.seenBefore.resize(tasks);
  parallelFor(tasks, 1, [&](std::size_t task) {
    if (which == Which::all)
      state.lookAtAll(task, {tubes, last, anew, moved}, state.found[task]);
    else
      state.lookAtNear(task, {tubes, last, anew, moved}, state.found[task]);
  });
  state.contacts.clear();
  for (std::size_t task = 0; task < tasks; ++task)
    state.contacts.insert(state.contacts.end(), state.found[task].begin(), state.found[task].end());
  std::sort(state.contacts.begin(), state.contacts.end(), [](const BoneContact& a, const BoneContact& b) {
    return std::tie(a.tube, a.part, a.s) < std::tie(b.tube, b.part, b.s);
  });
  return state.contacts;
}

}  // namespace vasa
