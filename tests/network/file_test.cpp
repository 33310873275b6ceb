#include "network/file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "core/atomic_file.h"
#include "core/hash.h"
#include "network/sample_network.h"
#include "support/shared_data.h"

using namespace vasa;

namespace {

Network sample() {
  auto network = test::sampleBuilder().build(1.75f);
  REQUIRE(network.ok());
  return std::move(network).value();
}

std::string refusalOf(std::span<const std::byte> bytes) {
  const auto network = decodeNetwork(bytes, "x.vasa");
  REQUIRE(!network.ok());
  CHECK(network.error().fault == Fault::badInput);
  return network.error().message;
}

// Makes a changed body pass the checksum, to reach the checks behind it.
void sign(std::vector<std::byte>& bytes) {
  const std::uint64_t length = bytes.size() - 24;
  const std::uint64_t sum = hashBytes(std::span(bytes).subspan(24));
  std::memcpy(&bytes[8], &length, 8);
  std::memcpy(&bytes[16], &sum, 8);
}

}  // namespace

TEST_CASE("an exact file gives back the same network, to the bit") {
  const Network network = sample();
  test::TemporaryFolder folder;
  const auto path = folder.path() / "tree.vasa";
  const auto written = writeNetwork(path, network);
  REQUIRE(written.ok());
  CHECK(*written == std::filesystem::file_size(path));
  const auto read = readNetwork(path);
  REQUIRE(read.ok());
  CHECK(std::ranges::equal(read->points(), network.points()));
  CHECK(read->bodyHeight() == network.bodyHeight());
  REQUIRE(read->vessels().size() == network.vessels().size());
  for (std::size_t i = 0; i < network.vessels().size(); ++i) {
    CHECK(read->vessels()[i].name == network.vessels()[i].name);
    CHECK(read->vessels()[i].ontologyId == network.vessels()[i].ontologyId);
    CHECK(read->vessels()[i].kind == network.vessels()[i].kind);
    CHECK(read->vessels()[i].start == network.vessels()[i].start);
  }
  CHECK(encodeNetwork(*read) == encodeNetwork(network));
}

TEST_CASE("a quantised file is half the size, near, and stable when written again") {
  const Network network = sample();
  const auto bytes = encodeNetwork(network, {.quantise = true});
  CHECK(bytes.size() < encodeNetwork(network).size());
  const auto read = decodeNetwork(bytes, "x.vasa");
  REQUIRE(read.ok());
  const float error = quantisationError(network);
  CHECK(error <= 1.6e-5f);
  for (std::size_t i = 0; i < network.points().size(); ++i) {
    const vec4 difference = glm::abs(read->points()[i] - network.points()[i]);
    // Pinned ends follow their host.
    for (int axis = 0; axis < 3; ++axis) CHECK(difference[axis] <= 2 * error);
    CHECK(difference.w <= 0.01f / 131070 + 1e-9f);
  }
  CHECK(encodeNetwork(*read, {.quantise = true}) == bytes);
}

TEST_CASE("an empty network survives") {
  const auto network = NetworkBuilder().build(1);
  REQUIRE(network.ok());
  for (const bool quantise : {false, true})
    CHECK(decodeNetwork(encodeNetwork(*network, {quantise}), "x").ok());
}

TEST_CASE("damage is told from foreign files and other versions") {
  auto bytes = encodeNetwork(sample());
  SUBCASE("foreign") {
    CHECK(refusalOf(std::as_bytes(std::span("hello there"))).find("not a .vasa file") != std::string::npos);
  }
  SUBCASE("nothing") { CHECK(refusalOf({}).find("not a .vasa file") != std::string::npos); }
  SUBCASE("version") {
    bytes[4] = std::byte(9);
    CHECK(refusalOf(bytes).find("version 9") != std::string::npos);
  }
  SUBCASE("cut short") {
    bytes.resize(bytes.size() - 5);
    CHECK(refusalOf(bytes).find("not as many as its header says") != std::string::npos);
  }
  SUBCASE("a flipped bit") {
    bytes[100] ^= std::byte(4);
    CHECK(refusalOf(bytes).find("checksum") != std::string::npos);
  }
  SUBCASE("a chunk that runs over the end") {
    bytes[28] = std::byte(0xff);
    bytes[29] = std::byte(0xff);
    sign(bytes);
    CHECK(refusalOf(bytes).find("chunk 'META' at byte 24 is malformed") != std::string::npos);
  }
}

TEST_CASE("no signed garbage makes the reader crash") {
  std::mt19937 random(1);
  const auto good = encodeNetwork(sample(), {.quantise = true});
  int accepted = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    auto bytes = good;
    for (int flips = 1 + int(random() % 3); flips; --flips)
      bytes[24 + random() % (bytes.size() - 24)] = std::byte(random());
    sign(bytes);
    accepted += decodeNetwork(bytes, "x.vasa").ok();
  }
  CHECK(accepted > 0);
  CHECK(accepted < 20000);
}

TEST_CASE("an unwritable place is told") {
  const auto written = writeNetwork("/dev/full", sample());
  REQUIRE(!written.ok());
  CHECK(written.error().fault == Fault::io);
}
