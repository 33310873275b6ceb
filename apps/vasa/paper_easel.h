#pragma once
#include "paper_study.h"
#include "render/renderer.h"

namespace vasa::cli {

/// Draws one network in one shape, and meshes that stay where they are, for the page's figures.
class Easel {
 public:
  struct Subject {
    const Network& network;
    const SweepTable* table = nullptr;         ///< of the network, where there is one already
    std::span<const vec4> points = {};         ///< empty: at rest
    std::span<const SkinnedMesh> meshes = {};  ///< all of joint 0
    const Growth* growth = nullptr;
    std::uint32_t capillaryLevels = 0;
  };
  /// @param size  [pixels] at a height of 720 (PaperStudy::pixels)
  Easel(const PaperStudy& study, gpu::Device& device, const Subject& subject, PictureSize size);

  /// Vessels whose spans are marked; all where the list is empty.
  void showOnly(std::span<const char> spans);
  Image draw(const Camera& camera, const Look& look);
  /// Drawn in the latest picture.
  std::uint64_t capillaries() const { return renderer_.capillaryCounts().curves; }
  float aspect() const { return float(size_.width) / float(size_.height); }

 private:
  const Network& network_;
  PictureSize size_;
  std::vector<vec4> points_;
  std::vector<quat> frames_;
  std::vector<std::uint32_t> colours_;
  Renderer renderer_;
};

/// The page's: atlas, on the page's white.
Look pageLook();

/// Looks at a box along a direction (from it to the camera), as near as it fits.
Camera cameraOn(const Aabb& box, vec3 direction, float aspect);

/// Box of the tubes whose spans are marked, counted through all vessels.
Aabb boundsOf(const Network& network, std::span<const char> spans);

/// A mesh for Easel::Subject, of flat triangles or smooth. @param colour  sRGB
SkinnedMesh stillMesh(std::string name, TriangleMesh mesh, vec3 colour, bool smooth);

}  // namespace vasa::cli
