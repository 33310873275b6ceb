#include "body/doll.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace vasa::test {
namespace {

mat3 turnAbout(vec3 axis, float degrees) {
  return glm::mat3_cast(glm::angleAxis(degrees * kPi / 180, glm::normalize(axis)));
}

const DollPart& named(const std::string& part) {
  for (const DollPart& own : dollParts())
    if (own.part == part) return own;
  std::abort();
}

int indexOf(const std::string& part) { return int(&named(part) - dollParts().data()); }

bool has(const std::string& text, const char* word) { return text.find(word) != std::string::npos; }

// From the T pose's world to a frame's, a part's own turn.
mat3 performed(const std::string& part, int frame) {
  const float t = float(frame) / float(kDollFrames), swing = std::sin(2 * kPi * 2 * t);
  const bool left = part.starts_with("left");
  const float side = left ? 1.0f : -1.0f;
  const mat3 trunk = turnAbout({0, 1, 0}, 60 * t);  // turns as it goes
  const mat3 chest = trunk * turnAbout({1, 0, 0}, 12 * swing);
  if (part == "hips" || part == "spine") return trunk;
  if (has(part, "UpperLeg") || has(part, "LowerLeg") || has(part, "Foot") || has(part, "Toes")) {
    const mat3 thigh = trunk * turnAbout({1, 0, 0}, -25 * side * swing);
    return has(part, "UpperLeg") ? thigh : thigh * turnAbout({1, 0, 0}, 20 + 15 * side * swing);
  }
  const mat3 upper = chest * turnAbout({1, 0, 0}, 30 * side * swing) * turnAbout({0, 0, 1}, -75 * side);
  if (has(part, "UpperArm")) return upper;
  if (has(part, "LowerArm") || has(part, "Hand"))
    return upper * turnAbout({0, 1, 0}, -side * (35 + 20 * swing));
  return chest;
}

// The next joint's place less its own: the first child, or a tip's end.
vec3 boneOf(int part) {
  const auto& parts = dollParts();
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (parts[i].parent == part) return parts[i].place - parts[std::size_t(part)].place;
  return vec3(0);
}

// What takes the T pose's bone to the zero pose's.
mat3 zeroTurn(const std::string& part, DollDialect::Zero zero) {
  const float side = part.starts_with("left") ? 1.0f : -1.0f;
  const bool arm = has(part, "Arm") || has(part, "Hand");
  if (zero == DollDialect::Zero::a) return arm ? turnAbout({0, 0, 1}, -side * 45) : mat3(1);
  if (zero == DollDialect::Zero::i) return arm ? turnAbout({0, 0, 1}, -side * 88) : mat3(1);
  if (zero == DollDialect::Zero::toesHang)  // in the shins' line
    return has(part, "Foot") || has(part, "Toes") ? turnAbout({1, 0, 0}, 90) : mat3(1);
  if (zero == DollDialect::Zero::t || part == "hips" || part == "chest" || part.empty()) return mat3(1);
  const vec3 bone = glm::normalize(boneOf(indexOf(part)));  // along +Y, whatever it is
  const float cosine = bone.y;
  if (cosine > 0.9999f) return mat3(1);
  if (cosine < -0.9999f) return turnAbout({1, 0, 0}, 180);
  return turnAbout(glm::cross(bone, vec3(0, 1, 0)), std::acos(cosine) * 180 / kPi);
}

// From the hips to an ankle.
vec3 legOf(const std::string& side, int frame) {
  vec3 leg = performed("hips", frame) * (named(side + "UpperLeg").place - named("hips").place);
  for (const char* bone : {"UpperLeg", "LowerLeg"})
    leg += performed(side + bone, frame) * boneOf(indexOf(side + bone));
  return leg;
}

vec3 hipsPlace(const DollDialect& dialect, int frame) {
  if (!dialect.glides) return {0.02f * float(frame), 0.95f, 0.03f * float(frame)};
  vec3 place(0, 0.95f, 0);
  for (int before = 0; before < frame; ++before) {
    const std::string foot = legOf("left", before).y < legOf("right", before).y - 1e-3f ? "left" : "right";
    place += (1 - *dialect.glides) * (legOf(foot, before) - legOf(foot, before + 1));
  }
  return place;
}

const mat3 kLaysUp(vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, -1, 0));  // +Y -> +Z, +Z -> -Y

