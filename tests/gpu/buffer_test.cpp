#include "gpu/buffer.h"

#include <doctest/doctest.h>

#include <numeric>

#include "gpu/error.h"
#include "gpu/gpu_rig.h"

using namespace vasa;

TEST_CASE("values survive the way to the device and back, through several stagings") {
  VASA_REQUIRE_GPU(rig);
  // 36 MB: more than one staging buffer, and no multiple of it.
  std::vector<std::uint32_t> values(9'000'001);
  std::iota(values.begin(), values.end(), 5u);
  const gpu::Buffer buffer = rig.upload(values);
  CHECK(buffer.bytes() == values.size() * 4);
  CHECK(rig.download<std::uint32_t>(buffer) == values);
}

TEST_CASE("addresses are multiples of 16, of an empty buffer too") {
  VASA_REQUIRE_GPU(rig);
  for (const VkDeviceSize bytes : {0, 1, 4, 17, 1000}) {
    const gpu::Buffer buffer(rig.device(), {"small", bytes});
    CHECK(buffer.bytes() == bytes);
    CHECK(buffer.address() != 0);
    CHECK(buffer.address() % 16 == 0);
  }
  CHECK(rig.download<float>(rig.upload(std::vector<float>{})).empty());
}

TEST_CASE("a part of an upload buffer can be written, and copied by the device") {
  VASA_REQUIRE_GPU(rig);
  gpu::Buffer upload(rig.device(), {"upload", 16, gpu::MemoryRole::upload});
  const std::vector<std::uint32_t> zeros(4, 0), two{7, 8};
  upload.write(std::span(zeros));
  upload.write(std::span(two), 4);
  upload.mapped<std::uint32_t>()[3] = 9;
  upload.flush();
  gpu::Buffer readBack(rig.device(), {"read back", 16, gpu::MemoryRole::readBack});
  rig.run([&](VkCommandBuffer commands) {
    const VkBufferCopy region{0, 0, 16};
    vkCmdCopyBuffer(commands, upload.handle(), readBack.handle(), 1, &region);
  });
  std::vector<std::uint32_t> values(4);
  readBack.read(std::span(values));
  CHECK(values == std::vector<std::uint32_t>{0, 7, 8, 9});
}

TEST_CASE("a buffer that shaders cannot reach as a whole is refused") {
  VASA_REQUIRE_GPU(rig);
  const VkDeviceSize most = rig.device().limits().maxStorageBufferRange;
  CHECK_THROWS_WITH_AS(gpu::Buffer(rig.device(), {"vertices", most + 1}),
                       doctest::Contains("bytes, more than the "), gpu::Error);
  CHECK_THROWS_WITH_AS(gpu::Buffer(rig.device(), {"picture", most + 1, gpu::MemoryRole::readBack}),
                       doctest::Contains("use a smaller picture or window"), gpu::Error);
}

TEST_CASE("a moved buffer leaves an empty one") {
  VASA_REQUIRE_GPU(rig);
  gpu::Buffer first(rig.device(), {"first", 4});
  gpu::Buffer second(std::move(first));
  CHECK(!first);
  CHECK(second);
  second = gpu::Buffer(rig.device(), {"third", 8});
  CHECK(second.bytes() == 8);
}
