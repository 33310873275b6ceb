#pragma once
#include "gpu/timer.h"
#include "render/renderer.h"

// What of a frame is timed, by the device's clock.
namespace vasa::stage {

constexpr const char* kTessellate = "tessellate";
constexpr const char* kForks = "forks";
constexpr const char* kDraw = "draw tubes";
constexpr const char* kCapillaries = "capillaries";
constexpr const char* kMeshes = "meshes";
constexpr std::uint32_t kScopes = 7, kScopesOfRound = 3;  ///< at most

/// What the timer measured of what was submitted last, on top of what a frame took so far.
void addTo(FrameTimes& times, gpu::GpuTimer& timer);

}  // namespace vasa::stage
