#pragma once
#include <cstdint>
#include <string_view>

#include "mesh/mesh_element.h"

namespace vasa {

/// Why an element is no vessel: what its name says; the last two by its shape (convert/source.h,
/// convert/hollow.h).
enum class NoVessel : std::uint8_t { none, organ, heart, bone, tissue, finding, device, width, outerWall };

/// In a word or two: "organ", "device", "outside of a wall". Empty for none.
std::string_view reasonOf(NoVessel why);

/// What an element's name says in a body that is no vessel (kidney_left, rib 4, Leber), where no text or
/// number tells of a vessel. A device and a clot (stent, thrombus) are none whatever they lie in ("coronary
/// stent"), but by the file's own category.
NoVessel namesNoVessel(const MeshElement& element, std::string_view fileName);

}  // namespace vasa
