#include "body/humanoid.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>

#include "body/humanoid_words.h"
#include "core/ids.h"

namespace vasa {
namespace {

constexpr std::size_t kFamilies = 7;
constexpr std::array<std::string_view, kFamilies> kFamilyNames{"cmu", "mixamo", "makehuman game", "makehuman",
                                                               "vrm", "vroid",  "biovision"};
constexpr int kLeastKnown = 8;

// A row for each part of the body, a column for each family. @ stands for the side: "left" or "l" as the
// column's names have it.
struct Row {
  std::string_view part;
  std::array<std::string_view, kFamilies> names;
};
constexpr Row kMiddle[] = {
    {"hips", {"hips", "hips", "pelvis", "root", "hips", "jbipchips", "hips"}},
    {"spine", {"lowerback", "spine", "spine01", "spine05", "spine", "jbipcspine", "chest"}},
    {"chest", {"spine", "spine1", "spine02", "spine03", "chest", "jbipcchest", "chest2"}},
    {"upperChest", {"spine1", "spine2", "spine03", "spine01", "upperchest", "jbipcupperchest", "chest3"}},
    {"neck", {"neck", "neck", "neck01", "neck01", "neck", "jbipcneck", "neck"}},
    {"head", {"head", "head", "head", "head", "head", "jbipchead", "head"}},
};
constexpr Row kSide[] = {
    {"Shoulder",
     {"@shoulder", "@shoulder", "clavicle@", "clavicle@", "@shoulder", "jbip@shoulder", "@collar"}},
    {"UpperArm", {"@arm", "@arm", "upperarm@", "upperarm01@", "@upperarm", "jbip@upperarm", "@shoulder"}},
    {"LowerArm",
     {"@forearm", "@forearm", "lowerarm@", "lowerarm01@", "@lowerarm", "jbip@lowerarm", "@elbow"}},
    {"Hand", {"@hand", "@hand", "hand@", "wrist@", "@hand", "jbip@hand", "@wrist"}},
    {"UpperLeg", {"@upleg", "@upleg", "thigh@", "upperleg01@", "@upperleg", "jbip@upperleg", "@hip"}},
    {"LowerLeg", {"@leg", "@leg", "calf@", "lowerleg01@", "@lowerleg", "jbip@lowerleg", "@knee"}},
    {"Foot", {"@foot", "@foot", "foot@", "foot@", "@foot", "jbip@foot", "@ankle"}},
    {"Toes", {"@toebase", "@toebase", "ball@", "toe11@", "@toes", "jbip@toebase", "@toe"}},
    {"ThumbProximal",
     {"#thumb", "@handthumb1", "thumb01@", "finger11@", "@thumbproximal", "jbip@thumb1", "@thumb"}},
    {"IndexProximal",
     {"@handindex1", "@handindex1", "index01@", "finger21@", "@indexproximal", "jbip@index1", "@index"}},
    {"MiddleProximal",
     {"@fingerbase", "@handmiddle1", "middle01@", "finger31@", "@middleproximal", "jbip@middle1", "@middle"}},
};
// Whether a family writes sides out.
constexpr std::array<bool, kFamilies> kWholeSides{true, true, false, false, true, false, true};

std::string withSide(std::string_view pattern, bool left, bool whole) {
  std::string name;
  for (const char c : pattern) {
    if (c == '@')
      name += whole ? (left ? "left" : "right") : (left ? "l" : "r");
    else if (c == '#')
      name += left ? "l" : "r";
    else
      name += c;
  }
  return name;
}

// The parts' names with sides, as string_views that live for ever.
struct Part {
  std::string name;
  std::array<std::string, kFamilies> joints;
};
const std::vector<Part>& parts() {
  static const std::vector<Part> list = [] {
    std::vector<Part> all;
    for (const Row& row : kMiddle) {
      Part part{std::string(row.part), {}};
      for (std::size_t f = 0; f < kFamilies; ++f) part.joints[f] = row.names[f];
      all.push_back(std::move(part));
    }
    for (const bool left : {true, false})
      for (const Row& row : kSide) {
        Part part{(left ? "left" : "right") + std::string(row.part), {}};
        for (std::size_t f = 0; f < kFamilies; ++f)
          part.joints[f] = withSide(row.names[f], left, kWholeSides[f]);
        all.push_back(std::move(part));
      }
    return all;
  }();
  return list;
}

}  // namespace

std::string_view humanoidPart(std::string_view name) {
  const auto found = std::ranges::find(parts(), name, &Part::name);
  return found == parts().end() ? std::string_view{} : std::string_view(found->name);
}

std::uint32_t partNamed(std::span<const std::string_view> parts, std::string_view part) {
  const auto found = std::ranges::find(parts, part);
  return found == parts.end() ? kNone : std::uint32_t(found - parts.begin());
}

void nameSpine(std::span<const std::uint32_t> joints, std::span<std::string_view> parts) {
  if (joints.empty()) return;
  parts[joints.front()] = humanoidPart("spine");
  if (joints.size() > 2) parts[joints[joints.size() / 2]] = humanoidPart("chest");
  if (joints.size() > 1) parts[joints.back()] = humanoidPart(joints.size() > 2 ? "upperChest" : "chest");
}

int humanoidKeys(std::span<const std::string_view> of) {
  constexpr std::array<std::string_view, 6> kLimbs{"UpperArm", "LowerArm", "Hand",
                                                   "UpperLeg", "LowerLeg", "Foot"};
  const auto has = [&](std::string_view part) { return std::ranges::find(of, part) != of.end(); };
  int count = int(has("hips")) + int(has("neck") || has("head"));
  for (const std::string side : {"left", "right"})
    for (const std::string_view limb : kLimbs) count += has(side + std::string(limb));
  return count;
}

std::string plainName(std::string_view name) {
  if (const std::size_t colon = name.rfind(':'); colon != name.npos) name.remove_prefix(colon + 1);
  std::string plain;
  for (const unsigned char c : name)
    if (std::isalnum(c)) plain += char(std::tolower(c));
  constexpr std::string_view kPrefix = "mixamorig";
  if (plain.starts_with(kPrefix)) plain.erase(0, kPrefix.size());
  return plain;
}

HumanoidNames humanoidNames(const std::vector<std::string>& joints) {
  std::vector<std::string> plain;
  for (const std::string& joint : joints) plain.push_back(plainName(joint));
  HumanoidNames best{{}, std::vector<std::string_view>(joints.size())};
  int most = kLeastKnown - 1;
  for (std::size_t f = 0; f < kFamilies; ++f) {
    std::vector<std::string_view> known(joints.size());
    int count = 0;
    for (const Part& part : parts()) {
      const auto found = std::ranges::find(plain, part.joints[f]);
      if (found == plain.end()) continue;
      known[std::size_t(found - plain.begin())] = part.name;
      ++count;
    }
    if (count <= most) continue;
    most = count;
    best = {kFamilyNames[f], std::move(known)};
  }
  // A convention that knows less of the limbs than plain words do is not the one.
  if (auto words = humanoidWords(joints);
      humanoidKeys(words) > std::max(humanoidKeys(best.of), kLeastKnown - 1))
    best = {"words", std::move(words)};
  return best;
}

}  // namespace vasa
