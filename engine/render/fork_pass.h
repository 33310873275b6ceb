#pragma once
#include <future>

#include "gpu/adapter.h"
#include "render/fork_set.h"
#include "render/tube_pass.h"

namespace vasa {

/// Turns forks into triangles between the tubes' rings, and leaves out those that cannot be seen.
/// CPU references: surface/fork.h, surface/fork_template.h, surface/visible.h.
class ForkPass {
 public:
  ForkPass() = default;
  /// @param groupForks  ForkSet::groupForks() of a network that it will write
  ForkPass(gpu::Device& device, std::uint32_t groupForks);

  /// Has the driver compile the pass and keep it for every device of the machine. lavapipe compiles a shader
  /// when it first runs, this one for seconds, in its queue's only thread, where all pictures would wait: so
  /// it runs once, with nothing to do, on a device of its own. Others compile when the pass is made; nothing
  /// is done for them.
  /// @return ready once that is done, also where it failed: what fails here fails again, and is told, where
  ///   the pass is used. No one has to wait for it (core/unawaited.h)
  static std::future<void> compile(const gpu::Adapter& adapter, std::uint32_t groupForks);

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
