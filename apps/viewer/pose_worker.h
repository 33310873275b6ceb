#pragma once
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "body/joint_motion.h"
#include "core/cancellation.h"
#include "scene/frame.h"
#include "scene/measurements.h"
#include "viewer/document.h"
#include "viewer/forces.h"

namespace vasa::viewer {

/// A shape of the vessels that is wanted.
struct PoseOrder {
  std::shared_ptr<const Document> document;
  int clip = -1;   ///< -1: at rest
  float time = 0;  ///< [s] in the clip
  std::vector<JointTurn> turns;
  Forces forces;
  bool contacts = false;
  bool measures = false;  ///< of every vessel

  bool operator==(const PoseOrder& other) const;
};

/// A shape, done.
struct PosedBody {
  PoseOrder order;
  Pose pose;
  std::vector<vec4> points;
  std::vector<quat> knotFrames;
  std::vector<mat4> jointMatrices;
  float heartScale = 1;
  FrameReport report;
  std::vector<std::uint32_t> touched, touching;  ///< spans that ran through others, and that still do
  /// Pairs of tubes that ran through one another; only with contacts.
  std::uint32_t contactsBefore = 0;
  std::vector<VesselMeasures> measures;  ///< one a vessel; empty unless ordered
  double ms = 0;                         ///< all of it but the measures
  /// As the pose alone has it, for a document's first pictures: the order is being made.
  bool provisional = false;
};

/// What a maker has made. @param contacts  places where vessels touch, too; the maker must look for them
void takeShapeOf(FrameMaker& maker, bool contacts, PosedBody& body);

/// Makes shapes on a thread of its own while earlier ones are drawn. Before a document's first, for which
/// more has to be set up, comes a provisional one. Of orders that come in faster than they are done only the
/// latest is; one for another document cancels what is being done, and so does the end.
class PoseWorker {
 public:
  /// @param done           called from the worker's thread after each shape
  /// @param besidePicture  the processors that make shapes draw them, too: drawing comes first
  PoseWorker(std::function<void()> done, bool besidePicture);
  ~PoseWorker();
  PoseWorker(const PoseWorker&) = delete;
  PoseWorker& operator=(const PoseWorker&) = delete;

  void order(PoseOrder order);
  /// The latest shape; null before the first one.
  std::shared_ptr<const PosedBody> latest() const;
  bool busy() const;
  /// Until nothing is being done.
  void wait() const;

 private:
  struct Maker;
  void work();
  std::shared_ptr<const PosedBody> make(const PoseOrder& order);
  void show(std::shared_ptr<const PosedBody> made);

  std::function<void()> done_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::unique_ptr<PoseOrder> next_;
  std::shared_ptr<const Document> latestDocument_;  // of the latest order
  Cancellation cancellation_;                       // of orders for it
  bool working_ = false, ending_ = false;
  std::shared_ptr<const PosedBody> latest_;
  std::vector<std::unique_ptr<Maker>> makers_;  // the worker's alone
  std::thread thread_;
};

}  // namespace vasa::viewer
