#include <doctest/doctest.h>

#include <algorithm>

#include "convert/convert.h"
#include "io/gltf.h"
#include "io/obj.h"
#include "support/shared_data.h"

using namespace vasa;

// Real vessels: what the conversion promises of them.

TEST_CASE("the arteries of a whole body") {
  VASA_REQUIRE_SHARED_DATA(data);
  auto read = readGltfElements(data / "bp3d/bp3d_arteries.glb");
  REQUIRE(read.ok());
  const auto sources = describeElements(std::move(*read), "bp3d_arteries");
  const auto conversion = convertElements(sources);
  REQUIRE(conversion.ok());
  const ConvertSummary& s = conversion->report.summary;
  CHECK(s.elements == 636);
  CHECK(s.ok >= 0.95 * s.elements);
  CHECK(s.failed == 0);
  CHECK(s.coverage >= 0.97);
  CHECK(s.error.p95 <= 0.001f);
  CHECK(s.backError.p95 <= 0.0015f);
  CHECK(s.largestArterialTree >= 0.8 * s.arteryLength);
  std::vector<std::string> bridged;
  for (const Gap& gap : s.joins.gaps)
    if (gap.length > 0.05f) bridged.push_back(sources[gap.fromElement].label);
  std::ranges::sort(bridged);
  CHECK(bridged == std::vector<std::string>{"left internal carotid artery", "right internal carotid artery"});
}

TEST_CASE("vessels as published, one by one") {
  VASA_REQUIRE_SHARED_DATA(data);
  int ok = 0, all = 0;
  for (const auto& file : std::filesystem::directory_iterator(data / "bp3d/raw_obj")) {
    auto read = readObj(file.path(), {0.213f, ImportFrame::Up::z});
    REQUIRE(read.ok());
    const auto conversion = convertElements(describeElements(std::move(*read), "vessel"));
    REQUIRE(conversion.ok());
    ++all;
    ok += conversion->report.summary.ok == 1;
    CHECK(conversion->report.summary.failed == 0);
  }
  CHECK(all == 31);
  CHECK(ok >= 29);
}
