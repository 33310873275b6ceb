#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "convert/no_vessel.h"
#include "mesh/mesh_element.h"
#include "network/network.h"

namespace vasa {

/// One element of the input with what is known about it.
struct SourceElement {
  MeshElement element;
  VesselKind kind = VesselKind::other;
  std::string label;     ///< the vessel's name: the element's without its leading catalogue number
  bool byLumen = false;  ///< the outside of its wall is left out
  NoVessel noVessel = NoVessel::none;  ///< what its name says that it is instead
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

/// "FJ1654M left anterior cerebral artery" -> "left anterior cerebral artery"; other names stay as they are.
std::string vesselLabel(std::string_view elementName);

/// Vessels join their like only: arteries arteries, and veins veins, portal or not.
bool sameFamily(VesselKind a, VesselKind b);

/// Labels and kinds for the elements of one file. An element of which nothing tells the kind but materials,
/// and these say both artery and vein, is divided by them; what of it hangs together with neither is a part
/// of no known kind.
std::vector<SourceElement> describeElements(std::vector<MeshElement> elements, std::string_view fileName);

/// Of each element why it is no vessel; leaveOutNoVessels() takes those out. All none where no element would
/// be left.
std::vector<NoVessel> noVessels(const std::vector<SourceElement>& sources);

/// An element that is no vessel.
struct LeftOut {
  std::string name;
  NoVessel why;
};

/// Takes out what is no vessel by its name, where there is something else: of a whole body that was segmented
/// the vessels alone; and what no name tells, is wider than any vessel and holds most of those that names
/// tell.
std::vector<LeftOut> leaveOutNoVessels(std::vector<SourceElement>& sources);

}  // namespace vasa
