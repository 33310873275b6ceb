#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "atlas/human_scene.h"
#include "body/mesh_role.h"
#include "plate/label_names.h"
#include "plate/plate.h"
#include "plate/plate_region.h"

using namespace vasa;
using namespace vasa::plate;

namespace {

// What a page of the built-in human labels at rest, on A4.
std::vector<std::string> planned(const std::string& name) {
  static const SweepTable table = makeSweepTable(test::humanScene().network);
  static const auto frame = [] {
    auto maker = std::make_unique<FrameMaker>(test::humanScene(), FrameOptions{.avoid = true});
    maker->make(nullptr, 0);
    return maker;
  }();
  const auto type = Typesetter::load();
  REQUIRE_MESSAGE(type.ok(), type.error().message);
  const auto subject = plateSubject(test::humanScene(), *frame, name, -1);
  REQUIRE_MESSAGE(subject.ok(), subject.error().message);
  std::vector<vec3> drawn;
  for (const vec4& point : frame->points()) drawn.emplace_back(point);
  auto fitted = cameraOnto(subject->framed, subject->towards, subject->up, drawn);
  fitted.camera.cut = subject->cut;
  // As `vasa plate` turns them.
  const bool wide = name == "brain" || name == "thorax" || name == "abdomen" || name == "hand";
  PlateStyle style{
      .page = wide ? vec2(297, 210) : vec2(210, 297), .title = subject->title, .subtitle = subject->subtitle};
  Look look;
  look.skinOpacity = 0.2f;
  const auto plan =
      planPlate({test::humanScene(), *frame, table, subject->meshes, subject->vessels, subject->own, look},
                style, *type, fitted.camera, fitted.aspect);
  REQUIRE_MESSAGE(plan.ok(), plan.error().message);
  std::vector<std::string> texts;
  for (const PlacedLabel& placed : plan->layout.placed) texts.push_back(plan->labels[placed.label].text);
  return texts;
}

const std::vector<std::string>& labelsOn(const std::string& name) {
  static std::map<std::string, std::vector<std::string>> known;
  const auto [page, isNew] = known.try_emplace(name);
  if (isNew) page->second = planned(name);
  return page->second;
}

}  // namespace

TEST_CASE("pages label what textbooks name first") {
  // Of each page what is seen there and every course of anatomy asks for.
  const std::map<std::string, std::vector<const char*>> textbook{
      {"front", {"Superior vena cava",    "Inferior vena cava",
                 "Thoracic aorta",        "Abdominal aorta",
                 "Pulmonary trunk",       "Left common carotid artery",
                 "Internal jugular vein", "Subclavian vein",
                 "Axillary artery",       "Brachial artery",
                 "Radial artery",         "Ulnar artery",
                 "Cephalic vein",         "Basilic vein",
                 "Portal vein",           "Superior mesenteric artery",
                 "Left renal vein",       "Common iliac artery",
                 "Femoral artery",        "Femoral vein",
                 "Deep femoral artery",   "Great saphenous vein",
                 "Anterior tibial artery"}},
      {"head",
       {"Left common carotid artery", "Internal carotid artery", "External carotid artery", "Facial artery",
        "Superficial temporal artery", "Occipital artery", "Right vertebral artery",
        "Right subclavian artery", "Internal jugular vein", "External jugular vein", "Facial vein",
        "Retromandibular vein", "Subclavian vein"}},
      {"brain",
       {"Internal carotid artery", "Anterior cerebral artery", "Middle cerebral artery",
        "Posterior cerebral artery", "Anterior communicating artery", "Basilar artery",
        "Right vertebral artery", "Superior cerebellar artery", "Anterior inferior cerebellar artery",
        "Posterior inferior cerebellar artery", "Ophthalmic artery", "Middle meningeal artery",
        "Superior sagittal sinus", "Transverse sinus", "Sigmoid sinus", "Great cerebral vein"}},
      {"thorax",
       {"Arch of aorta", "Thoracic aorta", "Superior vena cava", "Left brachiocephalic vein",
        "Right brachiocephalic vein", "Pulmonary trunk", "Left pulmonary artery", "Superior pulmonary vein",
        "Left common carotid artery", "Left subclavian artery", "Left internal thoracic artery",
        "Right internal thoracic artery"}},
      {"abdomen",
       {"Abdominal aorta", "Inferior vena cava", "Portal vein", "Superior mesenteric artery",
        "Superior mesenteric vein", "Splenic artery", "Splenic vein", "Common hepatic artery",
        "Inferior mesenteric artery", "Left renal artery", "Left renal vein", "Common iliac artery",
        "Internal iliac artery", "External iliac artery"}},
      {"arm",
       {"Axillary artery", "Brachial artery", "Deep brachial artery", "Radial artery", "Ulnar artery",
        "Common interosseous artery", "Superficial palmar arch", "Deep palmar arch", "Cephalic vein",
        "Basilic vein", "Median cubital vein"}},
      {"hand",
       {"Radial artery", "Superficial palmar arch", "Deep palmar arch", "Principal artery of thumb",
        "Common palmar digital arteries", "Palmar metacarpal arteries"}},
      {"leg",
       {"Femoral artery", "Femoral vein", "Deep femoral artery", "Popliteal artery", "Anterior tibial artery",
        "Posterior tibial artery", "Fibular artery", "Dorsal artery of foot", "Great saphenous vein",
        "Small saphenous vein"}},
      {"foot",
       {"Dorsal artery of foot", "Dorsal metatarsal arteries", "Arcuate artery", "Plantar arch",
        "Plantar digital arteries", "Dorsal venous arch of foot", "Medial plantar artery",
        "Lateral plantar artery"}}};
  for (const auto& [name, wanted] : textbook) {
    const std::string page = name;
    const auto labels = labelsOn(page);
    for (const char* vessel : wanted)
      CHECK_MESSAGE(std::ranges::count(labels, vessel) == 1, page << ": " << vessel);
  }
}

TEST_CASE("without bones there is no page of the brain") {
  Scene scene = test::humanScene();
  std::erase_if(scene.body.meshes,
                [](const SkinnedMesh& mesh) { return roleNamed(mesh.name) == MeshRole::bones; });
  FrameMaker frame(scene, {.avoid = false});
  frame.make(nullptr, 0);
  const auto none = plateSubject(scene, frame, "brain", -1);
  REQUIRE_FALSE(none.ok());
  CHECK(none.error().fault == Fault::badInput);
  CHECK(none.error().message.find("no bones of the head") != std::string::npos);
}

TEST_CASE("pages name no branch beside its parent, and no row one by one") {
  const auto head = labelsOn("head");
  CHECK(std::ranges::count(head, "Retromandibular vein") == 1);
  CHECK(std::ranges::count(head, "Anterior branch of retromandibular vein") == 0);
  // What hangs under the diaphragm goes with the ribs and is of the abdomen all the same.
  CHECK(std::ranges::count(labelsOn("thorax"), "Splenic vein") == 0);
  const auto hand = labelsOn("hand");
  const std::set<std::string> named(hand.begin(), hand.end());
  for (const std::string& label : hand)
    CHECK_MESSAGE(!named.contains(plural(rowOf(label))), label);  // a row's own plural differs from itself
}
