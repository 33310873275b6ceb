#include "viewer/pose_worker.h"

#include <algorithm>

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

bool sameTurns(std::span<const JointTurn> a, std::span<const JointTurn> b) {
  return std::ranges::equal(a, b, [](const JointTurn& x, const JointTurn& y) {
    return x.joint == y.joint && x.angles == y.angles;
  });
}

bool sameOptions(const PoseOrder& a, const PoseOrder& b) {
  return a.document == b.document && a.forces == b.forces && a.contacts == b.contacts;
}

}  // namespace

bool PoseOrder::operator==(const PoseOrder& other) const {
  return sameOptions(*this, other) && clip == other.clip && time == other.time &&
         measures == other.measures && sameTurns(turns, other.turns);
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

// Setting up avoidance takes a while, so the ways of making shapes that were used last are kept.
struct PoseWorker::Maker {
  explicit Maker(const PoseOrder& like)
      : order(like), maker(like.document->scene, frameOptions(like.forces, like.contacts)) {}

  std::shared_ptr<PosedBody> make(const PoseOrder& wanted) {
    const auto start = Clock::now();
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

  // What takes little to set up.
  static std::shared_ptr<const PosedBody> provisional(const PoseOrder& order) {
    PoseOrder quick = order;
    quick.forces.avoid = quick.contacts = quick.measures = false;
    auto made = Maker(quick).make(quick);
    made->order = order;
    made->provisional = true;
    return made;
  }

  PoseOrder order;    // keeps the document alive
  bool live = false;  // something is on the screen: what is posed by hand goes on from there
  FrameMaker maker;
  std::optional<VesselMeter> meter;
};

PoseWorker::PoseWorker(std::function<void()> done, bool besidePicture)
    : done_(std::move(done)), thread_([this, besidePicture] {
        if (besidePicture) giveWay();
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
  return working_ || next_;
}

void PoseWorker::wait() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !working_ && !next_; });
}

std::shared_ptr<const PosedBody> PoseWorker::make(const PoseOrder& order) {
  constexpr std::size_t kMostMakers = 3;
  const auto found =
      std::ranges::find_if(makers_, [&](const auto& maker) { return sameOptions(maker->order, order); });
  if (found != makers_.end()) {
    std::rotate(found, found + 1, makers_.end());
  } else {
    std::erase_if(makers_, [&](const auto& maker) { return maker->order.document != order.document; });
    if (makers_.empty() && (order.forces.avoid || order.contacts)) show(Maker::provisional(order));
    const StageLog stage("behind the picture: preparing how vessels move");
    if (makers_.size() == kMostMakers) makers_.erase(makers_.begin());
    makers_.push_back(std::make_unique<Maker>(order));
  }
  return makers_.back()->make(order);
}

void PoseWorker::show(std::shared_ptr<const PosedBody> made) {
  {
    const std::lock_guard lock(mutex_);
    latest_ = std::move(made);
  }
  changed_.notify_all();
  done_();
}

void PoseWorker::work() {
  for (;;) {
    std::unique_ptr<PoseOrder> order;
    Cancellation cancellation;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return ending_ || next_; });
      if (ending_) return;
      order = std::move(next_);
      cancellation = cancellation_;
      working_ = true;
    }
    std::shared_ptr<const PosedBody> made;
    try {
      const CancellationScope scope(cancellation);
      made = make(*order);
    } catch (const Cancelled&) {  // a way of making shapes that was left halfway is not gone on with
      std::erase_if(makers_, [&](const auto& maker) { return sameOptions(maker->order, *order); });
    }
    {
      const std::lock_guard lock(mutex_);
      if (made) latest_ = std::move(made);
      working_ = false;
    }
    changed_.notify_all();
    done_();
  }
}

}  // namespace vasa::viewer
