#include "viewer/loader.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <ctime>
#include <fstream>
#include <thread>

#include "support/kept_once.h"
#include "support/shared_data.h"
#include "viewer/human_data.h"

using namespace vasa;
using namespace vasa::viewer;
using namespace vasa::test;

namespace {

// A helix of a tube as a binary STL: one element, far more triangles than any vessel has.
std::filesystem::path largeMesh(const std::filesystem::path& folder, std::uint32_t rings) {
  constexpr std::uint32_t around = 64;
  const auto place = [&](std::uint32_t ring, std::uint32_t side) {
    const float along = 40.0f * float(ring) / float(rings), turn = 2 * kPi * float(side) / around;
    const vec3 centre(0.1f * std::cos(along), 1 + 0.01f * along, 0.1f * std::sin(along));
    const vec3 out = glm::normalize(vec3(centre.x, 0, centre.z));
    return centre + 0.004f * (std::cos(turn) * out + std::sin(turn) * vec3(0, 1, 0));
  };
  std::string bytes(80, ' ');
  const std::uint32_t count = 2 * around * rings;
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  const auto triangle = [&](vec3 a, vec3 b, vec3 c) {
    const vec3 corners[] = {vec3(0), a, b, c};
    bytes.append(reinterpret_cast<const char*>(corners), 48);
    bytes.append(2, '\0');
  };
  for (std::uint32_t ring = 0; ring < rings; ++ring)
    for (std::uint32_t side = 0; side < around; ++side) {
      const vec3 a = place(ring, side), b = place(ring, (side + 1) % around), c = place(ring + 1, side),
                 d = place(ring + 1, (side + 1) % around);
      triangle(a, b, c);
      triangle(b, d, c);
    }
  const auto path = folder / "large.stl";
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

// [ms] of processor time, which other work on the machine does not lengthen.
double workedMs() { return 1000.0 * double(std::clock()) / CLOCKS_PER_SEC; }

// How much is still done after loading was cancelled [ms of processor time], for the worst of some moments.
double slowestStop(const SceneFile& file, double lastMs) {
  double slowest = 0;
  constexpr int kMoments = 4;
  for (int i = 0; i < kMoments; ++i) {
    double stopped = 0;
    {
      Loader loader;
      loader.start({"scene", [file] { return file; }, {kData / "growth"}}, [] {});
      std::this_thread::sleep_for(
          std::chrono::microseconds(std::int64_t(1000 * lastMs * (i + 0.5) / kMoments)));
      stopped = workedMs();
      loader.stop();
    }
    slowest = std::max(slowest, workedMs() - stopped);
  }
  return slowest;
}

struct Taken {
  double ms, workedMs;
};

Taken timeLoading(const SceneFile& file) {
  const auto start = std::chrono::steady_clock::now();
  const double before = workedMs();
  Loader loader;
  loader.start({"scene", [file] { return file; }, {kData / "growth"}}, [] {});
  loader.wait();
  return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(),
          workedMs() - before};
}

}  // namespace

TEST_CASE("a scene that is being loaded can be given up at any moment, and is soon left") {
  const Taken whole = timeLoading(humanFile());
  const double slowest = slowestStop(humanFile(), whole.ms);
  MESSAGE("loading takes " << whole.workedMs << " ms of a processor, stopping at most " << slowest);
  CHECK(slowest < 0.5 * whole.workedMs);
}

TEST_CASE("so can what capillaries grow from, which is settled behind a loaded scene") {
  {
    const KeptOnce kept;  // all but where they grow
    Loader loader;
    loader.start({"scene", [] { return humanFile(); }, {}}, [] {});
    loader.wait();
    REQUIRE(*loader.take());
  }
  const KeptOnce kept(false);
  const auto settle = [](double ms) {
    Loader loader;
    loader.start({"scene", [] { return humanFile(); }, {kData / "growth"}}, [] {});
    loader.wait();
    auto answer = loader.take();
    const double began = workedMs();
    if (ms < 0)
      (**answer)->growth.get();
    else
      std::this_thread::sleep_for(std::chrono::microseconds(std::int64_t(1000 * ms)));
    const double stopped = workedMs();
    answer.reset();
    return ms < 0 ? stopped - began : workedMs() - stopped;
  };
  const double whole = settle(-1);
  double slowest = 0;
  constexpr int kMoments = 4;
  for (int i = 0; i < kMoments; ++i) slowest = std::max(slowest, settle(whole * (i + 0.5) / (2 * kMoments)));
  MESSAGE("settling takes " << whole << " ms of a processor, stopping at most " << slowest);
  CHECK(slowest < 0.2 * whole);
}

TEST_CASE("so can the conversion of one very large mesh") {
  const TemporaryFolder folder;
  SceneFile file = humanFile();
  file.networks = {largeMesh(folder.path(), 2000)};
  const Taken whole = timeLoading(file);
  const double slowest = slowestStop(file, whole.ms);
  MESSAGE("converting takes " << whole.workedMs << " ms of a processor, stopping at most " << slowest);
  CHECK(slowest < 0.5 * whole.workedMs);
}

TEST_CASE("what is loaded next is not held up by what was given up, and tells what it does") {
  const KeptOnce kept;
  Loader loader;
  std::atomic<int> told{0};
  loader.start({"first", [] { return humanFile(); }, {}}, [] {});
  loader.start({"second", [] { return humanFile(); }, {}}, [&] { ++told; });
  CHECK(loader.title() == "second");
  CHECK(loader.busy());
  loader.wait();
  const auto answer = loader.take();
  REQUIRE(answer);
  REQUIRE(*answer);
  CHECK((**answer)->scene.network.vessels().size() > 100);
  CHECK(told > 4);
  CHECK_FALSE(loader.busy());
  loader.stop();
  CHECK(loader.takeStopTimes().size() == 1);
}

TEST_CASE("what cannot be loaded says why") {
  Loader loader;
  loader.start({"nothing", [] { return badInput("no scene"); }, {}}, [] {});
  loader.wait();
  const auto answer = loader.take();
  REQUIRE(answer);
  CHECK_FALSE(*answer);
  CHECK(answer->error().message == "no scene");
}
