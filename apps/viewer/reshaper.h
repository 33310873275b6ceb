#pragma once
#include <functional>
#include <future>
#include <optional>

#include "core/cancellation.h"
#include "core/clock.h"
#include "viewer/document.h"

namespace vasa::viewer {

/// Makes edited documents on a thread of its own while earlier ones are shown. Of wishes that come in faster
/// than they are met only the latest is.
class Reshaper {
 public:
  struct Wish {
    std::shared_ptr<const Document> document;
    std::vector<std::string> journal;
    bool live = false;  ///< editedDocument()
    Clock::time_point since = Clock::now();
  };
  struct Outcome {
    Wish wish;
    Result<std::shared_ptr<const Document>> made;
  };
  /// @param changed  called from the thread at the end of each
  explicit Reshaper(std::function<void()> changed) : changed_(std::move(changed)) {}
  ~Reshaper();
  Reshaper(const Reshaper&) = delete;
  Reshaper& operator=(const Reshaper&) = delete;

  void want(Wish wish);
  bool busy() const { return job_.valid(); }
  void wait() const;
  /// What a wish came to, once; nothing while it is being met.
  std::optional<Outcome> take();

 private:
  void start(Wish wish);

  std::function<void()> changed_;
  Cancellation cancellation_;
  std::future<Outcome> job_;
  std::optional<Wish> next_;
};

}  // namespace vasa::viewer
