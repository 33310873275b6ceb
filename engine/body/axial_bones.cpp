#include "body/axial_bones.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "body/bone_field.h"
#include "body/mesh_role.h"
#include "body/rig.h"
#include "math/aabb.h"
#include "math/closest_point.h"
#include "mesh/components.h"

namespace vasa {
namespace {

constexpr std::size_t kMostOfARib = 4;           // vertebrae and discs: more, and it is a cage of many ribs
constexpr std::size_t kMostInfluences = 0xffff;  // what an influence can name
// [m] between vertices of bones that are joined. Ribs and their vertebrae: 0 to 1 mm in both of our bodies;
// the first rib and the vertebra above its own, which is not joined to it: 2 and 4.5 mm; all others 16 and
// more.
constexpr float kJoined = 0.0015f;

/// A joint between hips and head and the line from it to the next one, where meshes are bound.
struct Link {
  JointId joint;
  vec3 from{0}, to{0};
};

struct SpineLine {
  JointId head;
  std::vector<Link> links;
};

SpineLine spineLine(const Skeleton& skeleton) {
  const Rig rig = rigOf(skeleton);
  const std::uint32_t hips = rig.partNamed("hips"), head = rig.partNamed("head");
  if (hips == kNone || head == kNone || !hangsOn(rig.parents, head, hips)) return {};
  const auto place = [&](std::uint32_t joint) {
    return vec3(glm::inverse(skeleton.joints[joint].inverseBind)[3]);
  };
  SpineLine line{{head}, {}};
  for (std::uint32_t above = head, at = rig.parents[head]; at != hips; above = at, at = rig.parents[at])
    line.links.push_back({{at}, place(at), place(above)});
  std::ranges::reverse(line.links);
  return line;
}

bool passesThrough(const Link& link, const Aabb& box) {
  float first = 0, last = 1;
  for (int k = 0; k < 3; ++k) {
    const float way = link.to[k] - link.from[k];
    const float low = (box.low[k] - link.from[k]) / way, high = (box.high[k] - link.from[k]) / way;
    if (way == 0) {
      if (link.from[k] < box.low[k] || link.from[k] > box.high[k]) return false;
      continue;
    }
    first = std::max(first, std::min(low, high));
    last = std::min(last, std::max(low, high));
  }
  return first <= last;
}

/// A part of a rigid mesh of which at least something moves with the spine.
struct Part {
  std::size_t mesh = 0;
  std::vector<std::uint32_t> vertices = {};
  Aabb box = {};
  std::uint32_t carrier = kNone;  // kNone where there are several
  bool isOfSpine = false;         // something of it is carried by a joint between hips and head
};

/// Where a part is joined to another.
struct Joined {
  const Part* part;  // the other
  vec3 place;        // of the first, where it is bound
  float distance;
};

struct Rib {
  const Part* part;
  Joined at;  // its vertebra
};

class Separator {
 public:
  explicit Separator(Body& body) : body_(body), line_(spineLine(body.skeleton)) {
    if (line_.links.empty()) return;
    for (const Link& link : line_.links)
      longestLink_ = std::max(longestLink_, glm::distance(link.from, link.to));
    for (std::size_t m = 0; m < body.meshes.size(); ++m)
      if (movesByRigidParts(body.meshes[m]) && isSolid(body.meshes[m])) collect(m);
  }

  void run() {
    std::vector<const Part*> vertebrae, others, blocks;
    std::vector<Rib> ribs;
    for (const Part& part : parts_) (isVertebra(part) ? vertebrae : others).push_back(&part);
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const Part* other : others) {
      const std::vector<Joined> joined = joinedTo(*other, vertebrae);
      if (isRib(*other, joined)) {
        // Its own is the lowest: heads of ribs reach up to the one above.
        ribs.push_back(
            {other, std::ranges::min(joined, {}, [&](const Joined& own) { return along(*own.part); })});
        continue;
      }
      blocks.push_back(other);
      for (const Joined& own : joined) {
        low = std::min(low, along(*own.part));
        high = std::max(high, along(*own.part));
      }
    }
    std::vector<std::uint32_t> numbers(parts_.size(), kNone);
    for (const Part* part : vertebrae)
      if (along(*part) < low || along(*part) > high)
        numbers[indexOf(part)] = add(*part, {{part->carrier}, line_.head, atRest(*part, part->box.centre())});
    for (const Rib& rib : ribs)
      if (const std::uint32_t vertebra = numbers[indexOf(rib.at.part)]; vertebra != kNone)
        addRib(rib, vertebra, blocks);
  }

 private:
  void collect(std::size_t meshIndex) {
    const SkinnedMesh& mesh = body_.meshes[meshIndex];
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < mesh.influences.size(); ++v)
      if (linkOf(soleCarrier(mesh.influences[v]))) vertices.push_back(v);
    if (vertices.empty()) return;
    DisjointSets sets = joinedVertices(mesh.mesh, std::move(vertices));
    std::vector<std::uint32_t> number(mesh.influences.size(), kNone);
    for (std::uint32_t v = 0; v < mesh.influences.size(); ++v) {
      const std::uint32_t carrier = soleCarrier(mesh.influences[v]);
      std::uint32_t& own = number[sets.find(v)];
      if (own == kNone) {
        own = std::uint32_t(parts_.size());
        parts_.push_back({.mesh = meshIndex, .carrier = carrier});
      }
      Part& part = parts_[own];
      part.vertices.push_back(v);
      part.box.add(mesh.mesh.positions[v]);
      if (carrier != part.carrier) part.carrier = kNone;
      part.isOfSpine |= linkOf(carrier) != nullptr;
    }
  }

