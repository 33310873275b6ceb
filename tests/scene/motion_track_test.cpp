#include "scene/motion_track.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/atomic_file.h"
#include "scene/frame.h"
#include "scene_human.h"
#include "support/shared_data.h"

using namespace vasa;

namespace {

constexpr std::uint32_t kFrames = 6;

struct Solved {
  FrameOptions options{.avoid = true, .track = std::make_shared<MotionTrack>()};
  std::vector<vec4> last;
  AvoidReport report;
};

// The first frames of a clip, one after the other.
Solved solve(const Clip& clip) {
  Solved solved;
  FrameMaker maker(human(), solved.options);
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) maker.make(&clip, clip.timeOfFrame(frame));
  solved.last.assign(maker.points().begin(), maker.points().end());
  solved.report = maker.report().avoid;
  return solved;
}

}  // namespace

TEST_CASE("a track that was written and read gives the same frames to the byte") {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "walk.track";
  const Clip& clip = clipNamed("walk");
  const Solved solved = solve(clip);
  CHECK(solved.report.movedMax > 0.001f);
  const std::uint64_t key = trackKey(human(), clip, solved.options);
  REQUIRE(writeTrack(file, *solved.options.track, key).ok());
  auto read = readTrack(file, human(), clip, key);
  REQUIRE(read.ok());
  REQUIRE(read->end() == kFrames);
  for (std::uint32_t k = 0; k < kFrames; ++k) {
    Correction own, other;
    read->at(k, own);
    solved.options.track->at(k, other);
    CHECK(own.motions == other.motions);
    CHECK(own.widest == other.widest);
  }
  // A frame alone, which is not solved again, and the one after the track's last.
  FrameMaker maker(human(), {.avoid = true, .track = std::make_shared<MotionTrack>(std::move(*read))}),
      other(human(), {.avoid = true});
  maker.make(&clip, clip.timeOfFrame(kFrames - 1));
  CHECK(std::ranges::equal(maker.points(), solved.last));
  CHECK(maker.report().steps == 0);
  CHECK(maker.report().avoid.after.contacts == solved.report.after.contacts);
  CHECK(maker.report().avoid.movedMax == solved.report.movedMax);
  CHECK(maker.report().avoid.bonesAfter.contacts == solved.report.bonesAfter.contacts);
  maker.make(&clip, clip.timeOfFrame(kFrames));
  other.make(&clip, clip.timeOfFrame(kFrames));
  CHECK(std::ranges::equal(maker.points(), other.points()));
}

TEST_CASE("a clip that ends between two frames goes on to its end, whatever was made before") {
  Clip clip = clipNamed("walk");
  clip.end = clip.timeOfFrame(2) + 0.6f / clip.framesPerSecond;
  REQUIRE(clip.frameCount() == 3);
  FrameMaker straight(human(), {.avoid = true}), jumped(human(), {.avoid = true});
  straight.make(&clip, clip.timeOfFrame(2));
  const std::vector<vec4> last(straight.points().begin(), straight.points().end());
  straight.make(&clip, clip.end);
  CHECK(straight.pose().world == samplePose(human().body.skeleton, clip, clip.end).world);
  CHECK(!std::ranges::equal(straight.points(), last));
  jumped.make(&clip, clip.end);
  CHECK(std::ranges::equal(jumped.points(), straight.points()));
  jumped.make(&clip, clip.timeOfFrame(2));
  CHECK(std::ranges::equal(jumped.points(), last));
}

TEST_CASE("a track holds what moves, and only the latest two frames where that is asked for") {
  const Clip& clip = clipNamed("walk");
  const auto latest = std::make_shared<MotionTrack>(MotionTrack::Keeps::latest);
  FrameMaker all(human(), {.avoid = true}), film(human(), {.avoid = true, .track = latest});
  std::vector<vec4> early;
  for (const std::uint32_t frame : {0u, 1u, 3u, 4u}) {
    CAPTURE(frame);
    all.make(&clip, clip.timeOfFrame(frame));
    film.make(&clip, clip.timeOfFrame(frame));
    CHECK(std::ranges::equal(film.points(), all.points()));
    CHECK(latest->frames().size() <= 2);
    CHECK(latest->end() == frame + 1);
    if (frame == 1) early.assign(film.points().begin(), film.points().end());
  }
  const MotionTrack::Frame& kept = latest->frames().back();
  CHECK(!kept.moved.empty());
  CHECK(4 * kept.moved.size() < latest->variables());  // most of a body lies where the pose has it
  CHECK(std::ranges::none_of(kept.moved, [](const MotionTrack::Moved& own) { return own.by == vec3(0); }));
  // Back to what is not kept any more: from the clip's beginning anew.
  film.make(&clip, clip.timeOfFrame(1));
  CHECK(std::ranges::equal(film.points(), early));
  CHECK(latest->end() == 2);
  // Between two frames of which the earlier is not kept any more.
  const auto between = [&](FrameMaker& maker, float frame) {
    maker.make(&clip, clip.start + frame / clip.framesPerSecond);
    return std::vector<vec4>(maker.points().begin(), maker.points().end());
  };
  const auto before = between(film, 2.5f);
  between(film, 4.5f);
  CHECK(between(film, 2.5f) == before);
  CHECK(between(all, 2.5f) == before);
}

