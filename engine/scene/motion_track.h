#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "avoid/solver.h"
#include "body/clip.h"
#include "core/result.h"

namespace vasa {

struct FrameOptions;
struct Scene;

/// Goes up whenever a frame comes out otherwise for the same input. What is kept of frames between runs bears
/// it.
constexpr int kMotionEdition = 13;

/// The corrections of a clip's frames, one after the other as far as they were solved: with them a frame
/// costs no more than its pose, and one process can solve a motion for many. Kept is what moves: 16 bytes for
/// each of a frame's moved points and nodes, 48 a frame.
class MotionTrack {
 public:
  /// Of what was solved. For a film that only goes on the latest two will do, and a track does not grow.
  enum class Keeps { all, latest };
  struct Moved {
    std::uint32_t variable;
    vec3 by;  ///< [m]
  };
  struct Narrowed {
    std::uint32_t point;
    float widest;  ///< [m]
  };
  /// A Correction's values other than 0 and infinity.
  struct Frame {
    std::vector<Moved> moved;
    std::vector<Narrowed> narrowed;
  };

  explicit MotionTrack(Keeps keeps = Keeps::all) : keeps_(keeps) {}
  /// Starts anew with the frames of a clip from its first on.
  /// @param variables, points  of every correction  @param frames  none: of no clip yet
  void restart(const Clip& clip, std::size_t variables, std::size_t points, std::vector<Frame> frames);
  void restart(const Clip& clip, const Correction& first);
  /// Of the next frame.
  void add(const Correction& correction);

  bool isOf(const Clip& clip) const { return clip_ == &clip && !frames_.empty(); }
  std::uint32_t first() const { return first_; }  ///< that is kept
  std::uint32_t end() const {
    return first_ + std::uint32_t(frames_.size());
  }  ///< the first that is not solved
  /// @param frame  first() or later, before end()
  void at(std::uint32_t frame, Correction& correction) const;
  std::span<const Frame> frames() const { return frames_; }  ///< from first() on
  std::size_t variables() const { return variables_; }
  std::size_t points() const { return points_; }

 private:
  Keeps keeps_;
  const Clip* clip_ = nullptr;
  std::uint32_t first_ = 0;
  std::size_t variables_ = 0, points_ = 0;
  std::vector<Frame> frames_;
  Frame spare_;  // room of a frame that is not kept any more
};

/// What a track depends on: vessels, body, the clip's poses and the options that change a frame. Tracks with
/// another key belong to another motion.
std::uint64_t trackKey(const Scene& scene, const Clip& clip, const FrameOptions& options);

/// Writes a track whole or not at all: what moves, exactly, a frame after the other, and a hash.
/// @param track  that keeps all frames
Result<void> writeTrack(const std::filesystem::path& path, const MotionTrack& track, std::uint64_t key);

/// Reads a track. Fails with badInput where it is damaged, and with resumeMismatch where it belongs to
/// another motion.
/// @param key  trackKey() of what it is wanted for
Result<MotionTrack> readTrack(const std::filesystem::path& path, const Scene& scene, const Clip& clip,
                              std::uint64_t key);

}  // namespace vasa