constexpr int kStill = -1;  // a joint that only goes along

struct Writer {
  const DollDialect& dialect;
  std::string text;
  std::vector<int> order;

  mat3 aside() const { return turnAbout({0, 1, 0}, dialect.facing); }
  vec3 inFile(vec3 p) const { return float(dialect.unitsAMetre) * (dialect.zUp ? kLaysUp * p : p); }
  void numbers(vec3 v) {
    for (int i = 0; i < 3; ++i) text.append(1, ' ').append(std::to_string(v[i]));
  }
  void sword(vec3 offset) {
    text += "JOINT joint_s" + std::to_string(order.size()) + "\n{\nOFFSET";
    numbers(inFile(offset));
    text += "\nCHANNELS 3 Zrotation Yrotation Xrotation\n";
    order.push_back(kStill);
  }
  void joint(int part) {
    const auto& parts = dollParts();
    const DollPart& own = parts[std::size_t(part)];
    const bool cut = has(own.part, "Hand") && dialect.arms != DollDialect::Arms::whole,
               end = own.part.empty() || cut;
    if (cut && dialect.arms == DollDialect::Arms::endAtElbow) return;
    if (end)
      text += "End Site\n{\nOFFSET";
    else
      text.append(own.parent < 0 ? "ROOT " : "JOINT ")
          .append(dollName(own.part, dialect.family))
          .append("\n{\nOFFSET"),
          order.push_back(part);
    const vec3 offset = own.parent < 0 ? vec3(0) : own.place - parts[std::size_t(own.parent)].place;
    const mat3 turn = own.parent < 0 ? mat3(1) : zeroTurn(parts[std::size_t(own.parent)].part, dialect.zero);
    numbers(inFile(aside() * turn * offset));
    text += "\n";
    if (!end)
      text += own.parent < 0 ? "CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n"
                             : "CHANNELS 3 Zrotation Yrotation Xrotation\n";
    const bool armed = dialect.sword && own.part == "rightHand";
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (parts[i].parent == part && !cut && !armed) joint(int(i));
    if (armed) sword(vec3(-0.1f, 0, 0)), sword(vec3(0, 0.9f, 0)), text += "}\n}\n";
    text += "}\n";
  }
};

}  // namespace

const std::vector<DollPart>& dollParts() {
  static const std::vector<DollPart> parts = [] {
    std::vector<DollPart> all{{"hips", -1, {0, 0.95f, 0}}, {"spine", 0, {0, 1.05f, 0}},
                              {"chest", 1, {0, 1.2f, 0}},  {"neck", 2, {0, 1.45f, 0}},
                              {"head", 3, {0, 1.55f, 0}},  {"", 4, {0, 1.75f, 0}}};
    for (const float side : {1.0f, -1.0f}) {
      const std::string name = side > 0 ? "left" : "right";
      const auto at = [&](float x, float y, float z) { return vec3(side * x, y, z); };
      const int base = int(all.size());
      for (const auto& [part, parent, place] :
           std::vector<DollPart>{{"Shoulder", 2, at(0.04f, 1.4f, 0)},
                                 {"UpperArm", base, at(0.18f, 1.4f, 0)},
                                 {"LowerArm", base + 1, at(0.46f, 1.4f, 0)},
                                 {"Hand", base + 2, at(0.71f, 1.4f, 0)},
                                 {"", base + 3, at(0.88f, 1.4f, 0)},
                                 {"UpperLeg", 0, at(0.09f, 0.9f, 0)},
                                 {"LowerLeg", base + 5, at(0.09f, 0.5f, 0)},
                                 {"Foot", base + 6, at(0.09f, 0.08f, 0)},
                                 {"Toes", base + 7, at(0.09f, 0.02f, 0.13f)},
                                 {"", base + 8, at(0.09f, 0.01f, 0.2f)}})
        all.push_back({part.empty() ? "" : name + part, parent, place});
    }
    return all;
  }();
  return parts;
}

