#include "avoid/bones.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "avoid/interference.h"
#include "collide/distance_field.h"
#include "core/parallel.h"
#include "math/aabb.h"

namespace vasa {
namespace {

constexpr int kLeastPieces = 3, kMostPieces = 6;  // of one tube
constexpr std::size_t kTubesPerTask = 64;
constexpr float kWidest = 0.6f;  // of the field's band: radius of a ball that is looked at
constexpr int kRing = 8;
constexpr float kStep = 0.001f;  // [m] of the search for the way out

// One part: what of a mesh one joint carries.
struct Part {
  std::uint32_t joint = 0;
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
};

std::uint32_t carrierOf(const SkinInfluence& influence) {
  std::size_t heaviest = 0;
  for (std::size_t k = 1; k < 4; ++k)
    if (influence.weights[int(k)] > influence.weights[int(heaviest)]) heaviest = k;
  return influence.joints[heaviest];
}

std::vector<Part> partsOf(const SkinnedMesh& mesh) {
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> vertices;  // of a joint: mesh's number -> part's
  std::map<std::uint32_t, Part> parts;
  for (const uvec3& triangle : mesh.mesh.triangles) {
    const std::uint32_t joint = carrierOf(mesh.influences[triangle.x]);
    Part& part = parts[joint];
    uvec3 own;
    for (int k = 0; k < 3; ++k) {
      const auto [at, fresh] = vertices[joint].try_emplace(triangle[k], std::uint32_t(part.positions.size()));
      if (fresh) part.positions.push_back(mesh.mesh.positions[triangle[k]]);
      own[k] = at->second;
    }
    part.triangles.push_back(own);
  }
  std::vector<Part> list;
  for (auto& [joint, part] : parts) part.joint = joint, list.push_back(std::move(part));
  return list;
}

vec3 unitOr(vec3 v, vec3 otherwise) {
  const float length = glm::length(v);
  return length > 1e-9f ? v / length : otherwise;
}

vec3 placed(const mat4& matrix, vec3 p) {
  return vec3(matrix * vec4(p, 1));
}

Aabb placed(const mat4& matrix, const Aabb& box) {
  Aabb out;
  for (int corner = 0; corner < 8; ++corner)
    out.add(placed(matrix, {corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y, corner & 4 ? box.high.z : box.low.z}));
  return out;
}

}  // namespace

struct Bones::State {
  struct Solid {
    std::uint32_t joint;
    DistanceField field;
    mat4 matrix{1}, inverse{1};                            // as bound -> posed, and back
    std::vector<std::pair<std::uint32_t, float>> atRest = {};  // tube, f < 0; sorted

    float allowed(std::uint32_t tube) const {
      const auto at = std::lower_bound(atRest.begin(), atRest.end(), tube,
                                       [](const auto& a, std::uint32_t b) { return a.first < b; });
      return at != atRest.end() && at->first == tube ? at->second : 0;
    }
  };
  std::vector<Solid> solids;
  std::vector<mat4> toBound;  // a joint's way from the rest pose to where meshes are bound
  std::vector<Bezier> rest;
  std::vector<Aabb> boxes;  // of the parts in the pose
  struct Near {
    std::uint32_t tube, part;
  };
  std::vector<std::vector<BoneContact>> found;  // a task each
  std::vector<std::vector<Near>> near;          // of the last look at all tubes, a task each
  std::vector<BoneContact> contacts;
  std::size_t restContacts = 0;

