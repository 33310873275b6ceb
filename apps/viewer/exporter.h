#pragma once
#include <atomic>
#include <future>
#include <optional>

#include "core/cancellation.h"
#include "io/video.h"
#include "viewer/export_wish.h"
#include "viewer/painter.h"
#include "viewer/view_state.h"

namespace vasa::viewer {

/// Extensions that an export can have, the usual first.
std::vector<std::string> exportExtensions();
bool isFilm(const std::filesystem::path& file);
bool isPicture(const std::filesystem::path& file);

/// Writes what is shown to files beside a living window: shapes are made on a thread, pictures are drawn in
/// slices by step(). One at a time; what is written is as it was when it was started, whatever is done then.
class Exporter {
 public:
  /// @param changed  called from its thread when there is something to do or to tell
  Exporter(gpu::Device& device, std::uint32_t seed, std::function<void()> changed);
  ~Exporter();
  Exporter(const Exporter&) = delete;
  Exporter& operator=(const Exporter&) = delete;

  struct Subject {
    std::shared_ptr<const Document> document;
    std::shared_ptr<const PosedBody> body;  ///< what is shown
    ViewState state;
    Camera camera;  ///< of the picture, its body standing where it is
  };
  void start(ExportWish wish, Subject subject);
  bool busy() const { return job_ != nullptr; }
  /// What the window's thread has to do of it; a slice of a picture at most. @return whether there is more to
  /// do at once
  bool step();
  void cancel();
  /// Waits for what its own thread does.
  void wait() const;

  std::string title() const;
  float share() const;  ///< done, 0..1
  /// The file, or why there is none, once it is over; Fault::interrupted where it was cancelled.
  std::optional<Result<std::filesystem::path>> take();

 private:
  struct Job;
  void startFiles(Job& job) const;
  void orderFrame(Job& job) const;
  bool drawFrame(Job& job);
  Result<void> writeFrame(Job& job);
  void finish(Result<std::filesystem::path> outcome);

  gpu::Device& device_;
  std::uint32_t seed_;
  std::function<void()> changed_;
  std::unique_ptr<Job> job_;
  std::optional<Result<std::filesystem::path>> outcome_;
};

}  // namespace vasa::viewer
