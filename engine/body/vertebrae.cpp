#include "body/vertebrae.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "body/bone_field.h"
#include "body/rig.h"
#include "core/disjoint_sets.h"
#include "math/aabb.h"
#include "math/closest_point.h"

namespace vasa {
namespace {

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

/// Parts hang together by triangles, and where places of `vertices` are the same.
DisjointSets partsOf(const TriangleMesh& mesh, std::vector<std::uint32_t> vertices) {
  DisjointSets sets(mesh.positions.size());
  for (const uvec3& t : mesh.triangles) sets.unite(t.x, t.y), sets.unite(t.x, t.z);
  const auto place = [&](std::uint32_t v) {
    const vec3& p = mesh.positions[v];
    return std::tuple(p.x, p.y, p.z);
  };
  std::ranges::sort(vertices, {}, place);
  for (std::size_t i = 1; i < vertices.size(); ++i)
    if (place(vertices[i - 1]) == place(vertices[i])) sets.unite(vertices[i - 1], vertices[i]);
  return sets;
}

/// A part of a rigid mesh of which at least something moves with the spine.
struct Part {
  std::size_t mesh = 0;
  std::vector<std::uint32_t> vertices = {};
  Aabb box = {};
  std::uint32_t carrier = kNone;  // kNone where there are several
};

class Separator {
 public:
  explicit Separator(Body& body) : body_(body), line_(spineLine(body.skeleton)) {
    if (line_.links.empty()) return;
    for (std::size_t m = 0; m < body.meshes.size(); ++m)
      if (movesByRigidParts(body.meshes[m])) collect(m);
  }

  void run() {
    std::vector<const Part*> vertebrae, others;
    for (const Part& part : parts_) (isVertebra(part) ? vertebrae : others).push_back(&part);
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const Part* part : vertebrae)
      if (std::ranges::any_of(others, [&](const Part* other) { return touch(*part, *other); })) {
        low = std::min(low, along(*part));
        high = std::max(high, along(*part));
      }
    for (const Part* part : vertebrae)
      if (along(*part) < low || along(*part) > high) add(*part);
  }

 private:
  void collect(std::size_t meshIndex) {
    const SkinnedMesh& mesh = body_.meshes[meshIndex];
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < mesh.influences.size(); ++v)
      if (linkOf(soleCarrier(mesh.influences[v]))) vertices.push_back(v);
    if (vertices.empty()) return;
    DisjointSets sets = partsOf(mesh.mesh, std::move(vertices));
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
    }
  }

  const Link* linkOf(std::uint32_t joint) const {
    const auto link = std::ranges::find(line_.links, JointId{joint}, &Link::joint);
    return joint != kNone && link != line_.links.end() ? &*link : nullptr;
  }

  bool isVertebra(const Part& part) const {
    const Link* own = linkOf(part.carrier);
    if (!own) return false;
    const vec3 way = glm::abs(own->to - own->from);
    const float length = glm::length(way);
    return glm::dot(part.box.extent(), way) < length * length &&
           std::ranges::any_of(line_.links, [&](const Link& link) { return passesThrough(link, part.box); });
  }

  bool touch(const Part& a, const Part& b) const {
    Aabb near;
    near.add(a.box.low, kJoined);
    near.add(a.box.high, kJoined);
    if (!linkOf(b.carrier) || !near.overlaps(b.box)) return false;
    const auto place = [&](const Part& part, std::uint32_t v) {
      return body_.meshes[part.mesh].mesh.positions[v];
    };
    return std::ranges::any_of(b.vertices, [&](std::uint32_t v) {
      const vec3 p = place(b, v);
      return near.distance(p) == 0 && std::ranges::any_of(a.vertices, [&](std::uint32_t w) {
               return glm::distance(place(a, w), p) < kJoined;
             });
    });
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

  void add(const Part& part) {
    const std::size_t number = body_.skeleton.joints.size() + body_.vertebrae.size();
    if (number > kMostInfluences) return;
    const Skeleton::Joint& joint = body_.skeleton.joints[part.carrier];
    const vec3 centre(joint.restWorld * joint.inverseBind * vec4(part.box.centre(), 1));
    body_.vertebrae.push_back({{part.carrier}, line_.head, centre});
    for (const std::uint32_t v : part.vertices)
      body_.meshes[part.mesh].influences[v] = {{std::uint16_t(number)}, {1, 0, 0, 0}};
  }

  Body& body_;
  SpineLine line_;
  std::vector<Part> parts_;
};

}  // namespace

void separateVertebrae(Body& body) { Separator(body).run(); }

}  // namespace vasa
