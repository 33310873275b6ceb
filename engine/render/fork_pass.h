#pragma once
#include <future>

#include "gpu/adapter.h"
#include "render/fork_set.h"
#include "render/tube_pass.h"

namespace vasa {

/// Turns forks into triangles between the tubes' rings, and leaves out those that cannot be seen.
/// CPU references: surface/fork.h, surface/fork_template.h, tests/reference/visible.h.
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

  /// A round's forks, as far as the tubes before them have left room. No barriers.
  /// @param input  the tubes'
  /// @param forks  of the same network
  void record(VkCommandBuffer commands, const TubePass::Input& input, const ForkSet& forks) const;

 private:
  gpu::ComputePipeline pipeline_;
};

}  // namespace vasa
