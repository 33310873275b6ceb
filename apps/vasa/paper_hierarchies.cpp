#include <algorithm>

#include "collide/box_hierarchy.h"
#include "collide/network_tubes.h"
#include "collide/paper_detector.h"
#include "collide/tube_detector.h"
#include "core/cancellation.h"
#include "core/clock.h"
#include "core/parallel.h"
#include "paper_look.h"
#include "paper_study.h"
#include "scene/frame.h"

// Table II: hierarchies over a tessellated network against trees over its sweeps. All find the pairs that run
// through one another in the same poses, before vessels are moved apart, neighbours left out, on one thread.
namespace vasa::cli {
namespace {

struct Poses {
  NetworkTubes layout;
  std::vector<Bezier> rest;
  std::vector<std::vector<Bezier>> moved;
};

Poses makePoses(const PaperStudy& study) {
  const std::uint32_t count = study.quick ? 1 : 9;
  Poses poses{NetworkTubes(study.scene.network), {}, {}};
  const auto shape = [&](std::span<const vec4> points) {
    std::vector<Bezier> tubes(poses.layout.count());
    poses.layout.shape(points, tubes);
    return tubes;
  };
  poses.rest = shape(study.scene.network.points());
  FrameMaker maker(study.scene);
  for (std::uint32_t pose = 0; pose < count; ++pose) {
    const std::uint32_t frame = study.clip ? (pose + 1) * (study.clip->frameCount() - 1) / (count + 1) : 0;
    maker.make(study.clip, study.clip ? study.clip->timeOfFrame(frame) : 0);
    poses.moved.push_back(shape(maker.points()));
  }
  return poses;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Medians over the poses, each of a shape of its own; the pairs are those of all poses together.
// @param tessellate  what is done before, as it belongs to the drawing, too
template <class Tessellate, class Refit, class Detect>
Report timesOf(const Poses& poses, Tessellate&& tessellate, Refit&& refit, Detect&& detect) {
  std::vector<double> refits, detections;
  std::size_t pairs = 0;
  for (const auto& tubes : poses.moved) {
    tessellate(tubes);
    const auto start = Clock::now();
    refit(tubes);
    refits.push_back(msSince(start));
    const auto middle = Clock::now();
    pairs += detect().size();
    detections.push_back(msSince(middle));
  }
  return {{"refit_ms", median(refits)}, {"detect_ms", median(detections)}, {"pairs", pairs}};
}

struct Resolution {
  std::uint32_t around, along;
  const char* name;
  double paperBytes;  // of PQP's hierarchy
};
constexpr Resolution kResolutions[] = {{8, 1, "the mesh", 5.8e6},
                                       {4, 4, "4x4", 250e6},
                                       {4, 10, "4x10", 376e6},
                                       {8, 5, "8x5", 376e6},
                                       {8, 10, "8x10", 500e6}};

template <class Box>
Report boxRow(const Poses& poses, const Resolution& resolution, const char* what, Report paper) {
  const TubeSurface surface(resolution.around, resolution.along);
  std::vector<vec3> positions;
  surface.shape(poses.rest, positions);
  const auto start = Clock::now();
  BoxHierarchy<Box> hierarchy(surface, positions, poses.layout.neighbours());
  const double build = msSince(start);
  Report ours{{"triangles", std::size_t(surface.trianglesPerTube()) * poses.rest.size()},
              {"bytes", hierarchy.bytes()},
              {"mesh_bytes", surface.bytes(poses.rest.size())},
              {"build_ms", build}};
  ours.update(timesOf(
      poses, [&](std::span<const Bezier> tubes) { surface.shape(tubes, positions); },
      [&](std::span<const Bezier>) { hierarchy.refit(positions); }, [&] { return hierarchy.detect(); }));
  return {
      {"hierarchy", what}, {"over", resolution.name}, {"ours", std::move(ours)}, {"paper", std::move(paper)}};
}

template <class Detector>
Report treeRow(const Poses& poses, Detector& detector, double build, std::size_t bytes, const char* what,
               Report paper) {
  Report ours{{"bytes", bytes}, {"build_ms", build}};
  ours.update(timesOf(
      poses, [](std::span<const Bezier>) {}, [&](std::span<const Bezier> tubes) { detector.update(tubes); },
      [&] { return detector.detect(); }));
  return {{"hierarchy", what}, {"over", "sweeps"}, {"ours", std::move(ours)}, {"paper", std::move(paper)}};
}

// Puts the number of threads back.
class OneThread {
 public:
  OneThread() : before_(threadCount()) { setThreadCount(1); }
  ~OneThread() { setThreadCount(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  unsigned before_;
};

}  // namespace

Result<Report> hierarchyTable(const PaperStudy& study) {
  const Poses poses = makePoses(study);
  const OneThread alone;
  const Exclusions& exclusions = poses.layout.neighbours();
  Report rows = Report::array();
  for (const Resolution& resolution : kResolutions) {
    for (const bool oriented : {false, true}) {
      checkpoint();
      // PQP's boxes are oriented; the paper says nothing of others.
      rows.push_back(oriented ? boxRow<OrientedBox>(poses, resolution, "oriented boxes",
                                                    {{"bytes", resolution.paperBytes}})
                              : boxRow<AlignedBox>(poses, resolution, "aligned boxes", nullptr));
    }
  }
  auto start = Clock::now();
  PaperDetector paper(poses.rest, exclusions, kPaperTolerance * study.scene.network.bodyHeight());
  rows.push_back(treeRow(poses, paper, msSince(start), paper.tree().bytes(),
                         "sphere tree, line-swept spheres (the paper's)", {{"bytes", 72e3}}));
  start = Clock::now();
  TubeDetector exact(poses.rest, exclusions);
  rows.push_back(treeRow(poses, exact, msSince(start), exact.treeBytes(),
                         "tree of boxes over tubes, exact (ours)", nullptr));
  return rows;
}

}  // namespace vasa::cli
