#include "viewer/reshaper.h"

namespace vasa::viewer {

Reshaper::~Reshaper() {
  cancellation_.ask();
  if (job_.valid()) job_.wait();
}

void Reshaper::start(Wish wish) {
  job_ = std::async(std::launch::async, [this, wish = std::move(wish)]() -> Outcome {
    const auto make = [&]() -> Result<std::shared_ptr<const Document>> {
      const CancellationScope scope(cancellation_);
      try {
        return editedDocument(*wish.document, wish.journal, wish.live);
      } catch (const Cancelled&) {
        return Error{Fault::failed, "cancelled"};
      } catch (const std::exception& error) {
        return Error{Fault::failed, error.what()};
      }
    };
    Outcome outcome{wish, make()};
    changed_();
    return outcome;
  });
}

void Reshaper::want(Wish wish) {
  if (busy())
    next_ = std::move(wish);
  else
    start(std::move(wish));
}

void Reshaper::wait() const {
  if (job_.valid()) job_.wait();
}

std::optional<Reshaper::Outcome> Reshaper::take() {
  if (!job_.valid() || job_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return std::nullopt;
  Outcome outcome = job_.get();
  if (next_) {
    start(std::move(*next_));
    next_.reset();
  }
  return outcome;
}

}  // namespace vasa::viewer
