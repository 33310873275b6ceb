#pragma once
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <memory>

#include "collide/exclusions.h"
#include "curve/frame.h"

namespace vasa::bench {

/// FCL on what the tubes look like: a mesh of 8 quads around and 5 along a tube, one bounding volume
/// hierarchy each, refitted every shape, below a dynamic AABB tree. Open tubes of flat quads: it finds
/// crossing surfaces, so its pairs differ a little from the exact ones.
template <class Volume>
class FclDetector {
 public:
  FclDetector(std::span<const Bezier> rest, const Exclusions& exclusions)
      : exclusions_(exclusions), indices_(rest.size()) {
    std::vector<fcl::Vector3f> vertices;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      meshOf(rest[i], vertices);
      auto model = std::make_shared<fcl::BVHModel<Volume>>();
      model->beginModel();
      model->addSubModel(vertices, triangles());
      model->endModel();
      indices_[i] = std::uint32_t(i);
      models_.push_back(model);
      objects_.push_back(std::make_unique<fcl::CollisionObjectf>(model));
      objects_.back()->setUserData(&indices_[i]);
      manager_.registerObject(objects_.back().get());
    }
    manager_.setup();
  }

  std::span<const TubePair> detect(std::span<const Bezier> tubes) {
    std::vector<fcl::Vector3f> vertices;
    for (std::size_t i = 0; i < tubes.size(); ++i) {
      meshOf(tubes[i], vertices);
      models_[i]->beginUpdateModel();
      models_[i]->updateSubModel(vertices);
      models_[i]->endUpdateModel(true, true);
      models_[i]->computeLocalAABB();
      objects_[i]->computeAABB();
    }
    manager_.update();
    pairs_.clear();
    manager_.collide(this, meet);
    std::sort(pairs_.begin(), pairs_.end());
    return pairs_;
  }

 private:
  static constexpr int kAround = 8, kAlong = 5;

  static const std::vector<fcl::Triangle>& triangles() {
    static const auto list = [] {
      std::vector<fcl::Triangle> made;
      for (std::size_t ring = 0; ring < kAlong; ++ring)
        for (std::size_t k = 0; k < kAround; ++k) {
          const std::size_t a = ring * kAround + k, b = ring * kAround + (k + 1) % kAround;
          made.emplace_back(a, b, b + kAround);
          made.emplace_back(a, b + kAround, a + kAround);
        }
      return made;
    }();
    return list;
  }

  static void meshOf(const Bezier& tube, std::vector<fcl::Vector3f>& vertices) {
    vertices.clear();
    for (int ring = 0; ring <= kAlong; ++ring) {
      const float t = float(ring) / kAlong;
      const vec4 centre = tube.at(t);
      const vec3 tangent = glm::normalize(vec3(tube.derivative(t)));
      const vec3 u = anyPerpendicular(tangent), v = glm::cross(tangent, u);
      for (int k = 0; k < kAround; ++k) {
        const float angle = 2 * kPi * float(k) / kAround;
        const vec3 p = vec3(centre) + centre.w * (std::cos(angle) * u + std::sin(angle) * v);
        vertices.emplace_back(p.x, p.y, p.z);
      }
    }
  }

  static bool meet(fcl::CollisionObjectf* a, fcl::CollisionObjectf* b, void* user) {
    auto& self = *static_cast<FclDetector*>(user);
    const std::uint32_t i = *static_cast<std::uint32_t*>(a->getUserData());
    const std::uint32_t j = *static_cast<std::uint32_t*>(b->getUserData());
    if (self.exclusions_.contains(i, j)) return false;
    fcl::CollisionRequestf request;
    fcl::CollisionResultf result;
    if (fcl::collide(a, b, request, result) > 0) self.pairs_.push_back(orderedPair(i, j));
    return false;
  }

  const Exclusions& exclusions_;
  std::vector<std::uint32_t> indices_;
  std::vector<std::shared_ptr<fcl::BVHModel<Volume>>> models_;
  std::vector<std::unique_ptr<fcl::CollisionObjectf>> objects_;
  fcl::DynamicAABBTreeCollisionManagerf manager_;
  std::vector<TubePair> pairs_;
};

}  // namespace vasa::bench
