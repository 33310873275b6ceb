#include "convert/source.h"

#include <doctest/doctest.h>

#include "convert/sources.h"
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
  CHECK(kindOf(named("splenic", "portal vein"), "x") == VesselKind::portalVein);
  CHECK(kindOf(named("portal"), "x") == VesselKind::other);
  CHECK(kindOf(named("thoracic duct"), "x") == VesselKind::lymphatic);
  CHECK(kindOf(named("artery beside a vein"), "x") == VesselKind::other);
  CHECK(kindOf(named("arteriovenous fistula"), "x") == VesselKind::other);
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

TEST_CASE("anatomists' short forms and other languages tell the kind, too") {
  for (const char* artery :
       {"A. femoralis", "Aa. digitales", "a_femoralis", "A. femoral izquierda", "Truncus coeliacus",
        "artère fémorale", "ARTÈRE FÉMORALE", "Artéria renal", "arte\xcc\x80re fe\xcc\x81morale", "LADBranch",
        "Oberschenkelschlagader", "slagader links"})
    CHECK_MESSAGE(kindOf(named(artery), "x") == VesselKind::artery, std::string(artery));
  for (const char* vein : {"V. femoralis", "Vv. hepaticae", "v_saphena", "Vene links", "Oberschenkelvene",
                           "veine cave", "Veia renal", "Sinus sagittalis superior", "Vena cava inferior"})
    CHECK_MESSAGE(kindOf(named(vein), "x") == VesselKind::vein, std::string(vein));
  for (const char* portal : {"V. portae", "Pfortader"})
    CHECK_MESSAGE(kindOf(named(portal), "x") == VesselKind::portalVein, std::string(portal));
  for (const char* neither : {"v_001", "v_mesh", "a.001", "A", "V.", "_", "a_", "model_a.b", "vessel_left",
                              "A_pelvis", "a_tibia", "v_data", "v.left", "a.0001", "A.Metal"})
    CHECK_MESSAGE(kindOf(named(neither), "x") == VesselKind::other, std::string(neither));
}

TEST_CASE("names in other alphabets, and radiologists' short forms, tell the kind") {
  for (const char* artery :
       {"大動脈", "左総頸動脈", "主动脉", "대동맥", "Аорта", "Бедренная артерия", "SMA", "ICA_left", "R-PCA",
        "Acom", "crosse de l'aorte", "Tronco celíaco", "Truncus thyreocervicalis"})
    CHECK_MESSAGE(kindOf(named(artery), "x") == VesselKind::artery, std::string(artery));
  for (const char* vein : {"上大静脈", "内頸静脈", "下腔静脉", "정맥", "Нижняя полая вена", "SMV", "IJV.l",
                           "Sinus durae matris"})
    CHECK_MESSAGE(kindOf(named(vein), "x") == VesselKind::vein, std::string(vein));
  for (const char* portal : {"門脈", "门静脉"})
    CHECK_MESSAGE(kindOf(named(portal), "x") == VesselKind::portalVein, std::string(portal));
  CHECK(kindOf(named("動静脈"), "x") == VesselKind::other);
  CHECK(kindOf(named("リンパ管"), "x") == VesselKind::lymphatic);
  for (const char* neither : {"smart", "location", "africa"})
    CHECK_MESSAGE(kindOf(named(neither), "x") == VesselKind::other, std::string(neither));
}

TEST_CASE("what a vessel runs beside or leaves tells its kind only where nothing else does") {
  const auto kind = [](const char* name) { return kindOf(named(name), "scan"); };
  for (const char* name : {"V. comitans arteriae brachialis", "V. jug. int. dext.", "veine porte", "LIJV",
                           "sinus sagittal supérieur", "Tronc veineux brachio-céphalique"})
    CHECK_MESSAGE(sameFamily(kind(name), VesselKind::vein), name);
  for (const char* name :
       {"Ramus arteriae femoralis", "Arteriae digitales", "LICA", "RMCA", "PICA", "ACoA", "Tr. coeliacus",
        "tronc cœliaque", "tronco braquiocefálico", "Ramus interventricularis anterior", "чревный ствол",
        "плечеголовной ствол", "腹腔干"})
    CHECK_MESSAGE(kind(name) == VesselKind::artery, name);
  CHECK(kind("Arteriae et venae renales") == VesselKind::other);
  CHECK(kind("veine porte") == VesselKind::portalVein);
  CHECK(kind("vena porta") == VesselKind::portalVein);
}

