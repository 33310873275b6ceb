#pragma once
#include <atomic>
#include <chrono>
#include <future>

#include "core/cancellation.h"
#include "viewer/document.h"

namespace vasa::viewer {

/// What is wanted, found out on the loading thread: that may take reading, too.
using SceneChoice = std::function<Result<SceneFile>()>;

/// Loads on a thread of its own, so that the window stays alive.
class Loader {
 public:
  using Answer = Result<std::shared_ptr<const Document>>;
  ~Loader();

  struct Wanted {
    std::string title;
    SceneChoice scene;
    Furnishing furnishing;
    std::optional<std::vector<std::string>> edits = std::nullopt;  ///< loadDocument()
  };
  /// Starts; cancels what is being loaded. @param changed  called from the loading thread at every step and
  /// at the end
  void start(Wanted wanted, std::function<void()> changed);
  /// What is being loaded is wanted no longer. Its thread stops on its own, within some hundredths of a
  /// second (core/cancellation.h); nobody waits for it but the destructor and stop().
  void cancel();
  /// Cancels, and waits for whatever has been cancelled.
  void stop();

  bool busy() const { return job_ != nullptr; }
  struct Stage {
    const char* what = "";
    std::size_t done = 0, total = 0;  ///< total 0: unknown
  };
  Stage stage() const;
  const std::string& title() const { return title_; }
  /// The document, or why there is none, once; null while it is being loaded.
  std::unique_ptr<Answer> take();
  /// Waits until there is something to take.
  void wait() const;
  /// [ms] between cancel() and the end of the thread, of those that have ended since the last call.
  std::vector<double> takeStopTimes();

 private:
  using Clock = std::chrono::steady_clock;
  struct Job {
    Cancellation cancellation;
    std::atomic<const char*> what{"starting"};
    std::atomic<std::size_t> done{0}, total{0};
    Clock::time_point cancelledAt,
        endedAt;  // the first is the window's thread's, the second the loading one's until it has ended
    std::future<Answer> answer;
  };
  void collect();

  std::shared_ptr<Job> job_;
  std::vector<std::shared_ptr<Job>> dropped_;  // cancelled, not ended yet
  std::vector<double> stopTimes_;
  std::string title_;
};

}  // namespace vasa::viewer
