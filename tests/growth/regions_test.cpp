#include "growth/regions.h"

#include <doctest/doctest.h>

#include "support/growth.h"

using namespace vasa;

namespace {

const std::string kColumns = "region,system,joints,vessels,kinds,thinnest_mm,thickest_mm,bed_mm,surface\n";

GrowthRules rules() {
  auto read = parseGrowthRules(test::growthText(), "g");
  REQUIRE(read.ok());
  return std::move(*read);
}

std::string refusalOf(const std::string& text) {
  const auto regions = parseRegions(text, "r.csv", rules());
  REQUIRE_FALSE(regions.ok());
  CHECK(regions.error().fault == Fault::badInput);
  return regions.error().message;
}

}  // namespace

TEST_CASE("the first row that fits decides") {
  const auto regions = parseRegions("# where what grows\n" + kColumns +
                                        "none,-,,coronary|FMA12,,,,,\n"
                                        "hand,reed,Hand|Thumb,,,0.1,2,3,skin\n"
                                        "head,oak,head,,artery | vein,0.1,2,3,bone\n"
                                        "rest,oak,,,,0,3,8,\n",
                                    "r.csv", rules());
  REQUIRE_MESSAGE(regions.ok(), (regions.ok() ? "" : regions.error().message));
  const auto nameOf = [&](const RegionQuestion& question) { return regionOf(*regions, question)->name; };
  CHECK(nameOf({"Left Coronary artery", "", "Spine", VesselKind::artery}) == "none");
  CHECK(nameOf({"aorta", "fma12", "Spine", VesselKind::artery}) == "none");
  CHECK(nameOf({"aorta", "FMA123", "Spine", VesselKind::artery}) == "rest");
  CHECK(nameOf({"digital artery", "", "LeftHandFinger1", VesselKind::artery}) == "hand");
  CHECK(nameOf({"facial vein", "", "Head", VesselKind::vein}) == "head");
  CHECK(nameOf({"facial duct", "", "Head", VesselKind::lymphatic}) == "rest");
  CHECK((*regions)[0].system == GrowthRegion::kNoSystem);
  CHECK((*regions)[1].system == 1);
  CHECK((*regions)[2].inBone);
  CHECK(!(*regions)[1].inBone);
  CHECK(!(*regions)[3].inBone);
  CHECK((*regions)[3].bed == doctest::Approx(0.008f));
  CHECK(regionOf({}, {}) == nullptr);
}

TEST_CASE("organs are filled by the row that names them, which no vessel chooses") {
  const auto regions = parseRegions(kColumns.substr(0, kColumns.size() - 1) +
                                        ",organs,wall_mm\n"
                                        "glands,oak,,,,,,9,,Liver|kidney,\n"
                                        "stomach,reed,,,,,,9,,stomach,5\n"
                                        "airways,-,,,,,,,,windpipe,\n"
                                        "rest,oak,,,,0,3,8,,,\n",
                                    "r.csv", rules());
  REQUIRE_MESSAGE(regions.ok(), (regions.ok() ? "" : regions.error().message));
  CHECK(regionOf(*regions, {"renal artery", "", "Spine", VesselKind::artery})->name == "rest");
  CHECK(regionOfOrgan(*regions, "organ: left KIDNEY")->name == "glands");
  CHECK(regionOfOrgan(*regions, "organ: stomach")->wall == doctest::Approx(0.005f));
  CHECK(regionOfOrgan(*regions, "organ: windpipe")->system == GrowthRegion::kNoSystem);
  CHECK(regionOfOrgan(*regions, "bones") == nullptr);
}