TEST_CASE("the first frame of a clip that closes is the same whichever frame is made first") {
  for (const char* name : {"walk", "run"}) {
    CAPTURE(name);
    const Clip& clip = clipNamed(name);
    FrameMaker first(human(), {.avoid = true}), later(human(), {.avoid = true});
    first.make(&clip, clip.timeOfFrame(0));
    later.make(&clip, clip.timeOfFrame(1));
    later.make(&clip, clip.timeOfFrame(0));
    CHECK(std::ranges::equal(first.points(), later.points()));
    CHECK(std::ranges::equal(first.jointMatrices(), later.jointMatrices()));
  }
}

TEST_CASE("a pose that no body takes ends after a few steps, and the same way each time") {
  Pose wild = restPose(human().body.skeleton);
  const auto& joints = human().body.skeleton.joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {  // each limb folded through its neighbours
    const vec3 axis = j % 3 == 0 ? vec3(1, 0, 0) : j % 3 == 1 ? vec3(0, 1, 0) : vec3(0, 0, 1);
    const mat4 turn = mat4_cast(glm::angleAxis(j % 2 ? 2.3f : -2.3f, axis));
    const mat4 local = joints[j].rest.matrix() * turn;
    wild.world[j] = (joints[j].parent.valid() ? wild.world[joints[j].parent.value]
                                              : human().body.skeleton.rootTransform) *
                    local;
  }
  FrameMaker maker(human(), {.avoid = true});
  maker.make(wild, 0);
  MESSAGE(maker.report().steps << " steps, " << maker.report().avoid.after.contacts << " pairs left");
  CHECK(maker.report().steps < 30);  // 45 and more where every step is made in halves to the end
  CHECK(std::ranges::all_of(maker.points(),
                            [](const vec4& p) { return std::isfinite(p.x + p.y + p.z + p.w); }));
}

TEST_CASE("a track of another motion and a damaged one are refused") {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "walk.track";
  const Clip &clip = clipNamed("walk"), &run = clipNamed("run");
  const Solved solved = solve(clip);
  const std::uint64_t key = trackKey(human(), clip, solved.options);
  REQUIRE(writeTrack(file, *solved.options.track, key).ok());
  const auto faultOf = [&](std::uint64_t wanted) {
    return readTrack(file, human(), clip, wanted).error().fault;
  };
  CHECK(faultOf(trackKey(human(), run, solved.options)) == Fault::resumeMismatch);
  Scene freed = human();
  freed.holds.clear();
  CHECK(faultOf(trackKey(freed, clip, solved.options)) == Fault::resumeMismatch);
  CHECK(faultOf(trackKey(human(), clip, {.keep = Keep::wall, .avoid = true})) == Fault::resumeMismatch);
  const auto whole = readFile(file);
  REQUIRE(whole.ok());
  std::vector<std::byte> older = *whole;
  older[7] = std::byte('0');  // the last letter of the mark is the edition
  REQUIRE(writeFileAtomically(file, older).ok());
  CHECK(faultOf(key) == Fault::resumeMismatch);
  REQUIRE(writeFileAtomically(file, std::string("VASA: somebody's vessels")).ok());
  CHECK(readTrack(file, human(), clip, key)
            .error()
            .message.find("is no track of a motion; name another file") != std::string::npos);
  for (std::size_t at = 0; at < whole->size(); at += whole->size() / 40 + 1) {
    CAPTURE(at);
    std::vector<std::byte> bytes = *whole;
    REQUIRE(writeFileAtomically(file, std::span(bytes).first(at)).ok());
    CHECK(faultOf(key) == Fault::badInput);
    bytes[at] ^= std::byte(0x40);
    REQUIRE(writeFileAtomically(file, bytes).ok());
    CHECK(faultOf(key) == Fault::badInput);
  }
}
