#include "body/humanoid_words.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "body/humanoid.h"
#include "core/name_words.h"

namespace vasa {
namespace {

enum class Side { none, left, right };

struct Words {
  std::string base;  // what is left of the name: letters without side, numbers and words that say nothing
  Side side = Side::none;
  bool passedOver = false;
};

template <std::size_t N>
bool isAny(std::string_view word, const std::array<std::string_view, N>& of) {
  return std::ranges::find(of, word) != of.end();
}

constexpr std::array<std::string_view, 17> kSilent{
    "joint",     "jnt",      "bone",     "jt",  "bip", "def", "org", "character", "robot",
    "mixamorig", "skeleton", "armature", "rig", "b",   "j",   "bn",  "m"};
constexpr std::array<std::string_view, 22> kPassedOver{
    "twist",    "roll",   "ik",       "end",    "nub",    "target",     "pole", "ctrl",
    "effector", "site",   "helper",   "socket", "muscle", "metacarpal", "eye",  "jaw",
    "tongue",   "breast", "pectoral", "prop",   "hair",   "cloth"};

Words wordsOf(std::string_view name) {
  if (const std::size_t mark = name.find_last_of(":|"); mark != name.npos && mark + 1 < name.size())
    name.remove_prefix(mark + 1);
  Words words;
  for (std::string word : nameWords(name)) {
    if (std::isdigit(static_cast<unsigned char>(word[0])) || isAny(word, kSilent)) continue;
    if (isAny(word, kPassedOver)) words.passedOver = true;
    for (const auto& [begin, side] :
         {std::pair<std::string_view, Side>{"left", Side::left}, {"right", Side::right}})
      if (word.starts_with(begin)) words.side = side, word.erase(0, begin.size());
    if (words.side == Side::none && (word == "l" || word == "lft")) words.side = Side::left, word.clear();
    if (words.side == Side::none && (word == "r" || word == "rgt")) words.side = Side::right, word.clear();
    // "LUArm": the side and the first letter of upper or fore.
    if (words.side == Side::none && (word == "lu" || word == "lf" || word == "ru" || word == "rf"))
      words.side = word[0] == 'l' ? Side::left : Side::right, word.erase(0, 1);
    words.base += word;
  }
  return words;
}

// The words for a part, best first.
struct Meaning {
  std::string_view part;
  std::vector<std::string_view> words;
};
const std::vector<Meaning>& middle() {
  static const std::vector<Meaning> list{
      {"hips", {"hips", "pelvis", "hip", "hipcenter", "spinebase", "root"}},
      {"neck", {"neck", "necklower", "lowerneck", "cervical"}},
      {"head", {"head", "skull"}}};
  return list;
}
const std::vector<Meaning>& sided() {
  // A limb's lower parts before its upper ones, these before the collar: a word goes to the first that takes
  // it.
  static const std::vector<Meaning> list{
      {"LowerArm",
       {"forearm", "lowerarm", "farm", "lowarm", "loarm", "armlower", "elbow", "forearmbend", "ulna",
        "radius"}},
      {"Hand", {"hand", "wrist", "palm"}},
      {"UpperArm",
       {"upperarm", "uarm", "uparm", "armupper", "humerus", "shldr", "shldrbend", "arm", "shoulder"}},
      {"Shoulder", {"collar", "clavicle", "clav", "scapula", "shoulder", "innershoulder"}},
      {"UpperLeg", {"thigh", "upperleg", "upleg", "legupper", "femur", "thighbend", "hip", "leg"}},
      {"LowerLeg", {"calf", "shin", "lowerleg", "lowleg", "loleg", "leglower", "knee", "tibia", "leg"}},
      {"Foot", {"ankle", "foot", "talus"}},
      {"Toes", {"toebase", "toes", "toe", "ball", "foot"}},
      {"ThumbProximal", {"thumb", "handthumb", "thumbproximal"}},
      {"IndexProximal", {"index", "handindex", "inhandindex", "indexproximal"}},
      {"MiddleProximal", {"middle", "handmiddle", "inhandmiddle", "middleproximal"}}};
  return list;
}
constexpr std::array<std::string_view, 16> kSpine{
    "spine",     "torso",     "abdomen",      "waist",        "chest",      "upperchest", "thorax", "back",
    "lowerback", "upperback", "abdomenlower", "abdomenupper", "chestlower", "chestupper", "ribs",   "lumbar"};

}  // namespace

std::vector<std::string_view> humanoidWords(std::span<const std::string> joints) {
  std::vector<Words> words;
  for (const std::string& joint : joints) {
    words.push_back(wordsOf(joint));
    // "lfemur": small letters throughout.
    Words& own = words.back();
    if (own.side != Side::none || own.base.size() < 3 || (own.base[0] != 'l' && own.base[0] != 'r')) continue;
    const std::string_view rest = std::string_view(own.base).substr(1);
    if (std::ranges::none_of(sided(), [&](const Meaning& meaning) {
          return std::ranges::find(meaning.words, rest) != meaning.words.end();
        }))
      continue;
    own.side = own.base[0] == 'l' ? Side::left : Side::right;
    own.base.erase(0, 1);
  }
  std::vector<std::string_view> parts(joints.size());
  const auto find = [&](std::string_view base, Side side) {
    for (std::size_t j = 0; j < words.size(); ++j)
      if (parts[j].empty() && !words[j].passedOver && words[j].side == side && words[j].base == base)
        return j;
    return words.size();
  };
  const auto take = [&](const Meaning& meaning, Side side, const std::string& name) {
    for (const std::string_view word : meaning.words)
      if (const std::size_t j = find(word, side); j < parts.size()) {
        parts[j] = humanoidPart(name);
        return;
      }
  };
  for (const Meaning& meaning : middle()) take(meaning, Side::none, std::string(meaning.part));
  for (const auto& [side, begin] : {std::pair{Side::left, "left"}, std::pair{Side::right, "right"}})
    for (const Meaning& meaning : sided()) take(meaning, side, begin + std::string(meaning.part));
  std::vector<std::uint32_t> spine;
  for (std::uint32_t j = 0; j < words.size(); ++j)
    if (parts[j].empty() && !words[j].passedOver && words[j].side == Side::none &&
        isAny(words[j].base, kSpine))
      spine.push_back(j);
  nameSpine(spine, parts);
  return parts;
}

}  // namespace vasa