std::string dollName(const std::string& part, const std::string& family) {
  static const std::vector<std::string> kWords{"hips",     "spine",    "chest",    "neck", "head",
                                               "Shoulder", "UpperArm", "LowerArm", "Hand", "UpperLeg",
                                               "LowerLeg", "Foot",     "Toes"};
  static const std::map<std::string, std::vector<std::string>> kNames{
      {"cmu",
       {"Hips", "LowerBack", "Spine", "Neck", "Head", "@Shoulder", "@Arm", "@ForeArm", "@Hand", "@UpLeg",
        "@Leg", "@Foot", "@ToeBase"}},
      {"biovision",
       {"Hips", "Chest", "Chest2", "Neck", "Head", "@Collar", "@Shoulder", "@Elbow", "@Wrist", "@Hip",
        "@Knee", "@Ankle", "@Toe"}},
      {"mixamo",
       {"mixamorig:Hips", "mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Neck", "mixamorig:Head",
        "mixamorig:@Shoulder", "mixamorig:@Arm", "mixamorig:@ForeArm", "mixamorig:@Hand", "mixamorig:@UpLeg",
        "mixamorig:@Leg", "mixamorig:@Foot", "mixamorig:@ToeBase"}},
      {"makehuman",
       {"root", "spine05", "spine03", "neck01", "head", "clavicle.$", "upperarm01.$", "lowerarm01.$",
        "wrist.$", "upperleg01.$", "lowerleg01.$", "foot.$", "toe1-1.$"}},
      {"bip",
       {"Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine1", "Bip01 Neck", "Bip01 Head", "Bip01 $ Clavicle",
        "Bip01 $ UpperArm", "Bip01 $ Forearm", "Bip01 $ Hand", "Bip01 $ Thigh", "Bip01 $ Calf",
        "Bip01 $ Foot", "Bip01 $ Toe0"}},
      {"daz",
       {"hip", "abdomen", "chest", "neck", "head", "%Collar", "%Shldr", "%ForeArm", "%Hand", "%Thigh",
        "%Shin", "%Foot", "%Toe"}},
      {"smpl",
       {"Pelvis", "Spine1", "Spine2", "Neck", "Head", "$_Collar", "$_Shoulder", "$_Elbow", "$_Wrist", "$_Hip",
        "$_Knee", "$_Ankle", "$_Foot"}},
      {"asf",
       {"root", "lowerback", "thorax", "lowerneck", "head", "*clavicle", "*humerus", "*radius", "*wrist",
        "*femur", "*tibia", "*foot", "*toes"}},
      {"motive",
       {"Hip", "Ab", "Chest", "Neck", "Head", "$Shoulder", "$UArm", "$FArm", "$Hand", "$Thigh", "$Shin",
        "$Foot", "$Toe"}},
      {"kinect",
       {"SpineBase", "SpineMid", "SpineShoulder", "Neck", "Head", "Clavicle@", "Shoulder@", "Elbow@",
        "Wrist@", "Hip@", "Knee@", "Ankle@", "Foot@"}},
      {"rigify",
       {"DEF-spine", "DEF-spine.001", "DEF-spine.003", "DEF-spine.004", "DEF-spine.006", "DEF-shoulder.$",
        "DEF-upper_arm.$", "DEF-forearm.$", "DEF-hand.$", "DEF-thigh.$", "DEF-shin.$", "DEF-foot.$",
        "DEF-toe.$"}},
      {"prefixed",
       {"Character1_HIPS", "Character1_SPINE", "Character1_SPINE1", "Character1_NECK", "Character1_HEAD",
        "Character1_@_SHOULDER", "Character1_@_ARM", "Character1_@_FOREARM", "Character1_@_HAND",
        "Character1_@_UPLEG", "Character1_@_LEG", "Character1_@_FOOT", "Character1_@_TOEBASE"}}};
  const bool left = part.starts_with("left"), right = part.starts_with("right");
  if (family == "numbered") return std::string("joint_").append(std::to_string(indexOf(part)));
  if (family == "vrm") return part;
  const std::string word = left ? part.substr(4) : right ? part.substr(5) : part;
  std::string name;
  for (const char c : kNames.at(family)[std::size_t(std::ranges::find(kWords, word) - kWords.begin())])
    if (c == '@')
      name += left ? "Left" : "Right";
    else if (c == '$')
      name += left ? "L" : "R";
    else if (c == '%' || c == '*')
      name += left ? "l" : "r";
    else
      name += c;
  return name;
}

