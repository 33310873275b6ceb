#include "make_human/bone_form.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "human/made_human.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::human;

namespace {

/// A bone of one tube upwards with this cell for `up`.
Result<std::vector<BoneForm>> tubeWith(const std::string& up) {
  const test::TemporaryFolder own;
  const std::filesystem::path& folder = own.path();
  std::ofstream(folder / "bones.csv") << "bone,tissue,side,joint,form,origin,towards,front,size\n"
                                      << "plate,bone,mid,Hips,plate,,,,\n";
  std::ofstream(folder / "forms.csv")
      << "form,side,operation,shape,blend_mm,cell_mm,points,radii_mm,up,cap_mm,square\n"
      << "plate,mid,add,tube,0,3,0 0 0 ; 0 50 0 ; 0 100 0,20*4," << up << ",,\n";
  const Result<Rig> rig = Rig::read(kTables / "joints.csv");
  REQUIRE(rig.ok());
  return readBoneForms(folder / "bones.csv", folder / "forms.csv", *rig);
}

}  // namespace

TEST_CASE("a tube whose cap is flatter than its section ends in a plane with a rounded rim") {
  BonePiece piece;
  piece.stations = {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 0.01f, 0.01f},
                    {{0, 0.05f, 0}, {1, 0, 0}, {0, 0, 1}, 0.01f, 0.01f}};
  piece.capStart = 0.01f;  // as deep as the section is wide: half a ball
  piece.capEnd = 0.002f;
  const float rim = 0.002f / std::sqrt(2.0f);
  for (const vec3 p : {vec3(0, 0.052f, 0), vec3(0.007f, 0.052f, 0), vec3(0.008f + rim, 0.05f + rim, 0),
                       vec3(0, 0.03f, 0.01f), vec3(0, -0.01f, 0), vec3(0, -0.006f, 0.008f)})
    CHECK(std::abs(piece.distance(p)) < 2e-6f);
  CHECK(piece.distance({0, 0.053f, 0}) == doctest::Approx(0.001f));
}

TEST_CASE("a section turns along its tube as the table's ups do") {
  const Result<std::vector<BoneForm>> turned = tubeWith("0 0 1 ; 1 0 1 ; 1 0 0");
  REQUIRE(turned.ok());
  const BoneForm& form = turned->front();
  CHECK(form.distance({0.018f, 0.001f, 0}) < 0);  // flat from front to back below
  CHECK(form.distance({0, 0.001f, 0.018f}) > 0);
  CHECK(form.distance({0.018f, 0.099f, 0}) > 0);  // from side to side above
  CHECK(form.distance({0, 0.099f, 0.018f}) < 0);
  CHECK(form.distance({-0.0125f, 0.05f, 0.0125f}) < 0);
}

TEST_CASE("as many ups as points, or one") {
  CHECK(tubeWith("0 0 1").ok());
  const Result<std::vector<BoneForm>> two = tubeWith("0 0 1 ; 1 0 0");
  REQUIRE(!two.ok());
  CHECK(two.error().message.find("a tube has an up for every point, or one for all") != std::string::npos);
}
