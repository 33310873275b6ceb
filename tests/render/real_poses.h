#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "network/network.h"

namespace vasa::test {

/// A real body's vessels in some moments of its motions.
struct RealPoses {
  struct Pose {
    std::string clip;     ///< empty: at rest
    bool middle = false;  ///< of its clip
    std::vector<vec4> points;
    std::vector<quat> knotFrames;
  };
  Network network;
  std::vector<Pose> poses;
};

/// Converts and binds the arteries and veins below `data`: rest, and `steps` + 1 moments of each clip.
/// @param steps  even
Result<RealPoses> realPoses(const std::filesystem::path& data, const std::vector<std::string>& clips,
                            int steps);

}  // namespace vasa::test
