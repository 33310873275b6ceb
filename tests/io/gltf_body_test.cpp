#include <doctest/doctest.h>

#include "body/skinning.h"
#include "core/log.h"
#include "io/gltf.h"
#include "io/gltf_builder.h"
#include "io/gltf_clips.h"
#include "io/person_pieces.h"
#include "io/reading.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;
using nlohmann::json;

namespace {

std::vector<vec3> posed(const Body& body, const SkinnedMesh& mesh, const Pose& pose) {
  std::vector<vec3> positions;
  skinPositions(mesh, skinMatrices(body.skeleton, pose), positions);
  return positions;
}

std::vector<vec3> atRest(const Body& body, std::size_t mesh = 0) {
  return posed(body, body.meshes[mesh], restPose(body.skeleton));
}

bool near(vec3 a, vec3 b) {
  const bool is = glm::distance(a, b) < 1e-5f;
  if (!is) MESSAGE(a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z);
  return is;
}

void parentsFirst(const Skeleton& skeleton) {
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i)
    if (skeleton.joints[i].parent.valid()) CHECK(skeleton.joints[i].parent.value < i);
}

const std::vector<float> kUpright = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};  // +Z up to +Y up

}  // namespace

TEST_CASE("joints, rest pose, clip and skin of a body worked by hand") {
  const Body body = bodyOf(bodyFile());
  REQUIRE(body.skeleton.joints.size() == 2);
  CHECK(body.name == "a.glb");
  CHECK(body.skeleton.joints[0].name == "hip");
  CHECK(!body.skeleton.joints[0].parent.valid());
  CHECK(body.skeleton.joints[1].parent == JointId{0});
  CHECK(near(vec3(body.skeleton.joints[1].restWorld[3]), {0, 0.5f, 0}));
  CHECK(body.height() == doctest::Approx(1));
  CHECK(atRest(body) == std::vector<vec3>{{0, 1, 0}, {1, 1, 0}, {0, 0, 0}});
  REQUIRE(body.clips.size() == 1);
  const Clip& bend = body.clips[0];
  CHECK(bend.name == "bend");
  CHECK(bend.framesPerSecond == 10);
  CHECK(bend.frameCount() == 3);
  // The knee turns by 90 degrees about z: what hung below it points to +x.
  const auto bent = posed(body, body.meshes[0], samplePose(body.skeleton, bend, bend.timeOfFrame(2)));
  CHECK(near(bent[1], {1, 1, 0}));
  CHECK(near(bent[2], {0.5f, 0.5f, 0}));
}

TEST_CASE("clips of one name can each be chosen") {
  GltfBuilder file = bodyFile();
  auto& animations = file.document["animations"];
  const nlohmann::json first = animations[0];
  animations.push_back(first);
  animations.push_back(first);
  const Body body = bodyOf(file);
  REQUIRE(body.clips.size() == 3);
  CHECK(body.clips[1].name == body.clips[0].name + " 2");
  CHECK(body.clips[2].name == body.clips[0].name + " 3");
}

TEST_CASE("animations of which each moves one joint are one clip, where they move most of a person") {
  GltfBuilder file = bodyFile();
  file.document["skins"][0].erase("inverseBindMatrices");
  const nlohmann::json first = file.document["animations"][0];
  std::vector<nlohmann::json> each;
  for (int joint = 3; joint < 17; ++joint) {  // a chain below the knee
    file.document["nodes"][std::size_t(joint == 3 ? 1 : joint - 1)]["children"] = {joint};
    file.add("nodes", {{"translation", {0, -0.1, 0}}});
    file.document["skins"][0]["joints"].push_back(joint);
    nlohmann::json own = first;
    own["name"] = "bend of " + std::to_string(joint);
    own["channels"][0]["target"]["node"] = joint;
    each.push_back(own);
  }
  file.document["animations"] = each;
  const Body body = bodyOf(file);
  REQUIRE(body.clips.size() == 1);
  CHECK(body.clips[0].name == "bend of 3");
  CHECK(body.clips[0].frameCount() == 3);
  CHECK(body.clips[0].framesPerSecond == 10);
  REQUIRE(body.clips[0].tracks.size() == 14);
  CHECK(body.clips[0].tracks[0].joint == JointId{2});
  // Where two move the same joint they are not meant together.
  each.back()["channels"][0]["target"]["node"] = 3;
  file.document["animations"] = each;
  CHECK(bodyOf(file).clips.size() == 14);
}

