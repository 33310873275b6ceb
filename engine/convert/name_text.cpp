#include "convert/name_text.h"

#include <algorithm>
#include <array>

#include "core/name_words.h"

namespace vasa {

namespace {

// Of words that files write without a mark between them: leftkidney, renalvein, venacava.
constexpr std::array<std::string_view, 5> kGluedBefore{"left", "right", "portal", "vena", "cava"};
constexpr std::array<std::string_view, 10> kGluedBehind{"left",    "right",  "vein",     "veins", "vessel",
                                                        "vessels", "artery", "arteries", "sinus", "cava"};
constexpr std::size_t kLeastGlued = 3;  // letters of the other word

std::string unglued(std::string_view word) {
  const auto leaves = [&](std::string_view part) { return word.size() >= part.size() + kLeastGlued; };
  for (const std::string_view part : kGluedBefore)
    if (word.starts_with(part) && leaves(part))
      return std::string(part) + ' ' + unglued(word.substr(part.size()));
  for (const std::string_view part : kGluedBehind)
    if (word.ends_with(part) && leaves(part))
      return unglued(word.substr(0, word.size() - part.size())) + ' ' + std::string(part);
  return std::string(word);
}

}  // namespace

NameText::NameText(std::string_view name) : raw(name), words(" ") {
  for (const std::string& word : nameWords(name)) words += unglued(word) + ' ';
}

bool saysAny(const NameText& name, std::string_view list) {
  const auto says = [&](std::string_view entry) {
    if (static_cast<unsigned char>(entry[0]) >= 0x80) return name.raw.find(entry) != name.raw.npos;
    const bool before = entry.starts_with('*'), after = entry.ends_with('*');
    entry.remove_prefix(before), entry.remove_suffix(after);
    for (std::size_t at = 0; (at = name.words.find(entry, at)) != name.words.npos; ++at)
      if ((before || name.words[at - 1] == ' ') && (after || name.words[at + entry.size()] == ' '))
        return true;
    return false;
  };
  for (std::size_t from = 0; from < list.size();) {
    const std::size_t end = std::min(list.find(", ", from), list.size());
    if (says(list.substr(from, end - from))) return true;
    from = end + 2;
  }
  return false;
}

std::string_view shortForm(const NameText& name) {
  const std::string_view raw = name.raw, words = name.words;
  const std::size_t end = raw.find_first_of("._");
  if (end == raw.npos || end == 0 || end > 2 || end + 1 >= raw.size() || words.size() < end + 3) return {};
  const std::string_view rest = words.substr(end + 2), next = rest.substr(0, rest.find(' '));
  static constexpr std::array<std::string_view, 10> kLatin{"alis", "aris", "otis", "ae",  "ica",
                                                           "aca",  "avia", "tea",  "ena", "cava"};
  const bool latin =
      std::ranges::any_of(kLatin, [&](std::string_view ending) { return next.ends_with(ending); });
  const bool spoken = raw[end] == '.' && raw[end + 1] == ' ';  // "V. jug. int."
  const bool word = next.size() >= (spoken ? 3 : 4) &&
                    std::ranges::all_of(next, [](char c) { return c >= 'a' && c <= 'z'; });
  return word && (latin || spoken) ? words.substr(1, end) : std::string_view{};
}

}  // namespace vasa
