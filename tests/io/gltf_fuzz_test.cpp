#include <doctest/doctest.h>

#include "core/log.h"
#include "io/gltf.h"
#include "io/gltf_builder.h"
#include "support/mutator.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

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
