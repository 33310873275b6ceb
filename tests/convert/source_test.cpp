#include "convert/source.h"

#include <doctest/doctest.h>

#include "convert/vessel_names.h"

using namespace vasa;

namespace {

MeshElement named(const char* name, const char* category = "") { return {name, category, {}, {}}; }

}  // namespace

TEST_CASE("the kind comes from the category, else the element's name, else the file's") {
  CHECK(kindOf(named("splenic", "artery"), "veins") == VesselKind::artery);
  CHECK(kindOf(named("splenic"), "bp3d_veins") == VesselKind::vein);
  CHECK(kindOf(named("Inferior Vena Cava"), "body") == VesselKind::vein);
  CHECK(kindOf(named("arch of aorta"), "body") == VesselKind::artery);
  CHECK(kindOf(named("left deep palmar arch"), "body") == VesselKind::artery);
  CHECK(kindOf(named("left deep palmar venous arch"), "body") == VesselKind::vein);
  CHECK(kindOf(named("left cavernous sinus"), "body") == VesselKind::vein);
  CHECK(kindOf(named("carotid sinus"), "body") == VesselKind::artery);
  MeshElement splenic = named("splenic vein");
  splenic.surroundings = {"portal_vein"};
  CHECK(kindOf(splenic, "body") == VesselKind::portalVein);
  CHECK(kindOf(named("left portal vein", "vein"), "x") == VesselKind::portalVein);
  CHECK(kindOf(named("portal"), "x") == VesselKind::other);
  CHECK(kindOf(named("thoracic duct"), "x") == VesselKind::lymphatic);
  CHECK(kindOf(named("artery beside a vein"), "x") == VesselKind::other);
  CHECK(sameFamily(VesselKind::vein, VesselKind::portalVein));
  CHECK(!sameFamily(VesselKind::vein, VesselKind::artery));
}

TEST_CASE(
    "names of others tell the kind: numbers of an ontology, what is around them, at last their colour") {
  CHECK(kindOf(named("Superior_VenaCava"), "heart") == VesselKind::vein);
  CHECK(kindOf(named("SVC.001"), "heart") == VesselKind::vein);
  CHECK(kindOf(named("PulmonaryTrunk"), "heart") == VesselKind::artery);
  CHECK(kindOf(named("Mesh_12 FMA10951"), "heart") == VesselKind::vein);
  CHECK(kindOf(named("UBERON_0000947_1"), "heart") == VesselKind::artery);
  CHECK(kindOf(named("FMA37341"), "heart") == VesselKind::other);
  CHECK(kindOf(named("pulmonary artery", ""), "all_veins") == VesselKind::artery);
  MeshElement element = named("Object_4");
  CHECK(kindOf(element, "heart") == VesselKind::other);
  element.colour = vec3(0.6f, 0.05f, 0.04f);
  CHECK(kindOf(element, "heart") == VesselKind::artery);
  element.colour = vec3(0.05f, 0.1f, 0.6f);
  CHECK(kindOf(element, "heart") == VesselKind::vein);
  element.surroundings = {"Material.007", "Collection 2", "Arteries"};
  CHECK(kindOf(element, "heart") == VesselKind::artery);
  element.colour = vec3(0.8f, 0.5f, 0.45f);  // flesh
  element.surroundings = {"Heart"};
  CHECK(kindOf(element, "heart") == VesselKind::other);
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