TEST_CASE("an organ among the vessels of one mesh goes with none of them") {
  MeshElement element = named("Vasculature");
  const std::vector<vec3> corners{vec3(0), vec3(1, 0, 0), vec3(0, 1, 0)};
  for (const int k : {0, 1, 2, 1, 0})  // the last two are caps of the second and of the first: beside them
    for (const vec3 corner : corners) element.mesh.positions.push_back(corner + vec3(0, 0, k));
  for (std::uint32_t k = 0; k < 5; ++k) element.mesh.triangles.emplace_back(3 * k, 3 * k + 1, 3 * k + 2);
  element.materials = {
      {"artery", {}, 0}, {"vein", {}, 1}, {"kidney", {}, 2}, {"grey", {}, 3}, {"white", {}, 4}};
  const auto divided = describeElements({element}, "scan");
  REQUIRE(divided.size() == 3);
  CHECK(divided[0].kind == VesselKind::artery);
  CHECK(divided[0].element.mesh.triangles.size() == 2);
  CHECK(divided[1].kind == VesselKind::vein);
  CHECK(divided[1].element.mesh.triangles.size() == 2);
  CHECK(divided[2].kind == VesselKind::other);
  CHECK(divided[2].label == "Vasculature (kidney)");
  CHECK(divided[2].element.mesh.triangles.size() == 1);
}

TEST_CASE("a mesh whose materials say artery and vein is divided by them, unless its name says what it is") {
  MeshElement element = named("Mesh.001");
  element.mesh.positions = {vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(1, 1, 1)};
  element.mesh.triangles = {uvec3(0, 1, 2), uvec3(0, 1, 3), uvec3(1, 2, 4), uvec3(2, 3, 4)};
  element.materials = {
      {"arteries", {}, 0}, {"shine", {}, 1}, {"", vec3(0.05f, 0.1f, 0.6f), 2}, {"arteries", {}, 3}};
  const auto divided = describeElements({element}, "scan");
  REQUIRE(divided.size() == 2);
  CHECK(divided[0].label == "Mesh.001 (arteries)");
  CHECK(divided[0].kind == VesselKind::artery);
  CHECK(divided[0].element.mesh.triangles.size() == 3);
  CHECK(divided[1].label == "Mesh.001 (vein)");
  CHECK(divided[1].kind == VesselKind::vein);
  CHECK(divided[1].element.mesh.positions.size() == 3);
  CHECK(describeElements({element}, "arteries").size() == 1);
  element.surroundings = {"arteries", "Veins"};
  CHECK(describeElements({element}, "scan").size() ==
        1);  // a collection says it; "arteries" is a material's name
  element.surroundings = {"arteries"};
  element.name = "aorta";
  CHECK(describeElements({element}, "scan").size() == 1);
  element.name = "Mesh.001";
  element.materials.pop_back();
  element.materials.pop_back();
  CHECK(describeElements({element}, "scan").size() == 1);
}