  const Link* linkOf(std::uint32_t joint) const {
    const auto link = std::ranges::find(line_.links, JointId{joint}, &Link::joint);
    return joint != kNone && link != line_.links.end() ? &*link : nullptr;
  }

  bool isVertebra(const Part& part) const {
    const Link* own = linkOf(part.carrier);
    if (!own) return false;
    const vec3 along = glm::abs(glm::normalize(own->to - own->from));
    return glm::dot(part.box.extent(), along) < longestLink_ && isAroundLine(part);
  }

  /// Beside the spine, and joined to a vertebra, the one above and what is between.
  bool isRib(const Part& part, std::span<const Joined> joined) const {
    return linkOf(part.carrier) && !joined.empty() && joined.size() <= kMostOfARib && !isAroundLine(part);
  }

  bool isAroundLine(const Part& part) const {
    return std::ranges::any_of(line_.links, [&](const Link& link) { return passesThrough(link, part.box); });
  }

  vec3 place(const Part& part, std::uint32_t vertex) const {
    return body_.meshes[part.mesh].mesh.positions[vertex];
  }

  /// Where two parts are nearest to one another, if that is near enough for them to be joined.
  std::optional<Joined> join(const Part& part, const Part& other) const {
    const auto within = [&](const Part& own, const Part& of) {
      Aabb near;
      near.add(of.box.low, kJoined);
      near.add(of.box.high, kJoined);
      std::vector<vec3> places;
      if (!near.overlaps(own.box)) return places;
      for (const std::uint32_t v : own.vertices)
        if (const vec3 p = place(own, v); near.distance(p) == 0) places.push_back(p);
      return places;
    };
    Joined nearest{&other, vec3(0), kJoined};
    std::vector<vec3> theirs = within(other, part);
    std::ranges::sort(theirs, {}, &vec3::x);
    for (const vec3& p : within(part, other))
      for (auto q = std::ranges::lower_bound(theirs, p.x - kJoined, {}, &vec3::x);
           q != theirs.end() && q->x < p.x + kJoined; ++q)
        if (const float distance = glm::distance(p, *q); distance < nearest.distance)
          nearest.place = p, nearest.distance = distance;
    if (nearest.distance < kJoined) return nearest;
    return {};
  }

  std::vector<Joined> joinedTo(const Part& part, std::span<const Part* const> others) const {
    std::vector<Joined> joined;
    for (const Part* other : others)
      if (part.isOfSpine && other->isOfSpine)
        if (const auto own = join(part, *other)) joined.push_back(*own);
    return joined;
  }

  /// How far up the spine a part is.
  float along(const Part& part) const {
    float nearest = std::numeric_limits<float>::infinity(), place = 0, below = 0;
    for (const Link& link : line_.links) {
      const float share = closestOnSegment(part.box.centre(), link.from, link.to);
      const float away = glm::distance(part.box.centre(), glm::mix(link.from, link.to, share));
      const float length = glm::distance(link.from, link.to);
      if (away < nearest) nearest = away, place = below + share * length;
      below += length;
    }
    return place;
  }

  vec3 atRest(const Part& part, vec3 bound) const {
    const Skeleton::Joint& joint = body_.skeleton.joints[part.carrier];
    return vec3(joint.restWorld * joint.inverseBind * vec4(bound, 1));
  }

  /// @return its number among the axial bones
  std::uint32_t add(const Part& part, const AxialBone& bone) {
    const std::size_t own = body_.axialBones.size(), named = body_.skeleton.joints.size() + own;
    if (named > kMostInfluences) return kNone;
    body_.axialBones.push_back(bone);
    for (const std::uint32_t v : part.vertices)
      body_.meshes[part.mesh].influences[v] = {{std::uint16_t(named)}, {1, 0, 0, 0}};
    return std::uint32_t(own);
  }

  /// Its front is held where that is joined to what keeps to its block: the breastbone's cartilage.
  void addRib(const Rib& rib, std::uint32_t vertebra, std::span<const Part* const> blocks) {
    const Part& part = *rib.part;
    vec3 front = rib.at.place;
    for (const std::uint32_t v : part.vertices)
      if (const vec3 p = place(part, v); glm::distance(p, rib.at.place) > glm::distance(front, rib.at.place))
        front = p;
    AxialBone bone{{part.carrier}, line_.head, atRest(part, front), vertebra, atRest(part, rib.at.place)};
    float farthest = 0.5f * glm::distance(front, rib.at.place);  // what holds it nearer is not at its front
    for (const Joined& held : joinedTo(part, blocks))
      if (const float away = glm::distance(held.place, rib.at.place); away > farthest) {
        if (held.part->carrier == kNone) continue;
        farthest = away;
        bone.place = atRest(part, held.place);
        bone.frontCarrier = {held.part->carrier};
      }
    add(part, bone);
  }

  std::size_t indexOf(const Part* part) const { return std::size_t(part - parts_.data()); }

  Body& body_;
  SpineLine line_;
  float longestLink_ = 0;  // [m]
  std::vector<Part> parts_;
};

}  // namespace

void separateAxialBones(Body& body) { Separator(body).run(); }

}  // namespace vasa
