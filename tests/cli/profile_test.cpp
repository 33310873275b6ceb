#include <doctest/doctest.h>

#include "cli/program.h"

using namespace vasa::test;

TEST_CASE("profile has a row a tessellation with every stage that exists") {
  const auto outcome =
      runProgram({"profile", "--size", "64x64", "--frames", "3", "--quads", "3x2,8x5", "--json"});
  REQUIRE(outcome.exit == 0);
  const auto report = outcome.json();
  REQUIRE(report["rows"].size() == 2);
  for (const auto& row : report["rows"]) {
    for (const char* key :
         {"quads", "sweeps", "triangles", "pose_ms", "deform_ms", "volume_ms", "upload_ms", "tessellate_ms",
          "draw_ms", "solve_ms", "picture_ms", "frame_ms", "latency_ms", "fps", "static_draw_ms"})
      CHECK_MESSAGE(row.contains(key), key);
    CHECK(row["frame_ms"].get<double>() > 0);
    CHECK(row["latency_ms"].get<double>() >= row["frame_ms"].get<double>() * 0.5);
  }
  CHECK(report["measured"].get<std::string>().find("frame_ms") != std::string::npos);
  CHECK(report["rows"][0]["quads"] == "3x2");
  CHECK(report["rows"][1]["triangles"].get<int>() > report["rows"][0]["triangles"].get<int>());
  for (const char* key :
       {"network_bytes", "binding_bytes", "sphere_tree_bytes", "box_tree_bytes", "mesh_bytes"})
    CHECK(report["storage"].contains(key));
}