TEST_CASE("joints of one name can each be told apart") {
  GltfBuilder file = bodyFile();
  for (auto& node : file.document["nodes"]) node["name"] = "Bone";
  const Body body = bodyOf(file);
  REQUIRE(body.skeleton.joints.size() == 2);
  CHECK(body.skeleton.joints[0].name == "Bone");
  CHECK(body.skeleton.joints[1].name == "Bone 2");
}

TEST_CASE("a clip that takes the body out of all bounds is left out") {
  const auto clipsWith = [](const char* path, const char* interpolation, const std::vector<float>& values) {
    GltfBuilder file = bodyFile();
    file.add("animations", {{"name", "stray"},
                            {"samplers",
                             {{{"input", file.floats({0, 1}, "SCALAR")},
                               {"output", file.floats(values, "VEC3")},
                               {"interpolation", interpolation}}}},
                            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
    const LogLevel before = logLevel();
    setLogLevel(LogLevel::quiet);
    const Body body = bodyOf(file);
    setLogLevel(before);
    CHECK(body.clips[0].name == "bend");
    return body.clips.size();
  };
  CHECK(clipsWith("translation", "LINEAR", {0, 1, 0, 0, 900, 0}) == 2);
  CHECK(clipsWith("translation", "LINEAR", {0, 1, 0, 0, 3e38f, 0}) == 1);
  CHECK(clipsWith("translation", "STEP", {0, 1, 0, 1e6f, 1, 0}) == 1);
  CHECK(clipsWith("translation", "CUBICSPLINE", {0, 0, 0, 0, 1, 0, 1e5f, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0}) ==
        1);
  CHECK(clipsWith("scale", "LINEAR", {1, 1, 1, 1, 3e38f, 1}) == 1);
  CHECK(clipsWith("scale", "LINEAR", {1, 1, 1, 2, 2, 2}) == 2);
}

TEST_CASE("joints are ordered parents first, whatever order the file has") {
  GltfBuilder file = bodyFile();
  file.document["nodes"] = {{{"name", "knee"}, {"translation", {0, -0.5, 0}}},
                            {{"name", "hip"}, {"translation", {0, 1, 0}}, {"children", {0}}},
                            {{"mesh", 0}, {"skin", 0}}};
  file.document["skins"][0]["joints"] = {1, 0};
  file.document["animations"][0]["channels"][0]["target"]["node"] = 0;
  const Body body = bodyOf(file);
  parentsFirst(body.skeleton);
  CHECK(body.skeleton.joints[0].name == "hip");
  CHECK(body.clips[0].tracks[0].joint == JointId{1});
  CHECK(atRest(body) == std::vector<vec3>{{0, 1, 0}, {1, 1, 0}, {0, 0, 0}});
}

TEST_CASE("nodes above the joints become the root transform, and vertices move with it") {
  GltfBuilder file = bodyFile();
  file.add("nodes", {{"name", "upright"}, {"matrix", kUpright}, {"children", {0}}});
  const Body body = bodyOf(file);
  CHECK(body.skeleton.joints.size() == 2);
  CHECK(near(vec3(body.skeleton.rootTransform * vec4(0, 0, 1, 1)), {0, 1, 0}));
  // Inverse binds still belong to +Y up: the rest pose is the binding pose turned, and that is baked.
  CHECK(near(body.meshes[0].mesh.positions[0], {0, 0, -1}));
  CHECK(near(atRest(body)[0], {0, 0, -1}));
  CHECK(near(atRest(body)[1], {1, 0, -1}));
}

TEST_CASE("an animated node above the joints becomes a joint") {
  GltfBuilder file = bodyFile();
  file.add("nodes", {{"name", "figure root"}, {"translation", {0, 0, 1}}, {"children", {0}}});
  const int path = file.floats({0, 0, 0, 0, 0, 2, 0, 0, 4}, "VEC3");
  file.document["animations"][0]["samplers"].push_back({{"input", 4}, {"output", path}});
  file.document["animations"][0]["channels"].push_back(
      {{"sampler", 1}, {"target", {{"node", 3}, {"path", "translation"}}}});
  const Body body = bodyOf(file);
  REQUIRE(body.skeleton.joints.size() == 3);
  parentsFirst(body.skeleton);
  CHECK(body.skeleton.joints[0].name == "figure root");
  CHECK(near(atRest(body)[0], {0, 1, 1}));
  const auto moved = posed(body, body.meshes[0], samplePose(body.skeleton, body.clips[0], 0.1f));
  CHECK(near(moved[0], {0, 1, 2}));
}

TEST_CASE("a node between joints becomes a joint") {
  GltfBuilder file = bodyFile();
  file.document["nodes"][0]["children"] = {3};
  file.add("nodes", {{"name", "between"}, {"translation", {0, 0.25, 0}}, {"children", {1}}});
  file.document["nodes"][1]["translation"] = {0, -0.75, 0};
  const Body body = bodyOf(file);
  REQUIRE(body.skeleton.joints.size() == 3);
  CHECK(body.skeleton.joints[1].name == "between");
  CHECK(near(vec3(body.skeleton.joints[2].restWorld[3]), {0, 0.5f, 0}));
}

TEST_CASE("root joints under different transforms keep them as joints") {
  GltfBuilder file = bodyFile();
  file.document["nodes"][0].erase("children");
  file.document["nodes"][1]["translation"] = {0, 0, 0};
  file.add("nodes", {{"name", "holder"}, {"translation", {0, 0.5, 0}}, {"children", {1}}});
  file.add("nodes", {{"name", "both"}, {"children", {0, 3}}});
  const Body body = bodyOf(file);
  CHECK(body.skeleton.joints.size() == 4);
  CHECK(body.skeleton.rootTransform == mat4(1));
  CHECK(near(vec3(body.skeleton.joints[body.skeleton.find("knee").value].restWorld[3]), {0, 0.5f, 0}));
  CHECK(atRest(body) == std::vector<vec3>{{0, 1, 0}, {1, 1, 0}, {0, 0, 0}});
}

TEST_CASE("two skins in different binding spaces share their joints") {
  GltfBuilder file = bodyFile();
  // The second skin's mesh is stored 10 to the right; its inverse binds bring it back.
  std::vector<float> binds = matrixAt({-10, -1, 0});
  const auto knee = matrixAt({-10, -0.5f, 0});
  binds.insert(binds.end(), knee.begin(), knee.end());
  file.add("skins", {{"joints", {0, 1}}, {"inverseBindMatrices", file.floats(binds, "MAT4")}});
  file.add("meshes", file.document["meshes"][0]);
  file.document["meshes"][1]["primitives"][0]["attributes"]["POSITION"] =
      file.floats({10, 1, 0, 11, 1, 0, 10, 0, 0}, "VEC3");
  file.add("nodes", {{"mesh", 1}, {"skin", 1}});
  const Body body = bodyOf(file);
  CHECK(body.skeleton.joints.size() == 2);
  REQUIRE(body.meshes.size() == 2);
  CHECK(near(body.meshes[1].mesh.positions[1], {1, 1, 0}));
  CHECK(atRest(body, 1) == atRest(body, 0));
}

TEST_CASE(
    "rest is the pose that the skin is bound in, whatever pose the nodes have; a second skin bound otherwise doubles joints") {
  GltfBuilder file = bodyFile();
  file.document["nodes"][1]["translation"] = {0, -0.75, 0};  // bound at -0.5, in the nodes' pose 0.25 lower
  Body body = bodyOf(file);
  CHECK(body.skeleton.joints.size() == 2);
  CHECK(body.meshes[0].mesh.positions[2] == vec3(0, 0, 0));
  CHECK(near(atRest(body)[2], {0, 0, 0}));
  CHECK(near(vec3(body.skeleton.joints[1].restWorld[3]), {0, 0.5f, 0}));
  // What the clip does not move is where the nodes have it: the knee is turned, its place is not told.
  CHECK(
      near(posed(body, body.meshes[0], samplePose(body.skeleton, body.clips[0], 0.2f))[2], {0.5f, 0.25f, 0}));
  std::vector<float> binds = matrixAt({0, -1, 0});
  const auto knee = matrixAt({0, -0.25f, 0});
  binds.insert(binds.end(), knee.begin(), knee.end());
  file.add("skins", {{"joints", {0, 1}}, {"inverseBindMatrices", file.floats(binds, "MAT4")}});
  file.add("nodes", {{"mesh", 0}, {"skin", 1}});
  body = bodyOf(file);
  parentsFirst(body.skeleton);
  REQUIRE(body.skeleton.joints.size() == 3);
  CHECK(body.skeleton.joints[2].name == "knee (second binding)");
  CHECK(near(atRest(body, 0)[2], {0, 0, 0}));
  CHECK(near(atRest(body, 1)[2], {0, 0.25f, 0}));
  const Pose bent = samplePose(body.skeleton, body.clips[0], 0.2f);
  CHECK(near(posed(body, body.meshes[0], bent)[2], {0.5f, 0.25f, 0}));
  CHECK(near(posed(body, body.meshes[1], bent)[2], {0.25f, 0.25f, 0}));
}

TEST_CASE(
    "a file saved in a jump, bound in centimetres with +Z up below nodes that say so, rests upright in metres") {
  GltfBuilder file = bodyFile();
  // Bind space: centimetres, +Z up; the node above is turned and scaled; the hip is raised and the knee bent.
  const std::vector<float> up{0.01f, 0, 0, 0, 0, 0, -0.01f, 0, 0, 0.01f, 0, 0, 0, 0, 0, 1};
  file.add("nodes", {{"name", "Armature"}, {"matrix", up}, {"children", {0}}});
  file.document["nodes"][0]["translation"] = {0, 0, 130};
  file.document["nodes"][1]["translation"] = {0, 0, -50};
  file.document["nodes"][1]["rotation"] = {0.6, 0, 0, 0.8};
  std::vector<float> binds = matrixAt({0, 0, -100});
  const auto knee = matrixAt({0, 0, -50});
  binds.insert(binds.end(), knee.begin(), knee.end());
  file.document["skins"][0]["inverseBindMatrices"] = file.floats(binds, "MAT4");
  const int positions = file.floats({0, 0, 100, 100, 0, 100, 0, 0, 0}, "VEC3");
  file.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = positions;
  const Body body = bodyOf(file);
  CHECK(near(vec3(body.skeleton.joints[0].restWorld[3]), {0, 1, 0}));
  CHECK(near(vec3(body.skeleton.joints[1].restWorld[3]), {0, 0.5f, 0}));
  CHECK(near(body.meshes[0].mesh.positions[1], {1, 1, 0}));
  CHECK(near(atRest(body)[1], {1, 1, 0}));
  CHECK(body.height() == doctest::Approx(1));
  CHECK(near(posed(body, body.meshes[0], samplePose(body.skeleton, body.clips[0], 0))[1], {1, 1.3f, 0}));
}

TEST_CASE(
    "packed vertices of a file saved in a pose have their own size, and the hip where the nodes have it") {
  GltfBuilder file = bodyFile();
  // Stored are (p - (0.5, 0.5, 0)) / 0.8 as shares of 32767, each with a number that only fills a word.
  const int positions = file.accessor<std::int16_t>(
      {-20479, 20479, 0, 0, 20479, 20479, 0, 0, -20479, -20479, 0, 0}, "VEC3", 5122, 3);
  file.document["accessors"][positions]["normalized"] = true;
  file.document["bufferViews"][file.document["accessors"][positions]["bufferView"].get<int>()]["byteStride"] =
      8;
  file.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = positions;
  std::vector<float> binds;
  for (const float height : {1.0f, 0.5f})
    for (const float number :
         {0.8f, 0.f, 0.f, 0.f, 0.f, 0.8f, 0.f, 0.f, 0.f, 0.f, 0.8f, 0.f, 0.5f, 0.5f - height, 0.f, 1.f})
      binds.push_back(number);
  file.document["skins"][0]["inverseBindMatrices"] = file.floats(binds, "MAT4");
  file.document["extensionsUsed"] = {"KHR_mesh_quantization"};
  const auto isAtRest = [](const Body& body) {
    const std::vector<vec3> unpacked{{0, 1, 0}, {1, 1, 0}, {0, 0, 0}}, found = atRest(body);
    REQUIRE(found.size() == unpacked.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(glm::distance(found[i], unpacked[i]) < 1e-4f);
    CHECK(near(vec3(body.skeleton.joints[0].restWorld[3]), {0, 1, 0}));
    CHECK(near(vec3(body.skeleton.joints[1].restWorld[3]), {0, 0.5f, 0}));
    CHECK(body.height() == doctest::Approx(1).epsilon(1e-3));
  };
  isAtRest(bodyOf(file));
  file.document["nodes"][1]["rotation"] = {0, 0, 0.6, 0.8};
  const LogLevel before = logLevel();
  setLogLevel(LogLevel::quiet);
  const Body posedFile = bodyOf(file);
  setLogLevel(before);
  isAtRest(posedFile);
  const auto bent =
      posed(posedFile, posedFile.meshes[0], samplePose(posedFile.skeleton, posedFile.clips[0], 0.2f));
  CHECK(glm::distance(bent[2], vec3(0.5f, 0.5f, 0)) < 1e-4f);
}

TEST_CASE(
    "vertices of a skin without inverse bind matrices lie beside their joints, which stay where they are") {
  GltfBuilder file = bodyFile();
  file.document["skins"][0].erase("inverseBindMatrices");
  file.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
      file.floats({0, 0, 0, 1, 0, 0, 0, -0.5f, 0}, "VEC3");
  const LogLevel before = logLevel();
  setLogLevel(LogLevel::quiet);
  const Body body = bodyOf(file);
  setLogLevel(before);
  CHECK(near(vec3(body.skeleton.joints[0].restWorld[3]), {0, 1, 0}));
  CHECK(near(vec3(body.skeleton.joints[1].restWorld[3]), {0, 0.5f, 0}));
  CHECK(near(atRest(body)[1], {1, 1, 0}));
  CHECK(near(atRest(body)[2], {0, 0, 0}));
  CHECK(
      near(posed(body, body.meshes[0], samplePose(body.skeleton, body.clips[0], 0.2f))[2], {0.5f, 0.5f, 0}));
}

TEST_CASE("a mesh without a skin follows the joint it hangs on; one that hangs on nothing is left out") {
  const LogLevel before = logLevel();
  setLogLevel(LogLevel::quiet);
  GltfBuilder file = bodyFile();
  const int positions = file.floats({0, 0, 0, 0, 0, 1, 0, -0.5f, 0}, "VEC3");
  file.add("meshes", {{"name", "shoe"}, {"primitives", {{{"attributes", {{"POSITION", positions}}}}}}});
  file.document["nodes"][1]["children"] = {3};
  file.add("nodes", {{"name", "foot"}, {"mesh", 1}, {"translation", {0, -0.5, 0}}});
  file.add("nodes", {{"name", "floor"}, {"mesh", 1}});
  const Body body = bodyOf(file);
  CHECK(body.skeleton.joints.size() == 2);
  REQUIRE(body.meshes.size() == 2);
  CHECK(body.meshes[1].name == "shoe");
  CHECK(near(atRest(body, 1)[0], {0, 0, 0}));
  const auto bent = posed(body, body.meshes[1], samplePose(body.skeleton, body.clips[0], 0.2f));
  CHECK(near(bent[0], {0.5f, 0.5f, 0}));
  CHECK(near(bent[2], {1, 0.5f, 0}));
  setLogLevel(before);
}

TEST_CASE("skinned elements are given in the rest pose, which is the one they are bound in") {
  GltfBuilder file = bodyFile();
  file.document["nodes"][1]["translation"] = {0, -0.75, 0};
  file.document["nodes"][2]["translation"] = {100, 0, 0};  // of a skinned node: counts for nothing
  const TemporaryFolder folder;
  const auto elements = readGltfElements(writeBytes(folder.path() / "a.glb", file.glb()));
  REQUIRE(elements.ok());
  CHECK(near((*elements)[0].mesh.positions[0], {0, 1, 0}));
  CHECK(near((*elements)[0].mesh.positions[2], {0, 0, 0}));
}

TEST_CASE("VRM's table names the joints, in both of its versions; what is no table is passed over") {
  const auto names = [](const nlohmann::json& extensions) {
    GltfBuilder file = bodyFile();
    file.document["extensions"] = extensions;
    const Body body = bodyOf(file);
    return body.skeleton.joints[0].name + " " + body.skeleton.joints[1].name;
  };
  CHECK(names({{"VRM",
                {{"humanoid",
                  {{"humanBones",
                    {{{"bone", "hips"}, {"node", 0}}, {{"bone", "leftLowerLeg"}, {"node", 1}}}}}}}}}) ==
        "hips leftLowerLeg");
  CHECK(names({{"VRMC_vrm",
                {{"humanoid",
                  {{"humanBones", {{"hips", {{"node", 0}}}, {"leftLowerLeg", {{"node", 1}}}}}}}}}}) ==
        "hips leftLowerLeg");
  CHECK(names({{"VRM",
                {{"humanoid", {{"humanBones", {{{"bone", "hips"}, {"node", 99}}, {{"bone", 3}}, 7}}}}}}}) ==
        "hip knee");
}

TEST_CASE("what is no body is refused") {
  const TemporaryFolder folder;
  const auto refusal = [&](GltfBuilder file) {
    const auto body = readBody(writeBytes(folder.path() / "a.glb", file.glb()));
    return body ? std::string("accepted") : body.error().message;
  };
  CHECK(refusal(triangleFile()).find("/skins: a body needs a skeleton, and the file has no skin") !=
        std::string::npos);
  GltfBuilder sheared = bodyFile();
  sheared.document["nodes"][0].erase("translation");
  sheared.document["nodes"][0]["matrix"] = {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  CHECK(refusal(sheared).find("/nodes/0/matrix: the matrix of a joint must be") != std::string::npos);
  GltfBuilder huge = bodyFile();
  huge.document["nodes"][0]["scale"] = {1e30, 1e30, 1e30};
  CHECK(refusal(huge).find("range of numbers") != std::string::npos);
  GltfBuilder flat = bodyFile();
  flat.document["nodes"][1]["scale"] = {1, 0, 1};
  CHECK(refusal(flat).find("/nodes/1: the joint's scale is 0 at rest") != std::string::npos);
}

TEST_CASE("rigid pieces that hang on one another as a person's limbs are a body; others are not") {
  const TemporaryFolder folder;
  for (const bool apart : {true, false}) {  // false: the groups of an atlas
    GltfBuilder file = triangleFile();
    file.document["nodes"] = json::array();
    const std::size_t pieces = addPersonPieces(file, apart);
    // Each holds a mesh at its own place.
    for (std::size_t node = 0; node < pieces; ++node) {
      file.document["nodes"][node]["children"].push_back(file.document["nodes"].size());
      file.add("nodes", {{"mesh", 0}, {"scale", {0.1, 0.1, 0.1}}});
    }
    file.document["scenes"][0]["nodes"] = {0};
    const auto path = writeBytes(folder.path() / "pieces.glb", file.glb());
    const auto counted = countGltf(path);
    if (!counted.ok()) FAIL(counted.error().message);
    CHECK(counted->body == apart);
    const auto body = readBody(path);
    CHECK(body.ok() == apart);
    if (!apart || !body.ok()) continue;
    CHECK(body->skeleton.joints.size() == pieces);
    std::size_t vertices = 0;
    for (const SkinnedMesh& mesh : body->meshes) vertices += mesh.mesh.positions.size();
    CHECK(vertices == 3 * pieces);
    file.document["nodes"][4].erase("translation");
    file.document["nodes"][4]["matrix"] = {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0.3, 0, 0, 1};
    const auto sheared = readBody(writeBytes(folder.path() / "sheared.glb", file.glb()));
    REQUIRE(!sheared.ok());
    CHECK(sheared.error().message.find("/nodes/4/matrix: the matrix of a joint must be") !=
          std::string::npos);
  }
}

TEST_CASE("a clip's rate is that of its keys, up to 240 a second") {
  const auto rateOf = [](double rate) {
    std::vector<float> times;
    for (int i = 0; i < 3 * rate; ++i) times.push_back(float(double(i) / rate));
    return gltf::framesPerSecondOf(times);
  };
  for (const int rate : {10, 24, 25, 30, 50, 60, 100, 120, 240}) CHECK(rateOf(rate) == float(rate));
  for (const int rate : {5, 500}) CHECK(rateOf(rate) == 30);
  CHECK(rateOf(30'000 / 1001.0) == doctest::Approx(29.97003f));
}
