#pragma once
#include <string>
#include <string_view>

namespace vasa {

/// A name as a file has it, and its words (core/name_words.h) with a blank around each.
struct NameText {
  std::string_view raw;
  std::string words;

  explicit NameText(std::string_view name);
};

/// Whether a name has one of a list's entries, which commas divide: words in small letters and without
/// accents, found whole ("spinal cord"), with a * where letters may stand before or go on ("muscle*",
/// "*schlagader*"). What is in no Latin letters is found as it is written, wherever it stands.
bool saysAny(const NameText& name, std::string_view list);

/// Anatomists' short form at a name's beginning, before a word that is Latin by its ending where no blank
/// stands between: "A. femoralis", "Vv. hepaticae", "v_femoralis".
/// @return a, aa, v, vv, m, n ...; empty where it begins with none. Of `name`.
std::string_view shortForm(const NameText& name);

}  // namespace vasa
