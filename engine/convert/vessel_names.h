#pragma once
#include <string_view>

namespace vasa {

/// Whether two vessels' names agree on the side and share a word that tells ("right common carotid artery",
/// "right internal carotid artery": carotid). Words that any vessel may have (artery, branch, common ...) do
/// not tell. Names without a side continue their like only.
bool namesContinue(std::string_view a, std::string_view b);

/// Which side of the heart a vessel's name puts it on, where it says so: the aorta's tree or the pulmonary
/// one.
enum class Circuit { unknown, systemic, pulmonary };
Circuit circuitOf(std::string_view name);

}  // namespace vasa
