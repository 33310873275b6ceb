#pragma once
#include <filesystem>
#include <vector>

#include "avoid/solver.h"
#include "body/clip.h"
#include "core/result.h"

namespace vasa {

struct FrameOptions;
struct Scene;

/// The corrections of a clip's frames, from the first as far as they were solved: with them a frame costs no
/// more than its pose, and one process can solve a motion for many.
struct MotionTrack {
  const Clip* clip = nullptr;
  std::vector<Correction> frames;
};

/// What a track depends on: vessels, body, the clip's poses and the options that change a frame. Tracks with
/// another key belong to another motion.
std::uint64_t trackKey(const Scene& scene, const Clip& clip, const FrameOptions& options);

/// Writes a track whole or not at all: what moves, exactly, a frame after the other, and a hash. 16 bytes for
/// each of a frame's moved points and nodes.
Result<void> writeTrack(const std::filesystem::path& path, const MotionTrack& track, std::uint64_t key);

/// Reads a track. Fails with badInput where it is damaged, and with resumeMismatch where it belongs to
/// another motion.
/// @param key  trackKey() of what it is wanted for
Result<MotionTrack> readTrack(const std::filesystem::path& path, const Scene& scene, const Clip& clip,
                              std::uint64_t key);

}  // namespace vasa
