#pragma once
#include <vector>

#include "body/clip.h"
#include "io/gltf_asset.h"

namespace vasa::gltf {

/// The file's animations as far as they move joints. Those that move none are left out, and so are those
/// whose keys break a rule, have no data, or last for more than a million frames; both is told.
/// @param jointOfNode  one a node; channels of nodes without a joint are ignored
std::vector<Clip> readClips(const Asset& asset, const std::vector<JointId>& jointOfNode);

/// The rate of regular keys, rounded to a whole number where that is within 0.5 %; 30 where keys are
/// irregular, fewer than three, or outside 10 to 240 a second. @param times  increasing [s]
float framesPerSecondOf(const std::vector<float>& times);

/// Clips pose what they do not move as the file's nodes do: where that is not the rest pose, it becomes a
/// key.
/// @param filePose  one a joint of the file
void holdFilePose(std::vector<Clip>& clips, const Skeleton& skeleton,
                  const std::vector<JointTransform>& filePose);

}  // namespace vasa::gltf