TEST_CASE("an organ's row names the vessels that feed it, by parts of names or by whole ids") {
  const auto regions = parseRegions(kColumns.substr(0, kColumns.size() - 1) +
                                        ",organs,wall_mm\n"
                                        "liver,oak,,Hepatic|FMA12,,,,9,,liver,\n"
                                        "spleen,oak,,,,,,9,,spleen,\n"
                                        "rest,oak,,,,0,3,8,,,\n",
                                    "r.csv", rules());
  REQUIRE_MESSAGE(regions.ok(), (regions.ok() ? "" : regions.error().message));
  const GrowthRegion &liver = *regionOfOrgan(*regions, "liver"), &spleen = *regionOfOrgan(*regions, "spleen");
  CHECK(namesVessel(liver, "left hepatic artery", ""));
  CHECK(namesVessel(liver, "some vein", "fma12"));
  CHECK(!namesVessel(liver, "some vein", "FMA123"));
  CHECK(!namesVessel(liver, "inferior phrenic artery", ""));
  CHECK(namesVessel(spleen, "inferior phrenic artery", ""));  // it names none
  CHECK(regionOf(*regions, {"left hepatic artery", "", "Spine", VesselKind::artery})->name == "rest");
}

TEST_CASE("what the program ships can be read") {
  const std::filesystem::path folder = VASA_GROWTH_DIR;
  const auto shipped = readGrowthRules(folder / "capillaries.lsys");
  REQUIRE(shipped.ok());
  const auto regions = readRegions(folder / "regions.csv", *shipped);
  REQUIRE_MESSAGE(regions.ok(), (regions.ok() ? "" : regions.error().message));
  const auto systemOf = [&](const RegionQuestion& question) {
    const GrowthRegion* region = regionOf(*regions, question);
    REQUIRE(region);
    return region->system == GrowthRegion::kNoSystem ? std::string("-") : shipped->systems[region->system];
  };
  CHECK(systemOf({"left middle cerebral artery", "", "Head", VesselKind::artery}) == "brain");
  CHECK(systemOf({"left facial artery", "", "Neck1", VesselKind::artery}) == "face");
  CHECK(systemOf({"plantar arch left", "", "LeftFoot", VesselKind::artery}) == "foot");
  CHECK(systemOf({"ulnar palmar digital artery of ring finger left", "", "LeftHandFinger3",
                  VesselKind::artery}) == "hand");
  CHECK(systemOf({"popliteal vein", "", "LeftLeg", VesselKind::vein}) == "muscle");
  CHECK(systemOf({"lumbar vein", "", "LowerBack", VesselKind::vein}) == "muscle");
}

TEST_CASE("faults are told with file, line, cause and remedy") {
  CHECK(refusalOf("").starts_with("r.csv: has no regions"));
  CHECK(refusalOf("region,system\n") == "r.csv:1: the first line must name the columns: " +
                                            kColumns.substr(0, kColumns.size() - 1) + ",organs,wall_mm");
  CHECK(refusalOf(kColumns.substr(0, kColumns.size() - 1) + ",organs,wall_mm\na,oak,Head,,,,,8,,liver,\n") ==
        "r.csv:2: names organs and joints; an organ is filled whatever vessels are near, leave that empty");
  CHECK(refusalOf(kColumns + "a,oak\n").starts_with("r.csv:2: has 2 cells but must have 9"));
  CHECK(refusalOf(kColumns + "a,elm,,,,0,3,8,\n") ==
        "r.csv:2: there is no system 'elm'; use one of -, oak, reed");
  CHECK(refusalOf(kColumns + "a,oak,,,tube,0,3,8,\n").find("no kind of vessel") != std::string::npos);
  CHECK(refusalOf(kColumns + "a,oak,,,,0,three,8,\n") ==
        "r.csv:2: thickest_mm is 'three' but must be a number from 0 to 100");
  CHECK(refusalOf(kColumns + "a,oak,,,,0,nan,8,\n").find("must be a number") != std::string::npos);
  CHECK(refusalOf(kColumns + "a,oak,,,,0,3,0,\n") ==
        "r.csv:2: bed_mm is '0' but must be a number from 2 to 1000");
  CHECK(refusalOf(kColumns + "a,oak,,,,4,3,8,\n").find("exchange them") != std::string::npos);
  CHECK(refusalOf(kColumns + "a,oak,,,,0,3,8,Head\n") ==
        "r.csv:2: surface is 'Head' but must be skin, bone or empty");
}
