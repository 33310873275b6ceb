#include "gpu/error.h"

#include <doctest/doctest.h>

using namespace vasa;

TEST_CASE("check passes successes on") {
  CHECK(gpu::check(VK_SUCCESS, "vkDoThings") == VK_SUCCESS);
  CHECK(gpu::check(VK_INCOMPLETE, "vkDoThings") == VK_INCOMPLETE);
}

TEST_CASE("a failed call names itself, its result and a remedy") {
  CHECK_THROWS_WITH_AS(
      gpu::check(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkAllocateMemory"),
      "vkAllocateMemory: VK_ERROR_OUT_OF_DEVICE_MEMORY; use a smaller picture or fewer quads, or "
      "another --device",
      gpu::Error);
  CHECK_THROWS_WITH_AS(gpu::check(VK_ERROR_OUT_OF_HOST_MEMORY, "vkCreateBuffer"),
                       "vkCreateBuffer: VK_ERROR_OUT_OF_HOST_MEMORY; free some memory", gpu::Error);
  CHECK_THROWS_WITH_AS(gpu::check(VkResult(-77), "vkDoThings"), "vkDoThings: VkResult -77", gpu::Error);
}

TEST_CASE("a lost device has a fault of its own, everything else has failed") {
  const auto faultOf = [](VkResult result) {
    const auto attempted = gpu::attempt([&] { gpu::check(result, "vkQueueSubmit2"); });
    REQUIRE(!attempted.ok());
    return attempted.error().fault;
  };
  CHECK(faultOf(VK_ERROR_DEVICE_LOST) == Fault::deviceLost);
  CHECK(faultOf(VK_ERROR_OUT_OF_HOST_MEMORY) == Fault::failed);
}

TEST_CASE("attempt returns the value or the error") {
  const auto seven = gpu::attempt([] { return 7; });
  REQUIRE(seven.ok());
  CHECK(*seven == 7);
  const auto refused = gpu::attempt([]() -> int { throw gpu::Error({Fault::noDevice, "nothing here"}); });
  REQUIRE(!refused.ok());
  CHECK(refused.error().fault == Fault::noDevice);
  CHECK(refused.error().message == "nothing here");
}