vec3 dollDirection(const std::string& part, int frame) {
  return glm::normalize(performed(part, frame) * boneOf(indexOf(part)));
}

std::string dollMotion(const DollDialect& dialect, int frames) {
  Writer writer{dialect, "HIERARCHY\n", {}};
  writer.joint(0);
  writer.text.append("MOTION\nFrames: ").append(std::to_string(frames)).append("\nFrame Time: 0.033333\n");
  const auto& parts = dollParts();
  for (int frame = 0; frame < frames; ++frame) {
    const auto world = [&](int part) {
      const mat3 turn =
          performed(parts[std::size_t(part)].part, frame) *
          glm::transpose(writer.aside() * zeroTurn(parts[std::size_t(part)].part, dialect.zero));
      if (dialect.rootTurnsUp) return kLaysUp * turn;
      return dialect.zUp ? kLaysUp * turn * glm::transpose(kLaysUp) : turn;
    };
    for (const int part : writer.order) {
      if (part == kStill) {
        writer.numbers(vec3(0));
        continue;
      }
      const int parent = parts[std::size_t(part)].parent;
      if (parent < 0) {
        const vec3 place = float(dialect.rootTimes) * hipsPlace(dialect, frame);
        const vec3 told =
            dialect.rootTurnsUp ? float(dialect.unitsAMetre) * (kLaysUp * place) : writer.inFile(place);
        writer.numbers(told);
      }
      const mat3 local = parent < 0 ? world(part) : glm::transpose(world(parent)) * world(part);
      // local = Rz · Ry · Rx
      const float y = std::asin(std::clamp(-local[0][2], -1.0f, 1.0f));
      const bool locked = std::abs(std::cos(y)) < 1e-3f;  // turns about x and z are the same there
      const float z = locked ? std::atan2(-local[1][0], local[1][1]) : std::atan2(local[0][1], local[0][0]);
      writer.numbers(vec3(z, y, locked ? 0 : std::atan2(local[1][2], local[2][2])) * (180 / kPi));
    }
    writer.text += "\n";
  }
  return writer.text;
}

Body dollBody(const std::string& family) {
  Body body;
  body.name = "doll.glb";
  const auto& parts = dollParts();
  std::vector<vec3> places;
  std::vector<JointId> ids(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const int parent = parts[i].parent;
    const std::string above = parent < 0 ? "" : parts[std::size_t(parent)].part;
    const bool arm = has(above, "Arm") || has(above, "Hand");
    const mat3 turn = arm ? turnAbout({0, 0, 1}, above.starts_with("left") ? -40.0f : 40.0f) : mat3(1);
    places.push_back(parent < 0 ? parts[i].place
                                : places[std::size_t(parent)] +
                                      turn * (parts[i].place - parts[std::size_t(parent)].place));
    if (parts[i].part.empty()) continue;
    Skeleton::Joint joint;
    joint.name = dollName(parts[i].part, family);
    if (parent >= 0) joint.parent = ids[std::size_t(parent)];
    joint.rest.translation = places[i] - (parent < 0 ? vec3(0) : places[std::size_t(parent)]);
    joint.restWorld = glm::translate(mat4(1), places[i]);
    joint.inverseBind = glm::inverse(joint.restWorld);
    ids[i] = {std::uint32_t(body.skeleton.joints.size())};
    body.skeleton.joints.push_back(joint);
  }
  return body;
}

}  // namespace vasa::test
