#pragma once
#include "render/fork_set.h"
#include "render/tube_pass.h"

namespace vasa {

/// Turns forks into triangles between the tubes' rings, and leaves out those that cannot be seen.
/// CPU references: surface/fork.h, surface/fork_template.h, surface/visible.h.
class ForkPass {
 public:
  ForkPass() = default;
  /// @param forks    read, not kept: of a network that it will write
  ForkPass(gpu::Device& device, const ForkSet& forks);

  struct Input {
    const TubeSet& tubes;  ///< of the same network
    const ForkSet& forks;
    const DetailPass& detail;
    VkDeviceAddress points, knots;  ///< de Boor points (vec4) and knot quaternions (x y z w) of the frame
    const Filling& filling;
    const Template& into;
    bool cull = true;  ///< false: every triangle is drawn
  };
  /// A round's forks, as far as the tubes before them have left room. No barriers.
  void record(VkCommandBuffer commands, const Input& input) const;

 private:
  gpu::ComputePipeline pipeline_;
};

}  // namespace vasa
