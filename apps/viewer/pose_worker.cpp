#include "viewer/pose_worker.h"

#include <algorithm>
#include <future>
#include <utility>

#include "core/clock.h"
#include "core/parallel.h"
#include "core/stage_log.h"

namespace vasa::viewer {
namespace {

constexpr float kClearanceReach = 0.01f;  // [m]
constexpr float kLiveSeconds =
    0.1f;  // that a pose by hand takes: vessels follow a pull about as fast as it comes

std::vector<std::uint32_t> spansOf(std::span<const Interference::Place> places) {
  std::vector<std::uint32_t> spans;
  for (const Interference::Place& place : places)
    spans.insert(spans.end(), {place.contact.i, place.contact.j});
  std::ranges::sort(spans);
  spans.erase(std::unique(spans.begin(), spans.end()), spans.end());
  return spans;
}

bool sameOptions(const PoseOrder& a, const PoseOrder& b) {
  return a.document == b.document && a.forces == b.forces && a.contacts == b.contacts;
}

}  // namespace

bool PoseOrder::operator==(const PoseOrder& other) const {
  return sameOptions(*this, other) && clip == other.clip && time == other.time &&
         measures == other.measures && turns == other.turns;
}

void takeShapeOf(FrameMaker& maker, bool contacts, PosedBody& body) {
  body.pose = maker.pose();
  body.points.assign(maker.points().begin(), maker.points().end());
  body.knotFrames.assign(maker.knotFrames().begin(), maker.knotFrames().end());
  body.jointMatrices.assign(maker.jointMatrices().begin(), maker.jointMatrices().end());
  body.heartScale = maker.heartScale();
  body.report = maker.report();
  if (!maker.avoider() || !contacts) return;
  body.contactsBefore = maker.lookAtPosed().vessels.contacts;
  body.touched = spansOf(maker.avoider()->found());
  body.touching = spansOf(maker.avoider()->remaining());
}

// A way of making shapes of a document.
struct PoseWorker::Maker {
  explicit Maker(const PoseOrder& like)
      : order(like), maker(like.document->scene, frameOptions(like.forces, like.contacts)) {}

  // The vessels in the order's pose, and nothing beside.
  void pose(const PoseOrder& wanted) {
    const Body& body = wanted.document->scene.body;
    const Clip* clip = wanted.clip >= 0 ? &body.clips[std::size_t(wanted.clip)] : nullptr;
    if (wanted.turns.empty()) {
      maker.make(clip, wanted.time);
    } else {
      const Pose clipPose = clip ? samplePose(body.skeleton, *clip, wanted.time) : restPose(body.skeleton);
      const Pose pose = turned(body.skeleton, clipPose, wanted.turns);
      if (live)
        maker.moveTo(pose, wanted.time, kLiveSeconds);
      else
        maker.make(pose, wanted.time);
    }
    live = true;
  }

  std::shared_ptr<PosedBody> make(const PoseOrder& wanted) {
    const auto start = Clock::now();
    pose(wanted);
    auto done = std::make_shared<PosedBody>();
    done->order = wanted;
    takeShapeOf(maker, wanted.contacts, *done);
    done->ms = msSince(start);
    if (wanted.measures) {
      if (!meter) meter.emplace(wanted.document->scene.network, kClearanceReach);
      done->measures = meter->run(maker.points());
    }
    return done;
  }

  PoseOrder order;    // keeps the document alive
  bool live = false;  // something is on the screen: what is posed by hand goes on from there
  FrameMaker maker;
  std::optional<VesselMeter> meter;
};

// Setting up a way that keeps vessels apart.
struct PoseWorker::Preparation {
  PoseOrder like;
  Cancellation cancellation;
  std::unique_ptr<Maker> made;  // null once done: it was cancelled
  bool done = false;            // under the worker's mutex
  std::future<void> thread;     // goes first
};

PoseWorker::PoseWorker(std::function<void()> done, bool besidePicture)
    : done_(std::move(done)), besidePicture_(besidePicture), thread_([this] {
        if (besidePicture_) giveWay();
        work();
      }) {}

PoseWorker::~PoseWorker() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    cancellation_.ask();
  }
  changed_.notify_all();
  thread_.join();
  if (preparation_) preparation_->cancellation.ask();
}

void PoseWorker::order(PoseOrder order) {
  {
    const std::lock_guard lock(mutex_);
    if (order.document != latestDocument_) {
      cancellation_.ask();
      cancellation_ = {};
      latestDocument_ = order.document;
    }
    next_ = std::make_unique<PoseOrder>(std::move(order));
  }
  changed_.notify_all();
}

std::shared_ptr<const PosedBody> PoseWorker::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

bool PoseWorker::busy() const {
  const std::lock_guard lock(mutex_);
  return working_ || next_ || unprepared_;
}

