#pragma once
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "body/joint_motion.h"
#include "core/cancellation.h"
#include "scene/frame.h"
#include "scene/measurements.h"
#include "viewer/carried_shape.h"
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
  /// For a document's first pictures: what keeps vessels apart is being set up, and the order is not done.
  bool provisional = false;
};

/// What a maker has made. @param contacts  places where vessels touch, too; the maker must look for them
void takeShapeOf(FrameMaker& maker, bool contacts, PosedBody& body);

/// Makes shapes on a thread of its own while earlier ones are drawn. What keeps a document's vessels apart
/// takes a second or more to set up, on another thread: until then shapes are provisional, as the pose alone
/// has them, and moved aside as those of the document before were (CarriedShape). Those of a document that is
/// to be replaced at once (Document::live) stay so. Of orders that come in faster than they are done only the
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
  /// Whether no order is being done, though one may wait for what is being set up.
  bool isFree() const;
  /// Until nothing is being done, or set up for it.
  void wait() const;

 private:
  struct Maker;
  struct Preparation;
  void work();
  std::shared_ptr<const PosedBody> make(const PoseOrder& order);
  std::shared_ptr<const PosedBody> makeQuickly(const PoseOrder& order);
  Maker* makerFor(const PoseOrder& order);
  Maker& keep(std::unique_ptr<Maker> maker);
  void prepare(const PoseOrder& order);
  void takePrepared(const PoseOrder& order);
  bool isPrepared() const;

  std::function<void()> done_;
  bool besidePicture_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::unique_ptr<PoseOrder> next_;
  std::shared_ptr<const Document> latestDocument_;  // of the latest order
  Cancellation cancellation_;                       // of orders for it
  bool working_ = false, ending_ = false;
  std::shared_ptr<const PosedBody> latest_;
  std::unique_ptr<PoseOrder> unprepared_;       // of which only a provisional shape was made
  std::unique_ptr<Preparation> preparation_;    // made, and taken, by the worker alone
  std::vector<std::unique_ptr<Maker>> makers_;  // the worker's alone, as all that follows
  std::unique_ptr<Maker> quick_;
  std::optional<CarriedShape> carried_;
  Forces carriedBy_;
  std::thread thread_;
};

}  // namespace vasa::viewer
