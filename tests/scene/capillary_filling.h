#pragma once
#include "body/mesh_role.h"
#include "body/skin_field.h"
#include "body/skin_shell.h"
#include "core/parallel.h"
#include "curve/bezier.h"
#include "scene/scene.h"

namespace vasa::test {

/// Where a body's capillaries lie at rest.
struct Filling {
  std::size_t places = 0;   ///< looked at: five on every curve
  std::size_t outside = 0;  ///< of them out of the skin
  std::size_t inBone = 0;
  float thigh = 0, scalp = 0, brain = 0, lungs = 0, liver = 0, kidneys = 0,
        heart = 0;     ///< share of the centimetre cubes of flesh there that a curve runs through
  float windpipe = 0;  ///< share of the places in the box around the windpipe that lie in it
};

class FillingMeter {
 public:
  explicit FillingMeter(const Scene& scene) : skin_(skinAtRest(scene.body)) {
    for (const SkinnedMesh& mesh : scene.body.meshes) {
      if (&mesh == skinOf(scene.body)) continue;
      const TriangleMesh rest = meshAtRest(scene.body, mesh);
      const bool keepsOut = roleNamed(mesh.name) == MeshRole::keepOut;  // of the heart: walls and chambers
      (keepsOut ? keptOut_ : isSolid(mesh) ? bones_ : organs_).emplace_back(rest.positions, rest.triangles);
      if (!isSolid(mesh)) organNames_.push_back(mesh.name), organBounds_.push_back(rest.bounds());
    }
    const auto joint = [&](const char* name) {
      return vec3(scene.body.skeleton.joints[scene.body.skeleton.find(name).value].restWorld[3]);
    };
    hip_ = joint("LeftUpLeg"), knee_ = joint("LeftLeg"), head_ = joint("Head");
  }

  Filling measure(std::span<const Bezier> curves) const {
    Filling filling;
    std::vector<vec3> places;
    for (const Bezier& curve : curves)
      for (int i = 0; i <= 4; ++i) places.emplace_back(curve.at(float(i) / 4));
    filling.places = places.size();
    std::vector<std::uint8_t> faults(places.size());
    parallelFor(places.size() / 20, 256, [&](std::size_t k) {
      const std::size_t i =
          k * 20 + k % 20;  // a twentieth of them: all of one kind of place would be another
      faults[i] = std::uint8_t((!skin_.contains(places[i]) ? 1 : 0) | (in(bones_, places[i]) ? 2 : 0));
    });
    for (const std::uint8_t fault : faults) filling.outside += fault & 1, filling.inBone += fault >> 1;
    filling.places /= 20;
    const vec3 along = glm::normalize(knee_ - hip_);
    const float thigh = glm::distance(knee_, hip_);
    filling.thigh = share(places, hip_ + vec3(0, -0.5f, 0) * thigh, 0.14f, [&](vec3 p) {
      const float way = glm::dot(p - hip_, along);
      return way > 0.25f * thigh && way < 0.85f * thigh && p.x > 0.01f;
    });
    const vec3 crown = head_ + vec3(0, 0.12f, 0);
    filling.scalp =
        share(places, crown, 0.13f, [&](vec3 p) { return p.y > crown.y && skin_.look(p).depth < 0.006f; });
    filling.brain =
        share(places, crown, 0.13f, [&](vec3 p) { return p.y > crown.y && skin_.look(p).depth > 0.02f; });
    filling.lungs = shareOfOrgan(places, "lung");
    filling.liver = shareOfOrgan(places, "liver");
    filling.kidneys = shareOfOrgan(places, "kidney");
    filling.heart = shareOfOrgan(places, "heart");
    filling.windpipe = shareWithin(places, "windpipe");
    return filling;
  }

 private:
  static bool in(const std::vector<WindingNumber>& solids, vec3 p) {
    return std::ranges::any_of(solids,
                               [&](const WindingNumber& solid) { return std::abs(solid.at(p)) >= 0.5f; });
  }

  /// Of those organs whose names hold a word, the one that is filled least.
  float shareOfOrgan(const std::vector<vec3>& places, const char* word) const {
    float least = std::ranges::any_of(
        organNames_, [&](const std::string& name) { return name.find(word) != std::string::npos; });
    for (std::size_t i = 0; i < organs_.size(); ++i) {
      if (organNames_[i].find(word) == std::string::npos) continue;
      const vec3 half = 0.5f * organBounds_[i].extent();
      least = std::min(least,
                       share(places, organBounds_[i].low + half, std::max({half.x, half.y, half.z}) + 0.01f,
                             [&](vec3 p) { return std::abs(organs_[i].at(p)) >= 0.5f; }));
    }
    return least;
  }

  float shareWithin(const std::vector<vec3>& places, const char* word) const {
    std::size_t near = 0, within = 0;
    for (std::size_t i = 0; i < organs_.size(); ++i) {
      if (organNames_[i].find(word) == std::string::npos) continue;
      for (const vec3 p : places) {
        if (organBounds_[i].distance(p) > 0) continue;
        ++near;
        within += std::abs(organs_[i].at(p)) >= 0.5f;
      }
    }
    return near ? float(within) / float(near) : 0;
  }

  template <class Wanted>
  float share(const std::vector<vec3>& places, vec3 middle, float reach, const Wanted& wanted) const {
    constexpr float kCube = 0.01f;
    const int n = int(reach / kCube);
    const auto side = std::size_t(2 * n);
    std::vector<char> taken(side * side * side);
    const auto indexOf = [&](vec3 p) -> std::size_t {
      const ivec3 at = ivec3(glm::floor((p - middle) / kCube)) + n;
      for (int i = 0; i < 3; ++i)
        if (at[i] < 0 || at[i] >= 2 * n) return taken.size();
      return (std::size_t(at.z) * side + std::size_t(at.y)) * side + std::size_t(at.x);
    };
    for (const vec3 p : places)
      if (const std::size_t i = indexOf(p); i < taken.size()) taken[i] = 1;
    std::size_t all = 0, filled = 0;
    for (int z = -n; z < n; ++z)
      for (int y = -n; y < n; ++y)
        for (int x = -n; x < n; ++x) {
          const vec3 p = middle + kCube * (vec3(float(x), float(y), float(z)) + 0.5f);
          if (!wanted(p) || !skin_.contains(p) || in(bones_, p) || in(keptOut_, p)) continue;
          ++all;
          filled += taken[indexOf(p)];
        }
    return all ? float(filled) / float(all) : 0;
  }

  SkinShell skin_;
  std::vector<WindingNumber> bones_, keptOut_, organs_;
  std::vector<std::string> organNames_;
  std::vector<Aabb> organBounds_;
  vec3 hip_, knee_, head_;
};

}  // namespace vasa::test