TEST_CASE("organs, bones and findings are known by their names, where nothing says that they are vessels") {
  for (const char* name : {"kidney_left", "vertebrae_L3", "rib_left_4", "Calcification.001", "Liver", "stent",
                           "lung_upper_lobe_left", "spinal_cord", "organ: suprarenal gland", "windpipe",
                           "atrial_appendage_left", "lymph_nodes", "cervical_spine"})
    CHECK_MESSAGE(namesNoVessel(named(name), "scan") != NoVessel::none, name);
  for (const char* name :
       {"Aorta", "renal artery to kidney", "liver vessels", "stomach branch", "portal", "pulmonary_vein",
        "hepatic", "Mesh.001", "vertebral_left", "superior thyroid", "R_ovarian", "bronchial", "cystic",
        "left atrial", "hip_circumflex", "lung_vasc", "kidney capillaries"})
    CHECK_MESSAGE(namesNoVessel(named(name), "scan") == NoVessel::none, name);
  for (const char* name :
       {"Hepar", "Ren sinister", "Leber", "Niere links", "foie", "cœur", "hígado", "fegato", "rinón", "肝臓",
        "左肾", "печень", "M. biceps brachii", "N. vagus", "Os ilium"})
    CHECK_MESSAGE(namesNoVessel(named(name), "scan") != NoVessel::none, name);
  for (const char* name : {"A. hepatica", "Gefäße Leber", "vaisseaux du foie", "vasos del hígado", "肝血管",
                           "肺动脉", "M1", "Ren_L", "Splen", "m.001", "n_2", "M.Schmidt"})
    CHECK_MESSAGE(namesNoVessel(named(name), "scan") == NoVessel::none, name);
  for (const char* name : {"coeur coronaires",
                           "Herz Kranzgefäße",
                           "heart_coronaries",
                           "heart_bypass_graft",
                           "brain_circle_of_willis",
                           "brain basilar",
                           "brain_aneurysm",
                           "liver_portal",
                           "liver TIPS",
                           "AV fistula kidney",
                           "esophagus varices",
                           "A ren dext",
                           "A_ren_sinistra",
                           "V ren dext",
                           "A lien",
                           "a uretericus",
                           "總腸骨",
                           "селезеночная",
                           "m. media",
                           "M. sup",
                           "N. coronaria",
                           "m_cerebralis",
                           "n_phrenica"})
    CHECK_MESSAGE(namesNoVessel(named(name), "scan") == NoVessel::none, name);
  CHECK(namesNoVessel(named("stomach"), "bp3d_arteries") == NoVessel::none);
  CHECK(namesNoVessel(named("stomach", "vein"), "scan") == NoVessel::none);
  MeshElement lung = named("lung");
  lung.surroundings = {"Arteries"};
  lung.materials = {{"Arteries", {}}};
  CHECK(namesNoVessel(lung, "scan") == NoVessel::none);

  const auto left = [](const std::vector<const char*>& names) {
    std::vector<MeshElement> elements;
    for (const char* name : names) elements.push_back(named(name));
    auto sources = describeElements(std::move(elements), "scan");
    std::vector<std::string> out;
    for (const LeftOut& element : leaveOutNoVessels(sources)) out.push_back(element.name);
    CHECK(out.size() + sources.size() == names.size());
    return out;
  };
  CHECK(left({"aorta", "liver", "left renal"}) == std::vector<std::string>{"liver"});
  std::vector<MeshElement> wide(3);  // a body and what lies in it
  wide[0].name = "Figure", wide[0].mesh = test::tubeBetween({0, 0, 0}, {0, 1.7f, 0}, 0.1f);
  wide[1].name = "Arteries", wide[1].mesh = test::tubeBetween({0, 1, 0}, {0, 1.4f, 0}, 0.01f);
  wide[2].name = "Mesh.001", wide[2].mesh = test::tubeBetween({0.05f, 1, 0}, {0.05f, 1.4f, 0}, 0.01f);
  auto all = describeElements(wide, "scan");
  const auto out = leaveOutNoVessels(all);
  REQUIRE(out.size() == 1);
  CHECK(out[0].name == "Figure");
  CHECK(out[0].why == NoVessel::width);
  wide[1].mesh =
      test::tubeBetween({0.3f, 1, 0}, {0.3f, 1.4f, 0}, 0.01f);  // beside it, which may be an aneurysm
  all = describeElements(wide, "scan");
  CHECK(leaveOutNoVessels(all).empty());
  wide[1].mesh = test::tubeBetween({0, 1, 0}, {0, 1.4f, 0}, 0.01f);
  for (MeshElement& element : wide)
    for (vec3& p : element.mesh.positions) p *= 100;  // in centimetres
  all = describeElements(wide, "scan");
  CHECK(leaveOutNoVessels(all).empty());
  wide[1].name = "Mesh";
  all = describeElements(wide, "scan");
  CHECK(leaveOutNoVessels(all).empty());
  CHECK(left({"liver", "brain"}).empty());  // somebody's vessels of these, as the files are called
}

