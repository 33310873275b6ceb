#pragma once
#include "body/clip.h"
#include "make_human/rig.h"

namespace vasa::human {

/// The motions of clips.csv, their key poses (clip_keys.csv) joined by smooth curves, with what moves along
/// (couplings.csv), sampled at 30 frames a second into linear keys; the root's height follows from the soles.
Result<std::vector<Clip>> makeClips(const std::filesystem::path& clips, const std::filesystem::path& keys,
                                    const std::filesystem::path& couplings, const Rig& rig);

}  // namespace vasa::human
