#include "viewer/loader.h"

namespace vasa::viewer {
namespace {

bool ready(const std::future<Loader::Answer>& answer) {
  return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

Loader::~Loader() { stop(); }

void Loader::start(Wanted wanted, std::function<void()> changed) {
  cancel();
  title_ = wanted.title;
  job_ = std::make_shared<Job>();
  Job* job = job_.get();
  job->answer = std::async(std::launch::async,
                           [job, wanted = std::move(wanted), changed = std::move(changed)]() -> Answer {
                             const auto told = [&](const char* what, std::size_t done, std::size_t total) {
                               job->what = what;
                               job->done = done;
                               job->total = total;
                               changed();
                             };
                             const auto load = [&]() -> Answer {
                               const CancellationScope scope(job->cancellation);
                               try {
                                 const auto scene = wanted.scene();
                                 if (!scene) return scene.error();
                                 return loadDocument(*scene, wanted.furnishing, told, wanted.edits);
                               } catch (const Cancelled&) {
                                 return Error{Fault::failed, "cancelled"};
                               } catch (const std::exception& error) {
                                 return Error{Fault::failed, error.what()};
                               }
                             };
                             Answer answer = load();
                             job->endedAt = Clock::now();
                             changed();
                             return answer;
                           });
}

void Loader::cancel() {
  if (!job_) return;
  job_->cancelledAt = Clock::now();
  job_->cancellation.ask();
  dropped_.push_back(std::move(job_));
}

void Loader::stop() {
  cancel();
  for (const auto& job : dropped_) job->answer.wait();
  collect();
}

void Loader::collect() {
  std::erase_if(dropped_, [&](const auto& job) {
    if (!ready(job->answer)) return false;
    const double ms = std::chrono::duration<double, std::milli>(job->endedAt - job->cancelledAt).count();
    stopTimes_.push_back(std::max(ms, 0.0));
    return true;
  });
}

std::vector<double> Loader::takeStopTimes() {
  collect();
  return std::exchange(stopTimes_, {});
}

Loader::Stage Loader::stage() const { return job_ ? Stage{job_->what, job_->done, job_->total} : Stage{}; }

std::unique_ptr<Loader::Answer> Loader::take() {
  if (!job_ || !ready(job_->answer)) return nullptr;
  auto answer = std::make_unique<Answer>(job_->answer.get());
  job_.reset();
  return answer;
}

void Loader::wait() const {
  if (job_) job_->answer.wait();
}

}  // namespace vasa::viewer
