#include "gpu/pushed_addresses.h"

#include <doctest/doctest.h>

#include "gpu/address_map.h"
#include "spirv/access_read_comp.h"
#include "spirv/scale_comp.h"
#include "spirv/triangle_vert.h"

using namespace vasa;

TEST_CASE("addresses among push constants are found, with what is done through them") {
  using Found = std::vector<gpu::PushedAddress>;
  CHECK(gpu::pushedAddresses(spirv::scale_comp) == Found{{0, true}});
  CHECK(gpu::pushedAddresses(spirv::triangle_vert) == Found{{0, false}});  // declared readonly
}

TEST_CASE("code without push constants, and no code at all, have no addresses") {
  CHECK(gpu::pushedAddresses(spirv::access_read_comp).empty());
  CHECK(gpu::pushedAddresses({}).empty());
  // Cut off in the middle of an instruction.
  CHECK_NOTHROW(gpu::pushedAddresses({"cut", std::span(spirv::scale_comp_words).first(40)}));
}

TEST_CASE("an address is found in its buffer, and nowhere once the buffer is gone") {
  gpu::AddressMap map;
  const VkBuffer buffer = reinterpret_cast<VkBuffer>(std::uintptr_t(7));
  auto entry = map.add(1000, 64, buffer);
  CHECK(!map.find(999));
  CHECK(map.find(1000)->offset == 0);
  CHECK(map.find(1063)->offset == 63);
  CHECK(map.find(1063)->buffer == buffer);
  CHECK(!map.find(1064));
  CHECK(!map.wroteBefore(1016, true));
  CHECK(map.wroteBefore(1016, false));
  CHECK(!map.wroteBefore(1016, true));
  entry.reset();
  CHECK(!map.find(1000));
  CHECK(!map.wroteBefore(1016, false));
}
