#pragma once
#include "body/body.h"
#include "make_human/bone_form.h"
#include "network/network.h"

namespace vasa::human {

/// Organs as their tables say, without grooves; of pairs the left one.
Result<std::vector<BoneForm>> readOrganForms(const std::filesystem::path& tables, const Rig& rig);

/// The organs of organs.csv (a row an organ: its colour, the joints that move it, the vessels that lie in
/// grooves of it) and organ_forms.csv (a row a piece), each a closed smooth mesh "organ: NAME"; of pairs both
/// sides in one. A groove follows its vessel as it lies, so that a table of vessels may change without one of
/// organs. Parallel over organs, the same for any number of threads.
/// @param forms  as readOrganForms() gives them
Result<std::vector<SkinnedMesh>> makeOrgans(const std::filesystem::path& tables, std::vector<BoneForm> forms,
                                            const Rig& rig, const Network& vessels);

}  // namespace vasa::human
