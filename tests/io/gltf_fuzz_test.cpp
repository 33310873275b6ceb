#include <doctest/doctest.h>

#include <random>

#include "core/log.h"
#include "io/gltf.h"
#include "io/gltf_builder.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

class Mutator {
 public:
  explicit Mutator(std::uint32_t seed) : random_(seed) {}

  /// One to four changes: a bit, a byte, a digit, a word of extreme value, a cut, or a copied stretch.
  std::string mutated(std::string bytes) {
    for (std::size_t changes = 1 + pick(4); changes > 0; --changes) mutate(bytes);
    return bytes;
  }

 private:
  std::size_t pick(std::size_t below) { return below ? random_() % below : 0; }

  void mutate(std::string& bytes) {
    if (bytes.size() < 32) return;
    const std::size_t at = pick(bytes.size() - 4);
    constexpr std::uint32_t extremes[] = {0,          1,          0x7f800000, 0x7fc00000,
                                          0x7fffffff, 0x80000000, 0xffffffff, 0xfffffffc};
    switch (pick(8)) {
      case 0:
        bytes[at] = char(bytes[at] ^ (1 << pick(8)));
        break;
      case 1:
        bytes[at] = char(random_());
        break;
      case 2:
      case 3:
      case 4:
        changeDigit(bytes, at);
        break;
      case 5:
        std::memcpy(bytes.data() + at, &extremes[pick(8)], 4);
        break;
      case 6:
        bytes.resize(at);
        break;
      default:
        bytes.replace(at, std::min<std::size_t>(8, bytes.size() - at), bytes, pick(bytes.size() - 8), 8);
    }
  }

  // Changes a number of the JSON, which bare byte flips rarely leave valid.
  void changeDigit(std::string& bytes, std::size_t from) {
    const std::size_t digit = bytes.find_first_of("0123456789", from);
    if (digit == std::string::npos) return;
    constexpr const char* values[] = {"0", "1", "2", "3", "7", "9", "-", "."};
    bytes.replace(digit, 1, values[pick(8)]);
  }

  std::mt19937 random_;
};

}  // namespace

TEST_CASE("damaged files never crash the readers, and what is accepted is whole") {
  const LogLevel before = logLevel();
  setLogLevel(LogLevel::quiet);
  const TemporaryFolder folder;
  GltfBuilder withUri = bodyFile();
  withUri.document["buffers"][0]["uri"] = withUri.dataUri();
  const std::string seeds[] = {bodyFile().glb(), triangleFile().glb(), withUri.text()};
  Mutator mutator(20240611);
  std::size_t accepted = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::string bytes = mutator.mutated(seeds[i % 3]);
    const auto path = writeBytes(folder.path() / (i % 3 == 2 ? "a.gltf" : "a.glb"), bytes);
    const auto body = readBody(path);
    const auto elements = readGltfElements(path);
    if (!elements) CHECK(!elements.error().message.empty());
    if (!body) continue;
    ++accepted;
    for (const auto& clip : body->clips) (void)samplePose(body->skeleton, clip, clip.end);
    for (const auto& mesh : body->meshes) {
      REQUIRE(mesh.influences.size() == mesh.mesh.positions.size());
      REQUIRE(mesh.normals.size() == mesh.mesh.positions.size());
      for (const uvec3& triangle : mesh.mesh.triangles)
        REQUIRE(std::max({triangle.x, triangle.y, triangle.z}) < mesh.mesh.positions.size());
      for (const auto& influence : mesh.influences)
        for (const auto joint : influence.joints) REQUIRE(joint < body->skeleton.joints.size());
    }
  }
  setLogLevel(before);
  CHECK(accepted > 50);  // else the changes are too coarse to get past the first checks
  CHECK(accepted < 2000);
}
