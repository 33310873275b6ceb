#pragma once
#include <span>
#include <string>

#include "core/image.h"
#include "core/result.h"
#include "network/measure_profile.h"

namespace vasa::plate {

/// Radius and area of the lumen over the way along it, one above the other, as a page of its own. Fails with
/// io where the font is not there.
/// @param stations  at least one, by rising `along` (network/measure_profile.h)
Result<Image> drawProfile(const std::string& title, std::span<const ProfileStation> stations);

/// A row a station, in millimetres.
std::string profileCsv(std::span<const ProfileStation> stations);

}  // namespace vasa::plate