bool PoseWorker::isFree() const {
  const std::lock_guard lock(mutex_);
  return !working_ && !next_;
}

void PoseWorker::wait() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !working_ && !next_ && !unprepared_; });
}

PoseWorker::Maker* PoseWorker::makerFor(const PoseOrder& order) {
  const auto found =
      std::ranges::find_if(makers_, [&](const auto& maker) { return sameOptions(maker->order, order); });
  if (found == makers_.end()) return nullptr;
  std::rotate(found, found + 1, makers_.end());
  return makers_.back().get();
}

// The ways that were used last, of one document.
PoseWorker::Maker& PoseWorker::keep(std::unique_ptr<Maker> maker) {
  constexpr std::size_t kMostMakers = 3;
  std::erase_if(makers_, [&](const auto& other) { return other->order.document != maker->order.document; });
  if (makers_.size() == kMostMakers) makers_.erase(makers_.begin());
  makers_.push_back(std::move(maker));
  return *makers_.back();
}

// One at a time, on a thread of its own.
void PoseWorker::prepare(const PoseOrder& order) {
  if (preparation_) {  // for something else that is no longer wanted
    if (!sameOptions(preparation_->like, order)) preparation_->cancellation.ask();
    return;
  }
  preparation_ = std::make_unique<Preparation>();
  preparation_->like = order;
  preparation_->thread = std::async(std::launch::async, [this, own = preparation_.get()] {
    if (besidePicture_) giveWay();
    std::unique_ptr<Maker> made;
    try {
      const CancellationScope scope(own->cancellation);
      const StageLog stage("behind the picture: preparing how vessels move");
      made = std::make_unique<Maker>(own->like);
    } catch (const Cancelled&) {
    }
    {
      const std::lock_guard lock(mutex_);
      own->made = std::move(made);
      own->done = true;
    }
    changed_.notify_all();
  });
}

bool PoseWorker::isPrepared() const { return preparation_ && preparation_->done; }

void PoseWorker::takePrepared(const PoseOrder& order) {
  {
    const std::lock_guard lock(mutex_);
    if (!isPrepared()) return;
  }
  const auto taken = std::exchange(preparation_, nullptr);
  if (taken->made && taken->like.document == order.document) keep(std::move(taken->made));
}

std::shared_ptr<const PosedBody> PoseWorker::makeQuickly(const PoseOrder& order) {
  const auto start = Clock::now();
  PoseOrder alone = order;
  const bool carries = carried_ && carriedBy_ == order.forces && carried_->suits(*order.document);
  alone.forces.avoid = alone.contacts = alone.measures = false;
  if (carries) alone.forces.volume = false;  // radii are carried, too
  if (!quick_ || !sameOptions(quick_->order, alone)) quick_ = std::make_unique<Maker>(alone);
  FrameMaker& maker = quick_->maker;
  quick_->pose(alone);
  if (carries) maker.put(carried_->laidOn(*order.document, maker));
  auto made = std::make_shared<PosedBody>();
  made->order = order;
  takeShapeOf(maker, false, *made);
  made->ms = msSince(start);
  made->provisional = !order.document->live;
  return made;
}

std::shared_ptr<const PosedBody> PoseWorker::make(const PoseOrder& order) {
  takePrepared(order);
  Maker* maker = makerFor(order);
  if (!maker && (order.forces.avoid || order.contacts)) {
    if (!order.document->live) prepare(order);
    return makeQuickly(order);
  }
  if (!maker) maker = &keep(std::make_unique<Maker>(order));
  auto made = maker->make(order);
  quick_.reset();
  carried_.reset();
  if (order.forces.avoid) carried_.emplace(order.document, maker->maker);
  carriedBy_ = order.forces;
  return made;
}

void PoseWorker::work() {
  for (;;) {
    std::unique_ptr<PoseOrder> order;
    Cancellation cancellation;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return ending_ || next_ || (unprepared_ && isPrepared()); });
      if (ending_) return;
      order = std::move(next_ ? next_ : unprepared_);
      unprepared_.reset();
      cancellation = cancellation_;
      working_ = true;
    }
    std::shared_ptr<const PosedBody> made;
    try {
      const CancellationScope scope(cancellation);
      made = make(*order);
    } catch (const Cancelled&) {  // a way of making shapes that was left halfway is not gone on with
      std::erase_if(makers_, [&](const auto& maker) { return sameOptions(maker->order, *order); });
      quick_.reset();
    }
    {
      const std::lock_guard lock(mutex_);
      if (made && made->provisional && !next_) unprepared_ = std::move(order);
      if (made) latest_ = std::move(made);
      working_ = false;
    }
    changed_.notify_all();
    done_();
  }
}

}  // namespace vasa::viewer
