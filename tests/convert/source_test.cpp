#include "convert/source.h"

#include <doctest/doctest.h>

#include "convert/vessel_names.h"

using namespace vasa;

namespace {

MeshElement named(const char* name, const char* category = "") { return {name, category, {}, {}}; }

}  // namespace

TEST_CASE("the kind comes from the category, else the file's name, else the element's") {
  CHECK(kindOf(named("splenic", "artery"), "veins") == VesselKind::artery);
  CHECK(kindOf(named("splenic"), "bp3d_veins") == VesselKind::vein);
  CHECK(kindOf(named("Inferior Vena Cava"), "body") == VesselKind::vein);
  CHECK(kindOf(named("arch of aorta"), "body") == VesselKind::artery);
  CHECK(kindOf(named("left portal vein", "vein"), "x") == VesselKind::portalVein);
  CHECK(kindOf(named("portal"), "x") == VesselKind::other);
  CHECK(kindOf(named("thoracic duct"), "x") == VesselKind::lymphatic);
  CHECK(kindOf(named("artery beside a vein"), "x") == VesselKind::other);
  CHECK(sameFamily(VesselKind::vein, VesselKind::portalVein));
  CHECK(!sameFamily(VesselKind::vein, VesselKind::artery));
}

TEST_CASE("catalogue numbers go, names stay") {
  CHECK(vesselLabel("FJ1654M left anterior cerebral artery") == "left anterior cerebral artery");
  CHECK(vesselLabel("FMA50029  aorta") == "aorta");
  CHECK(vesselLabel("left vein") == "left vein");
  CHECK(vesselLabel("L2 lumbar artery") == "L2 lumbar artery");
  CHECK(vesselLabel("FJ1654") == "FJ1654");
}

TEST_CASE("names continue one another by side and a telling word") {
  CHECK(namesContinue("right common carotid artery", "right internal carotid artery"));
  CHECK(!namesContinue("right common carotid artery", "left internal carotid artery"));
  CHECK(!namesContinue("left common iliac artery", "left common carotid artery"));
  CHECK(!namesContinue("superior branch of artery", "inferior branch of artery"));
  CHECK(!namesContinue("dorsal digital artery of foot", "set of plantar digital arteries"));
  CHECK(namesContinue("splenic artery", "splenic artery"));
  CHECK(circuitOf("left pulmonary artery") == Circuit::pulmonary);
  CHECK(circuitOf("arch of aorta") == Circuit::systemic);
  CHECK(circuitOf("left renal artery") == Circuit::unknown);
}
