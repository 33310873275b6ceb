#include <doctest/doctest.h>

#include <algorithm>

#include "body/retarget.h"
#include "collide/network_tubes.h"
#include "collide/passages.h"
#include "core/hash.h"
#include "scene/correction_step.h"
#include "scene/frame.h"
#include "scene_human.h"

using namespace vasa;

namespace {

/// Ends that are not where their node is: on their host, or with the node's other ends.
std::size_t looseEnds(std::span<const vec4> points) {
  const Network& network = human().network;
  const auto endOf = [&](const VesselEnd& end) {
    const auto own = Network::pointsOf(network.vessel(end.vessel), points);
    return vec3(end.last ? own.back() : own.front());
  };
  std::size_t loose = 0;
  for (const Node& node : network.nodes()) {
    const auto ends = network.ends(node);
    if (ends.empty()) continue;
    const vec3 place = node.host ? vec3(evaluate(Network::pointsOf(network.vessel(node.host->vessel), points),
                                                 node.host->parameter))
                                 : endOf(ends[0]);
    for (const VesselEnd& end : ends) loose += glm::distance(endOf(end), place) > 1e-5f;
  }
  return loose;
}

struct Played {
  std::uint32_t frames = 0, certified = 0, inBones = 0, loose = 0;
  float largestVolumeError = 0;
  float largestStep = 0;  // [m]
  std::uint32_t excess = 0, excessFrames = 0;
  std::size_t passages = 0, posedPassages = 0;  // from frame to frame: as they are, and as the body has them
};

// What vessels pass through from one shape of the human's network to the next.
class Watch {
 public:
  std::size_t next(std::span<const vec4> points) {
    last_.swap(now_);
    now_.resize(layout_.count());
    layout_.shape(points, now_);
    return last_.empty() ? 0 : search_.find(last_, now_).size();
  }

 private:
  std::vector<Bezier> restTubes() const {
    std::vector<Bezier> tubes(layout_.count());
    layout_.shape(human().network.points(), tubes);
    return tubes;
  }
  NetworkTubes layout_{human().network};
  PassageSearch search_{restTubes(), layout_.neighbours()};
  std::vector<Bezier> now_, last_;
};

Played play(const Clip& clip, float framesPerSecond) {
  FrameMaker maker(human(), {.avoid = true});
  CorrectionSteps steps(human().network);
  Watch watch, posedWatch;
  const Clip timing{.start = clip.start, .end = clip.end, .framesPerSecond = framesPerSecond};
  Played played;
  for (std::uint32_t frame = 0; frame < timing.frameCount(); ++frame) {
    maker.make(&clip, timing.timeOfFrame(frame));
    const AvoidReport& report = maker.report().avoid;
    ++played.frames;
    played.certified += report.after.holds();
    played.inBones += report.bonesAfter.contacts;
    played.loose += std::uint32_t(looseEnds(maker.points()));
    played.passages += watch.next(maker.points());
    played.posedPassages += posedWatch.next(maker.posedPoints());
    played.largestVolumeError = std::max(played.largestVolumeError, report.volume.largestError);
    const auto now = steps.next(maker.posedPoints(), maker.points());
    if (!now) continue;
    played.largestStep = std::max(played.largestStep, now->largest);
    played.excess += now->excess;
    played.excessFrames += now->excess > 0;
    if (now->worst)
      MESSAGE(clip.name << " frame " << frame << ": " << human().network.vessel(now->worst->vessel).name
                        << " at " << now->worst->parameter << " steps " << 1e3f * now->worst->step
                        << " mm of " << 1e3f * now->worst->bound << " mm");
  }
  MESSAGE(clip.name << " at " << framesPerSecond << ": " << played.frames << " frames, largest step "
                    << 1e3f * played.largestStep << " mm, " << played.excess << " samples in excess");
  return played;
}

}  // namespace

TEST_CASE("the built-in human's vessels part in its motions without a jump") {
  for (const char* name : {"squat", "elbow_flex", "arms_overhead"}) {
    CAPTURE(std::string(name));
    const Clip& clip = clipNamed(name);
    const Played played = play(clip, clip.framesPerSecond);
    CHECK(played.certified == played.frames);
    CHECK(played.inBones == 0);
    CHECK(played.loose == 0);
    CHECK(played.largestVolumeError < 1e-4f);
    CHECK(played.excess == 0);
    CHECK(played.passages == 0);
    CHECK(played.posedPassages > 5);
  }
}

TEST_CASE("the same motion at four times the frames changes corrections by a third at most") {
  const Clip& clip = clipNamed("twist");
  const Played coarse = play(clip, clip.framesPerSecond), fine = play(clip, 4 * clip.framesPerSecond);
  CHECK(fine.certified == fine.frames);
  CHECK(fine.inBones == 0);
  CHECK(fine.loose == 0);
  CHECK(fine.largestVolumeError < 1e-4f);
  CHECK(fine.excess == 0);
  CHECK(fine.passages == 0);
  CHECK(fine.largestStep < coarse.largestStep / 3);
}

TEST_CASE("a frame is the same whichever frames were made before it") {
  const Clip& clip = clipNamed("elbow_flex");
  const auto hashAt = [&](FrameMaker& maker, float frame) {
    maker.make(&clip, clip.start + frame / clip.framesPerSecond);
    return hashOf(maker.points());
  };
  FrameMaker inOrder(human(), {.avoid = true}), other(human(), {.avoid = true});
  std::vector<std::uint64_t> hashes;
  for (const float frame : {0.0f, 8.0f, 16.0f, 16.5f, 17.0f, 20.0f}) hashes.push_back(hashAt(inOrder, frame));
  CHECK(hashAt(inOrder, 8) == hashes[1]);
  CHECK(hashAt(inOrder, 16.5f) == hashes[3]);
  CHECK(hashAt(other, 20) == hashes[5]);
  CHECK(hashAt(other, 16) == hashes[2]);
  CHECK(hashAt(other, 17) == hashes[4]);
  other.make(&clipNamed("squat"), 0.1f);
  CHECK(hashAt(other, 16.5f) == hashes[3]);
  CHECK(hashAt(other, 0) == hashes[0]);
}

TEST_CASE("the built-in human, bare of names, is known by its shape as by its names") {
  Body bare = human().body;
  const HumanoidNames told = partsOf(bare.skeleton);
  for (std::size_t j = 0; j < bare.skeleton.joints.size(); ++j)
    bare.skeleton.joints[j].name = std::string("b").append(std::to_string(j));
  const HumanoidNames seen = partsOf(bare.skeleton);
  for (const std::string side : {"left", "right"})
    for (const char* limb : {"UpperArm", "LowerArm", "Hand", "UpperLeg", "LowerLeg", "Foot"}) {
      const std::string part = side + limb;
      const auto a = std::ranges::find(told.of, part), b = std::ranges::find(seen.of, part);
      CHECK_MESSAGE(a - told.of.begin() == b - seen.of.begin(), part);
    }
  const auto done = retargeted(standingStill(human().body), bare);
  if (!done.ok()) FAIL(done.error().message);
  CHECK_MESSAGE(done->sureness > 0.75f, describeMatch(*done));
}
