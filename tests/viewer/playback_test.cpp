#include "viewer/playback.h"

#include <doctest/doctest.h>

using namespace vasa;
using namespace vasa::viewer;

namespace {

Clip twoSeconds() {
  Clip clip;
  clip.start = 1;
  clip.end = 3;
  clip.framesPerSecond = 10;
  return clip;
}

}  // namespace

TEST_CASE("time goes on while playing, and starts anew at the end") {
  const Clip clip = twoSeconds();
  Playback playback{.clip = 0, .time = 1};
  playback.advance(clip, 0.5);
  CHECK(playback.time == 1);
  playback.playing = true;
  playback.advance(clip, 0.5);
  CHECK(playback.time == doctest::Approx(1.5));
  playback.advance(clip, 1.75);
  CHECK(playback.time == doctest::Approx(1.25));
  playback.speed = -1;
  playback.advance(clip, 0.5);
  CHECK(playback.time == doctest::Approx(2.75));
}

TEST_CASE("without a loop it stops at the end it runs to") {
  const Clip clip = twoSeconds();
  Playback playback{.clip = 0, .time = 2.9f, .playing = true, .loop = false};
  playback.advance(clip, 0.5);
  CHECK(playback.time == 3);
  CHECK_FALSE(playback.playing);
  playback.playing = true;
  playback.speed = -2;
  playback.advance(clip, 5);
  CHECK(playback.time == 1);
}

TEST_CASE("steps go by whole frames and stop playing") {
  const Clip clip = twoSeconds();
  Playback playback{.clip = 0, .time = 1.52f, .playing = true};
  CHECK(playback.frame(clip) == 5);
  playback.step(clip, 1);
  CHECK(playback.time == doctest::Approx(1.6));
  CHECK_FALSE(playback.playing);
  playback.step(clip, -100);
  CHECK(playback.time == 1);
  playback.step(clip, 100);
  CHECK(playback.time == doctest::Approx(3));
}

TEST_CASE("a clip of one moment does not run") {
  Clip clip;
  Playback playback{.clip = 0, .time = 0, .playing = true};
  playback.advance(clip, 1);
  CHECK(playback.time == 0);
}
