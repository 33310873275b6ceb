#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh_element.h"
#include "network/network.h"

namespace vasa {

/// One element of the input with what is known about it.
struct SourceElement {
  MeshElement element;
  VesselKind kind = VesselKind::other;
  std::string label;      ///< the vessel's name: the element's without its leading catalogue number
  bool byLumen = false;   ///< the outside of its wall is left out
  bool noVessel = false;  ///< its name says an organ, a bone or a finding
};

/// The kind of vessel: by what the file says of the element, else by an ontology's number (FMA, UBERON) of a
/// great vessel, else by words in the element's own name (aorta, vena cava, sinus ...; names of others are
/// divided at marks, capitals and numbers), else by the file's name ("bp3d_arteries.glb"), else by what it
/// belongs to (its mesh, the nodes above it, its materials), else by its colour: red an artery, blue a vein.
/// A vein whose name says "portal" is a portal vein. `other` where nothing tells.
VesselKind kindOf(const MeshElement& element, std::string_view fileName);

/// What texts say of an element: its category, its name and number, the file's name, what it belongs to
/// without its materials; and what a material says.
VesselKind kindOfTexts(const MeshElement& element, std::string_view fileName);
VesselKind kindOf(const MeshMaterial& material);

/// Whether an element's name says something else in a body than a vessel, in English (kidney_left, rib 4,
/// thrombus), and no text or number tells of a vessel.
bool namesNoVessel(const MeshElement& element, std::string_view fileName);

/// "FJ1654M left anterior cerebral artery" -> "left anterior cerebral artery"; other names stay as they are.
std::string vesselLabel(std::string_view elementName);

/// Vessels join their like only: arteries arteries, and veins veins, portal or not.
bool sameFamily(VesselKind a, VesselKind b);

/// Labels and kinds for the elements of one file. An element of which nothing tells the kind but materials,
/// and these say both artery and vein, is divided by them; what of it hangs together with neither is a part
/// of no known kind.
std::vector<SourceElement> describeElements(std::vector<MeshElement> elements, std::string_view fileName);

/// Which elements are no vessels: leaveOutNoVessels() takes them out. None where all are.
std::vector<std::size_t> noVessels(const std::vector<SourceElement>& sources);

/// Takes out what is no vessel by its name, where there is something else: of a whole body that was segmented
/// the vessels alone; and what no name tells, is wider than any vessel and holds most of those that names
/// tell.
/// @return the names of what was taken out
std::vector<std::string> leaveOutNoVessels(std::vector<SourceElement>& sources);

}  // namespace vasa