TEST_CASE("a vessel's adjective or short form beside an organ's name means the vessel, and not its part") {
  for (const char* name :
       {"liver_hepatic", "kidney_RA", "kidney LRV", "liver PV", "femur profunda", "tibia ant",
        "colon marginalis", "bone nutrient", "spleen splenic", "femur nutricia"})
    CHECK_MESSAGE(namesNoVessel(named(name), "scan") == NoVessel::none, name);
  for (const char* name : {"colon splenic flexure", "kidney renal pelvis", "liver hepatic segment 4",
                           "heart RA", "heart_RV", "femur femoral head", "vertebrae_L3_posterior_elements"})
    CHECK_MESSAGE(namesNoVessel(named(name), "scan") != NoVessel::none, name);
}

TEST_CASE("words written without a mark between them are known, too") {
  for (const char* name :
       {"leftkidney", "kidneyright", "lefthumerus", "rightatrium", "LEFTLUNG", "interventricular_septum",
        "hard_palate", "zygomatic_arch_right", "levator_scapulae", "pleural_effusion", "Harnblase"})
    CHECK_MESSAGE(namesNoVessel(named(name), "scan") != NoVessel::none, name);
  for (const char* name : {"liver_hepaticvessel", "lungvessels", "leftrenalartery", "kidney_renalvein",
                           "leftover", "rightmost branch", "cleft", "upright"})
    CHECK_MESSAGE(namesNoVessel(named(name), "scan") == NoVessel::none, name);
  for (const auto& each : {std::pair("leftrenalvein", VesselKind::vein),
                           {"hepaticveins", VesselKind::vein},
                           {"portalvein", VesselKind::portalVein},
                           {"venacavainferior", VesselKind::vein},
                           {"coronarysinus", VesselKind::vein},
                           {"leftfemoralartery", VesselKind::artery},
                           {"DescAo", VesselKind::artery},
                           {"LSCA", VesselKind::artery},
                           {"MPA", VesselKind::artery}})
    CHECK_MESSAGE(kindOf(named(each.first), "scan") == each.second, each.first);
}

TEST_CASE("what lies in vessels is none, whatever it lies in; a vessel that has one is one") {
  struct Case {
    const char* name;
    NoVessel why;
  };
  for (const Case& each : {Case{"coronary stent", NoVessel::device},
                           {"LAD_stent.001", NoVessel::device},
                           {"stent with thrombus", NoVessel::device},
                           {"aneurysm thrombus", NoVessel::finding},
                           {"portal vein thrombosis", NoVessel::finding},
                           {"aorta calcifications", NoVessel::finding},
                           {"aortic valve", NoVessel::heart},
                           {"válvula aórtica", NoVessel::heart},
                           {"Aortenklappe", NoVessel::heart},
                           {"冠動脈ステント", NoVessel::device},
                           {"P com stent", NoVessel::device},
                           {"aorta com stent", NoVessel::none},
                           {"aorta with stent", NoVessel::none},
                           {"aorta_post_stent", NoVessel::none},
                           {"aneurysm without thrombus", NoVessel::none},
                           {"calcified aorta", NoVessel::none},
                           {"stented artery", NoVessel::none}})
    CHECK_MESSAGE(namesNoVessel(named(each.name), "arteries") == each.why, each.name);
  CHECK(namesNoVessel(named("stent", "artery"), "scan") == NoVessel::none);  // the file itself says so
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
