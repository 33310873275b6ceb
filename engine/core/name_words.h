#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace vasa {

/// The words of a name that a program or a person gave to something, in small letters:
/// superior, vena, cava and 2 of "Superior_VenaCava2", l and hip of "LHip", artere of "Artère". Words end at
/// whatever is no letter or digit, between a small letter and a capital, before the last of several capitals
/// that a small letter follows, and between letters and digits. Letters of Latin-1 lose their accents,
/// whether these are part of them or follow as marks of their own (NFD); œ is e, the micro sign u. What UTF-8
/// has else divides words. O(name)
std::vector<std::string> nameWords(std::string_view name);

/// The side of the body that a name says: by the words left and right in English, Latin, German, French,
/// Spanish, Portuguese, Italian, Chinese and Japanese, or by l or r at its end (femoral.l, ICA_R,
/// vein.r.001). None where it says neither or both. O(name)
enum class NamedSide { none, left, right };
NamedSide sideNamed(std::string_view name);

}  // namespace vasa
