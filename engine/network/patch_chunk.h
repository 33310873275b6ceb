#pragma once
#include <span>

#include "network/file_bytes.h"
#include "network/fork_patch.h"

namespace vasa {

/// What the chunk PTCH holds (network/file.h). Positions move by at most half a step of 2^-22 m, or of a
/// 65,535th of the patch where that is more.
PortableWriter patchPayload(std::span<const ForkPatch> patches);

/// @return false where the chunk is malformed. Whether the patches make sense is asked later (patchFault).
bool readPatches(std::span<const std::byte> payload, std::vector<ForkPatch>& patches);

}  // namespace vasa
