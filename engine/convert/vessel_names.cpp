#include "convert/vessel_names.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include "core/name_words.h"

namespace vasa {
namespace {

constexpr std::array<std::string_view, 44> kCommonWords{
    "artery",      "arteries", "arterial",  "vein",     "veins",     "venous",    "vena",   "branch",
    "branches",    "trunk",    "part",      "set",      "tributary", "division",  "arch",   "segment",
    "segmental",   "of",       "to",        "the",      "and",       "with",      "common", "internal",
    "external",    "proper",   "superior",  "inferior", "anterior",  "posterior", "medial", "lateral",
    "superficial", "deep",     "dorsal",    "ventral",  "upper",     "lower",     "middle", "first",
    "second",      "third",    "accessory", "terminal"};

struct NameWords {
  std::set<std::string> telling;
  bool left = false, right = false;
};

NameWords wordsOf(std::string_view name) {
  NameWords words;
  for (std::string& word : nameWords(name)) {
    const bool number = word[0] >= '0' && word[0] <= '9';
    if (word == "left")
      words.left = true;
    else if (word == "right")
      words.right = true;
    else if (word.size() > 2 && !number && std::ranges::find(kCommonWords, word) == kCommonWords.end())
      words.telling.insert(std::move(word));
  }
  return words;
}

}  // namespace

Circuit circuitOf(std::string_view name) {
  const NameWords words = wordsOf(name);
  if (words.telling.contains("pulmonary")) return Circuit::pulmonary;
  return words.telling.contains("aorta") || words.telling.contains("cava") ? Circuit::systemic
                                                                           : Circuit::unknown;
}

bool namesContinue(std::string_view a, std::string_view b) {
  const NameWords first = wordsOf(a), second = wordsOf(b);
  if (first.left != second.left || first.right != second.right) return false;
  // Of the many in "set of digital arteries" any might share a word.
  if (!first.left && !first.right) return a == b;
  return std::ranges::any_of(first.telling,
                             [&](const std::string& word) { return second.telling.contains(word); });
}

}  // namespace vasa