  void look(std::uint32_t tube, const Bezier& shape, const Bezier& posed, std::uint32_t part, std::vector<BoneContact>& out, bool* inBand = nullptr) const;
  void leave(const Solid& solid, vec3 from, vec3 towards, float radius, const DistanceField::Sample& sample, BoneContact& contact) const;
};

// Where the way out is, in the part's own space.
void Bones::State::leave(const Solid& solid, vec3 from, vec3 towards, float radius, const DistanceField::Sample& sample,
                         BoneContact& contact) const {
  vec3 surface = from, normal = sample.gradient;
  const float way = glm::distance(from, towards);
  const auto distanceAt = [&](float at) { return solid.field.distance(glm::mix(from, towards, at)); };
  // Through the part to the place at rest: in within a radius, and out again.
  float inside = 2, outside = 1;
  if (way > kStep && solid.field.distance(towards) > 0) {
    for (float at = 0; at < 1; at += kStep / way) {
      if (distanceAt(at) < 0) inside = at;
      else if (inside <= 1) { outside = at; break; }
      else if (at * way > radius) break;
    }
  }
  if (inside <= 1) {
    for (int k = 0; k < 8; ++k) {
      const float middle = 0.5f * (inside + outside);
      (distanceAt(middle) >= 0 ? outside : inside) = middle;
    }
    surface = glm::mix(from, towards, outside);
    normal = solid.field.at(surface).gradient;
  } else {
    surface = from - sample.distance * unitOr(normal, vec3(0));
  }
  normal = unitOr(normal, unitOr(towards - from, vec3(0, 1, 0)));
  contact.point = placed(solid.matrix, surface);
  contact.normal = glm::normalize(mat3(solid.matrix) * normal);
}

void Bones::State::look(std::uint32_t tube, const Bezier& shape, const Bezier& posed, std::uint32_t part,
                        std::vector<BoneContact>& out, bool* inBand) const {
  const Solid& solid = solids[part];
  const float allowed = solid.allowed(tube);
  const float length = glm::distance(vec3(shape.b[0]), vec3(shape.b[3]));
  const float largest = std::max(shape.b[0].w, shape.b[3].w);
  const int pieces = largest > 0 ? std::clamp(int(std::ceil(length / largest)), kLeastPieces, kMostPieces) : kMostPieces;
  for (int piece = 0; piece <= pieces; ++piece) {
    const float s = float(piece) / float(pieces);
    const vec4 ball = shape.at(s);
    const vec3 centre = placed(solid.inverse, vec3(ball)), before = placed(solid.inverse, vec3(posed.at(s)));
    const vec3 home = solid.field.distance(before) > 0 ? before : placed(toBound[solid.joint], vec3(rest[tube].at(s)));
    // A tube wider than the field's band is a ring of balls that are not.
    const float small = std::min(ball.w, kWidest * solid.field.band()), off = ball.w - small;
    const vec3 u = off > 0 ? anyPerpendicular(unitOr(mat3(solid.inverse) * vec3(shape.derivative(s)), {0, 0, 1})) : vec3(0);
    const vec3 v = off > 0 ? glm::cross(unitOr(mat3(solid.inverse) * vec3(shape.derivative(s)), {0, 0, 1}), u) : vec3(0);
    BoneContact deepest{.f = std::numeric_limits<float>::infinity()};
    for (int k = 0; k < (off > 0 ? kRing : 1); ++k) {
      const float angle = 2 * kPi * float(k) / kRing;
      const vec3 aside = off * (std::cos(angle) * u + std::sin(angle) * v), own = centre + aside;
      const DistanceField::Sample sample = solid.field.at(own);
      const float f = sample.distance - small;
      if (inBand) *inBand |= sample.distance < solid.field.band();
      if (f >= deepest.f || sample.distance >= solid.field.band() || allowed - f <= (allowed < 0 ? kRestTolerance : 0)) continue;
      deepest = {.tube = tube, .part = part, .s = s, .f = f, .allowed = allowed};
      leave(solid, own, home + aside, small, sample, deepest);
      deepest.point -= mat3(solid.matrix) * aside + off * deepest.normal;
    }
    if (deepest.f < 0) out.push_back(deepest);
  }
}

Bones::Bones(const Body& body, std::span<const Bezier> restTubes) : state_(std::make_unique<State>()) {
  for (const SkinnedMesh& mesh : body.meshes) {
    if (mesh.name == "skin" || mesh.influences.empty()) continue;
    for (const Part& part : partsOf(mesh))
      state_->solids.push_back({part.joint, DistanceField(part.positions, part.triangles, {})});
  }
  state_->rest.assign(restTubes.begin(), restTubes.end());
  std::vector<mat4> matrices;
  const Pose rest = restPose(body.skeleton);
  for (std::size_t j = 0; j < body.skeleton.joints.size(); ++j) {
    matrices.push_back(rest.world[j] * body.skeleton.joints[j].inverseBind);
    state_->toBound.push_back(glm::inverse(matrices.back()));
  }
  pose(matrices);
  contacts(restTubes, restTubes);
  for (const BoneContact& contact : state_->contacts) {
    auto& atRest = state_->solids[contact.part].atRest;
    if (atRest.empty() || atRest.back().first != contact.tube) atRest.emplace_back(contact.tube, contact.f), ++state_->restContacts;
    atRest.back().second = std::min(atRest.back().second, contact.f);
  }
}
Bones::~Bones() = default;
Bones::Bones(Bones&&) noexcept = default;

std::uint32_t Bones::partCount() const {
  return std::uint32_t(state_->solids.size());
}
std::size_t Bones::restContactCount() const {
  return state_->restContacts;
}
std::size_t Bones::bytes() const {
  std::size_t sum = 0;
  for (const State::Solid& solid : state_->solids) sum += solid.field.bytes();
  return sum;
}

void Bones::pose(std::span<const mat4> jointMatrices) {
  state_->boxes.clear();
  for (State::Solid& solid : state_->solids) {
    solid.matrix = jointMatrices[solid.joint];
    solid.inverse = glm::inverse(solid.matrix);
    state_->boxes.push_back(placed(solid.matrix, solid.field.box()));
  }
}

std::span<const BoneContact> Bones::contacts(std::span<const Bezier> tubes, std::span<const Bezier> posed, Which which) {
  State& state = *state_;
  const std::size_t tasks = (tubes.size() + kTubesPerTask - 1) / kTubesPerTask;
  state.found.resize(tasks);
  state.near.resize(tasks);
  parallelFor(tasks, 1, [&](std::size_t task) {
    auto& out = state.found[task];
    out.clear();
    if (which == Which::nearAtLast) {
      for (const auto& [tube, part] : state.near[task]) state.look(tube, tubes[tube], posed[tube], part, out);
      return;
    }
    state.near[task].clear();
    const std::size_t end = std::min(tubes.size(), (task + 1) * kTubesPerTask);
    Aabb all;
    for (std::size_t i = task * kTubesPerTask; i < end; ++i) all.add(tubes[i].bounds());
    for (std::uint32_t part = 0; part < state.solids.size(); ++part) {
      if (!state.boxes[part].overlaps(all)) continue;
      for (std::uint32_t i = std::uint32_t(task * kTubesPerTask); i < end; ++i) {
        bool near = false;
        if (state.boxes[part].overlaps(tubes[i].bounds())) state.look(i, tubes[i], posed[i], part, out, &near);
        if (near) state.near[task].push_back({i, part});
      }
    }
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
