#include "gpu/queue.h"

#include <doctest/doctest.h>

#include "gpu/gpu_rig.h"

using namespace vasa;

TEST_CASE("tickets follow each other and are done in order") {
  VASA_REQUIRE_GPU(rig);
  gpu::Queue& queue = rig.device().queue();
  CHECK(queue.done(gpu::Ticket{}));
  const gpu::Ticket first = queue.submit(queue.begin("first"));
  const gpu::Ticket second = queue.submit(queue.begin("second"));
  CHECK(first < second);
  CHECK(queue.last() == second);
  queue.wait(second);
  CHECK(queue.done(first));
  CHECK(queue.done(second));
  queue.wait(first);
}

TEST_CASE("what one submit writes, the next one sees without a barrier of its own") {
  VASA_REQUIRE_GPU(rig);
  gpu::Queue& queue = rig.device().queue();
  const gpu::Buffer a(rig.device(), {"a", 64}), b(rig.device(), {"b", 64});
  gpu::Commands fill = queue.begin("fill");
  vkCmdFillBuffer(fill, a.handle(), 0, 64, 42);
  queue.submit(std::move(fill));
  gpu::Commands copy = queue.begin("copy");
  const VkBufferCopy region{0, 0, 64};
  vkCmdCopyBuffer(copy, a.handle(), b.handle(), 1, &region);
  queue.submit(std::move(copy));
  CHECK(rig.download<std::uint32_t>(b) == std::vector<std::uint32_t>(16, 42));
}

TEST_CASE("abandoned commands never run, and their buffer is used again") {
  VASA_REQUIRE_GPU(rig);
  gpu::Queue& queue = rig.device().queue();
  const gpu::Buffer buffer = rig.upload(std::vector<std::uint32_t>{1, 2, 3, 4});
  VkCommandBuffer abandoned;
  {
    gpu::Commands commands = queue.begin("abandoned");
    abandoned = commands;
    vkCmdFillBuffer(commands, buffer.handle(), 0, 16, 0);
  }
  gpu::Commands again = queue.begin("again");
  CHECK(static_cast<VkCommandBuffer>(again) == abandoned);
  gpu::Commands other = queue.begin("other");
  CHECK(static_cast<VkCommandBuffer>(other) != abandoned);
  queue.wait(queue.submit(std::move(again)));
  CHECK(rig.download<std::uint32_t>(buffer) == std::vector<std::uint32_t>{1, 2, 3, 4});
}

TEST_CASE("memory that the device still uses is not freed before it has finished") {
  VASA_REQUIRE_GPU(rig);
  constexpr VkDeviceSize bytes = VkDeviceSize(64) << 20;  // some milliseconds
  const auto submitFilling = [&](const gpu::Buffer& buffer) {
    gpu::Commands fill = rig.device().queue().begin("fill");
    vkCmdFillBuffer(fill, buffer.handle(), 0, bytes, 42);
    return rig.device().queue().submit(std::move(fill));
  };
  gpu::Ticket ticket;
  {
    const gpu::Buffer buffer(rig.device(), {"filled", bytes});
    ticket = submitFilling(buffer);
  }
  CHECK(rig.device().queue().done(ticket));
  gpu::Buffer replaced(rig.device(), {"filled", bytes});
  ticket = submitFilling(replaced);
  replaced = gpu::Buffer(rig.device(), {"another", 16});
  CHECK(rig.device().queue().done(ticket));
}
