#include "gpu/timer.h"

#include <doctest/doctest.h>

#include <string>

#include "gpu/gpu_rig.h"

using namespace vasa;

TEST_CASE("a timer tells each stretch's time in the order they began") {
  VASA_REQUIRE_GPU(rig);
  gpu::GpuTimer timer(rig.device(), 3);
  const gpu::Buffer small(rig.device(), {"small", 64}), large(rig.device(), {"large", 32 << 20});
  for (int frame = 0; frame < 2; ++frame) {
    rig.run([&](VkCommandBuffer commands) {
      timer.begin(commands);
      const auto all = timer.scope(commands, "all");
      {
        const auto scope = timer.scope(commands, "small");
        vkCmdFillBuffer(commands, small.handle(), 0, VK_WHOLE_SIZE, 1);
      }
      {
        const auto scope = timer.scope(commands, "large");
        vkCmdFillBuffer(commands, large.handle(), 0, VK_WHOLE_SIZE, 1);
      }
      const auto untimed = timer.scope(commands, "over the limit");
    });
    const auto times = timer.results();
    if (rig.device().timestampBits() == 0) {
      CHECK(times.empty());
      continue;
    }
    REQUIRE(times.size() == 3);
    CHECK(std::string(times[0].name) == "all");
    CHECK(std::string(times[1].name) == "small");
    CHECK(std::string(times[2].name) == "large");
    for (const auto& time : times) CHECK(time.ms >= 0.0);
    CHECK(times[2].ms > 0.0);
    CHECK(times[0].ms >= times[1].ms + times[2].ms);
  }
}

TEST_CASE("a timer that measured nothing has no results") {
  VASA_REQUIRE_GPU(rig);
  gpu::GpuTimer timer(rig.device());
  CHECK(timer.results().empty());
  rig.run([&](VkCommandBuffer commands) { timer.begin(commands); });
  CHECK(timer.results().empty());
}
