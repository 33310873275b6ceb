#include "convert/name_text.h"

#include <algorithm>
#include <array>

#include "core/name_words.h"

namespace vasa {

NameText::NameText(std::string_view name) : raw(name), words(" ") {
  for (const std::string& word : nameWords(name)) words += word + ' ';
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
