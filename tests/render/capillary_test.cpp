#include <doctest/doctest.h>

#include <bit>
#include <set>

#include "gpu/gpu_rig.h"
#include "growth/ribbon.h"
#include "reference/ribbon.h"
#include "render/capillary_pass.h"
#include "render/picture.h"
#include "render/renderer.h"
#include "support/growth.h"
#include "support/meshes.h"
#include "support/networks.h"

// Capillaries on the device against their CPU specification, and in pictures.

using namespace vasa;

namespace {

using test::covered;
using test::hashOfPicture;

Camera lookingAt(const test::GrownNetwork& grown, float distance, bool perspective) {
  Camera camera;
  const vec3 middle(grown.points[grown.points.size() / 2]);
  camera.target = middle;
  camera.position = middle + distance * glm::normalize(vec3(0.3f, 0.4f, 1));
  camera.orthographicHeight = perspective ? 0 : distance;
  return camera;
}

constexpr gpu::TargetSpec kTarget{.size = {333, 222}, .samples = VK_SAMPLE_COUNT_1_BIT};

struct RibbonDifference {
  float place = 0;   // in the picture's half widths
  int colour = 0;    // of 255
  float across = 0;  // [rad], times the sine between curve and sight
  std::uint64_t curves = 0, threads = 0, sparse = 0;
};

int byteDifference(std::uint32_t a, std::uint32_t b) {
  int worst = 0;
  for (int shift = 0; shift < 32; shift += 8)
    worst = std::max(worst, std::abs(int(a >> shift & 255u) - int(b >> shift & 255u)));
  return worst;
}

// A ribbon lies across the sight, and a curve that runs towards the eye leaves that direction to rounding: an
// error of the tangent turns it by the error over this sine.
float sineToSight(const Capillary& capillary, const shared::GrowthView& view, float t) {
  const vec3 along(capillary.curve.derivative(t));
  const vec3 toEye =
      view.perspective * (view.eye - vec3(capillary.curve.at(t))) + (1 - view.perspective) * view.eye;
  return glm::length(glm::cross(glm::normalize(along), glm::normalize(toEye)));
}

void compare(RibbonDifference& worst, const shared::CapillaryVertex& found,
             const shared::CapillaryVertex& wanted, float sine) {
  const float place = glm::distance(found.clip, wanted.clip) / std::max(std::abs(wanted.clip.w), 0.05f);
  worst.place = std::max(worst.place, std::isfinite(place) ? place : 1e9f);
  worst.colour = std::max(worst.colour, byteDifference(found.colour, wanted.colour));
  for (int shift = 0; shift < 32; shift += 16)
    worst.across = std::max(
        worst.across,
        sine * float(std::abs(std::int16_t(found.across >> shift) - std::int16_t(wanted.across >> shift))) /
            32767);
}

// Every curve of every batch of a plan, as the device grows it and as the specification does.
RibbonDifference deviceAgainstSpecification(const test::GpuRig& rig, const test::GrownNetwork& grown,
                                            const Camera& camera, const CapillaryWish& wish,
                                            std::uint32_t seed) {
  const TubeSet tubes(rig.device(), grown.network, {.shape = {3, 2}}, 100);
  CapillaryPass pass(rig.device(), kTarget, tubes, grown.rules, grown.beds, wish);
  const gpu::Buffer points = rig.upload(grown.points), knots = rig.upload(grown.frames);
  const shared::GrowthView view = growthView(camera, kTarget.size, seed);
  pass.prepare(grown.points, grown.frames, view);
  pass.setSpanColours(rig.device(), kindColours(grown.network));
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed, seed);
  RibbonDifference worst;
  for (std::size_t b = 0; b < pass.batches(); ++b) {
    rig.run([&](VkCommandBuffer commands) {
      pass.recordUpload(commands);
      pass.recordGrowth(commands, {points.address(), knots.address(), {}}, b);
    });
    const auto found = rig.download<shared::CapillaryVertex>(pass.ring(b));
    const CapillaryBatch& batch = pass.plan().batches[b];
    const std::uint32_t each = ribbonVertices(batch.edges);
    std::vector<shared::CapillaryVertex> wanted(each);
    for (std::uint32_t j = 0; j < batch.jobCount; ++j) {
      const shared::GrowthJob& job = pass.plan().jobs[batch.firstJob + j];
      const std::uint32_t end =
          j + 1 < batch.jobCount ? pass.plan().jobs[batch.firstJob + j + 1].firstCurve : batch.curves;
      const shared::GrowthBed& bed = grown.beds.beds[job.bed];
      CHECK(end - job.firstCurve == grown.rules.treeSize(bed.system, job.levels, job.sparse));
      const auto kind = grown.network.vessels()[grown.beds.spans[bed.stem[job.side].span].vessel].kind;
      for (std::uint32_t curve = job.firstCurve; curve < end; ++curve) {
        const Capillary capillary =
            capillaryAt(scene, job.bed, kBedSides[job.side], job.levels, curve - job.firstCurve, job.sparse);
        const std::uint32_t root = packColour(colourOf(kind));
        if (batch.edges == shared::kThreads)
          writeThread(capillary, view, root, wanted);
        else
          writeRibbon(capillary, view, root, batch.edges, wanted);
        worst.threads += batch.edges == shared::kThreads;
        worst.sparse += job.sparse;
        const bool thread = batch.edges == shared::kThreads;
        const std::uint32_t edges = !thread ? batch.edges : capillary.leaf ? 1 : shared::kThreadEdges;
        for (std::uint32_t v = 0; v < each; ++v) {
          const std::uint32_t corner = std::min(v / 2, edges);
          compare(worst, found[std::size_t(curve) * each + v], wanted[v],
                  sineToSight(capillary, view, float(corner) / float(edges)));
        }
        ++worst.curves;
      }
    }
  }
  CHECK(worst.curves == pass.plan().curves);
  return worst;
}

Growth growthOf(const test::GrownNetwork& grown) { return {grown.rules, grown.beds}; }

struct Picture {
  Image image;
  CapillaryCounts counts;
};

Picture pictureOf(const test::GpuRig& rig, const test::GrownNetwork& grown, const Camera& camera,
                  RenderOptions options) {
  const Growth growth = growthOf(grown);
  options.width = 200;
  options.height = 160;
  options.growth = &growth;
  options.timed = false;
  Renderer renderer(rig.device(), grown.network, {}, options);
  RenderInput input{grown.points, grown.frames, {}, camera, {}};
  input.look.transparent = true;
  renderer.draw(input);
  return {renderer.readBack(), renderer.capillaryCounts()};
}

double opacityOf(const Image& image) {
  double sum = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) sum += image.rgba[i];
  return sum;
}

}  // namespace

TEST_CASE("the device grows what the specification says: generations, edges, seeds, both projections") {
  VASA_REQUIRE_GPU(rig);
  const test::GrownNetwork grown(test::windingNetwork(41, 21));
  struct Case {
    std::uint32_t levels, edges, seed;
    bool perspective;
    float distance = 2, smallest = 0;
  };
  for (const Case& c : {Case{1, 5, 1, true}, Case{3, 10, 7, true}, Case{3, 5, 7, false}, Case{4, 8, 3, true},
                        Case{3, 0, 7, true, 30, 1e-6f}, Case{2, 0, 7, false, 12, 1e-6f},
                        Case{3, 0, 7, true, 30, 0.05f}, Case{2, 0, 3, false, 12, 0.2f}}) {
    CAPTURE(c.levels);
    CAPTURE(c.edges);
    const CapillaryWish wish{
        .levels = c.levels, .edges = c.edges, .budget = 4'000'000, .smallest = c.smallest};
    const RibbonDifference worst =
        deviceAgainstSpecification(rig, grown, lookingAt(grown, c.distance, c.perspective), wish, c.seed);
    CHECK(worst.threads == (c.edges ? 0 : worst.curves));
    CHECK((worst.sparse > 0) == (c.smallest > 0.01f));
    CHECK(worst.curves > 200);
    CHECK(worst.place <= 1e-4f);
    CHECK(worst.colour <= 1);
    CHECK(worst.across <= 3e-3f);
  }
}

TEST_CASE("the memory for capillaries does not depend on how many there are") {
  VASA_REQUIRE_GPU(rig);
  test::GrownNetwork grown(test::windingNetwork(30, 5));
  const Camera camera = lookingAt(grown, 2, true);
  RenderOptions options;
  options.capillaries = {.levels = 1, .edges = 5, .budget = 1'000'000, .smallest = 0};
  const CapillaryCounts few = pictureOf(rig, grown, camera, options).counts;
  options.capillaries.levels = 6;
  const CapillaryCounts many = pictureOf(rig, grown, camera, options).counts;
  CHECK(many.curves > 20 * few.curves);
  CHECK(many.curves > 2 * shared::kRingCurves);
  CHECK(many.bytes == few.bytes);
  CHECK(many.ringBytes == 2ull * shared::kRingCurves * 22 * 24);
}

TEST_CASE("the same picture twice, whatever was drawn before; another one for another seed") {
  VASA_REQUIRE_GPU(rig);
  const test::GrownNetwork grown(test::windingNetwork(30, 5));
  const Camera camera = lookingAt(grown, 2, true);
  RenderOptions options;
  options.capillaries = {.levels = 3};
  const Picture one = pictureOf(rig, grown, camera, options), two = pictureOf(rig, grown, camera, options);
  CHECK(hashOfPicture(one.image) == hashOfPicture(two.image));
  const Growth growth = growthOf(grown);
  options.width = 200;
  options.height = 160;
  options.timed = false;
  options.growth = &growth;
  Renderer renderer(rig.device(), grown.network, {}, options);
  RenderInput elsewhere{grown.points, grown.frames, {}, lookingAt(grown, 1, false), {}};
  renderer.draw(elsewhere);
  RenderInput input{grown.points, grown.frames, {}, camera, {}};
  input.look.transparent = true;
  renderer.draw(input);
  CHECK(hashOfPicture(renderer.readBack()) == hashOfPicture(one.image));
  options.seed = 2;
  CHECK(hashOfPicture(pictureOf(rig, grown, camera, options).image) != hashOfPicture(one.image));
}

TEST_CASE("more generations cover more of the picture; hidden vessels have none") {
  VASA_REQUIRE_GPU(rig);
  const test::GrownNetwork grown(test::windingNetwork(12, 5));
  const Camera camera = lookingAt(grown, 2, true);
  RenderOptions options;
  std::size_t before = 0;
  for (const std::uint32_t levels : {0u, 1u, 2u, 3u}) {
    options.capillaries = {.levels = levels};
    const std::size_t now = covered(pictureOf(rig, grown, camera, options).image);
    CHECK(now > before);
    before = now;
  }
  const Growth growth = growthOf(grown);
  options.width = 200;
  options.height = 160;
  options.growth = &growth;
  Renderer renderer(rig.device(), grown.network, {}, options);
  RenderInput input{grown.points, grown.frames, {}, camera, {}};
  input.look.transparent = true;
  renderer.setSweepColours(std::vector<std::uint32_t>(renderer.sweepCount(), 0));  // alpha 0 hides
  renderer.draw(input);
  CHECK(covered(renderer.readBack()) == 0);
}

TEST_CASE(
    "a picture made in slices is the same to the bit, and one that is left half done leaves nothing behind") {
  VASA_REQUIRE_GPU(rig);
  const test::GrownNetwork grown(test::windingNetwork(60, 5));
  const Growth growth = growthOf(grown);
  RenderOptions options{.width = 120,
                        .height = 90,
                        .growth = &growth,
                        .capillaries = {.levels = 6, .edges = 10, .smallest = 0}};
  options.timed = false;
  Renderer renderer(rig.device(), grown.network, {}, options);
  const RenderInput input{grown.points, grown.frames, {}, lookingAt(grown, 2, true), {}};
  const RenderInput other{grown.points, grown.frames, {}, lookingAt(grown, 1, true), {}};
  renderer.draw(input);
  const std::uint64_t wanted = hashOfPicture(renderer.readBack());
  renderer.draw(other);
  const std::uint64_t otherWanted = hashOfPicture(renderer.readBack());
  CHECK(wanted != otherWanted);
  std::size_t slices = 1;
  renderer.begin(input);
  while (renderer.step()) ++slices;
  CHECK(slices > 2);  // several of them capillaries'
  CHECK(hashOfPicture(renderer.readBack()) == wanted);
  renderer.begin(input);
  for (std::size_t i = 0; i + 1 < slices; ++i) CHECK(renderer.step());
  renderer.draw(other);
  CHECK(!renderer.step());
  CHECK(hashOfPicture(renderer.readBack()) == otherWanted);
  renderer.begin(other);
  CHECK(renderer.step());
  renderer.begin(input);
  while (renderer.step()) {
  }
  CHECK(hashOfPicture(renderer.readBack()) == wanted);
  RenderInput bare = input;
  bare.look.capillaryOpacity = 0;
  renderer.draw(bare);
  const std::uint64_t bareWanted = hashOfPicture(renderer.readBack());
  std::size_t fewer = 1;
  renderer.begin(bare);
  while (renderer.step()) ++fewer;
  CHECK(fewer < slices);
  CHECK(hashOfPicture(renderer.readBack()) == bareWanted);
  bare.look.drawArteries = bare.look.drawVeins = bare.look.drawOtherVessels = false;
  renderer.begin(bare);
  while (renderer.step()) {
  }
  const std::uint64_t empty = hashOfPicture(renderer.readBack());
  renderer.draw(bare);
  CHECK(hashOfPicture(renderer.readBack()) == empty);
}

TEST_CASE("what a renderer takes later looks as if it had been made with it; meshes can be another's") {
  VASA_REQUIRE_GPU(rig);
  const test::GrownNetwork first(test::windingNetwork(40, 5)), second(test::branchingNetwork(50, 3));
  const Growth growth = growthOf(first), otherGrowth = growthOf(second);
  const std::vector<SkinnedMesh> meshes{test::boxMesh("bones", {-0.2f, -0.2f, 0.2f}, {0.2f, 0.2f, 0.6f}),
                                        test::boxMesh("organs", {-0.3f, -0.3f, 0.1f}, {0.3f, 0.3f, 0.7f}),
                                        test::boxMesh("skin", {-0.5f, -0.4f, 0}, {0.5f, 0.4f, 1})};
  const BodyLevels levels = bodyLevels(meshes, nullptr);
  const std::vector<mat4> joints{mat4(1)};
  RenderOptions options{.width = 120, .height = 90, .levels = &levels};
  options.timed = false;
  const auto pictureBy = [&](Renderer& renderer, const test::GrownNetwork& grown) {
    const RenderInput input{grown.points, grown.frames, joints, lookingAt(grown, 2, true), {}};
    renderer.begin(input);
    while (renderer.step()) {
    }
    const std::uint64_t sliced = hashOfPicture(renderer.readBack());
    renderer.draw(input);
    CHECK(hashOfPicture(renderer.readBack()) == sliced);
    return sliced;
  };
  const CapillaryWish few{.levels = 2}, many{.levels = 4};
  Renderer renderer(rig.device(), first.network, meshes, options);
  const auto same = [&](const test::GrownNetwork& grown, const RenderOptions& with, const Growth* grows,
                        const CapillaryWish& wish) {
    RenderOptions own = with;
    own.growth = grows;
    own.capillaries = wish;
    Renderer fresh(rig.device(), grown.network, meshes, own);
    Renderer sharing(rig.device(), grown.network, renderer, own);
    const std::uint64_t wanted = pictureBy(fresh, grown);
    CHECK(pictureBy(sharing, grown) == wanted);
    CHECK(pictureBy(renderer, grown) == wanted);
    return wanted;
  };
  std::set<std::uint64_t> pictures;
  pictures.insert(same(first, options, nullptr, {}));
  renderer.grow(&growth, few);
  pictures.insert(same(first, options, &growth, few));
  renderer.grow(&growth, many);
  pictures.insert(same(first, options, &growth, many));
  RenderOptions coarse = options;
  coarse.shape = {4, 3};
  renderer.take(first.network, coarse);
  pictures.insert(same(first, coarse, nullptr, {}));
  RenderOptions bySize = options;
  bySize.pixelError = 1;
  renderer.take(second.network, bySize);
  pictures.insert(same(second, bySize, nullptr, {}));
  renderer.grow(&otherGrowth, few);
  pictures.insert(same(second, bySize, &otherGrowth, few));
  renderer.grow(nullptr, {});
  same(second, bySize, nullptr, {});
  CHECK(pictures.size() == 6);
}

// Polylines of more edges are longer, and lie over themselves in bends. Where curves of five edges and more
// hid one another, a third of this was left.
TEST_CASE("curves of more edges are smoother, and hide one another no more") {
  VASA_REQUIRE_GPU(rig);
  const test::GrownNetwork grown(test::windingNetwork(10, 5));
  const Camera camera = lookingAt(grown, 12, true);
  RenderOptions options;
  const double none = opacityOf(pictureOf(rig, grown, camera, options).image);
  const auto added = [&](std::uint32_t edges) {
    options.capillaries = {.levels = 3, .edges = edges, .smallest = 0};
    return opacityOf(pictureOf(rig, grown, camera, options).image) - none;
  };
  const double few = added(3);
  for (const std::uint32_t edges : {5u, 8u, 10u}) {
    const double share = added(edges) / few;
    CHECK(share > 1);
    CHECK(share < 1.3);
  }
}

TEST_CASE("threads look as ribbons do") {
  VASA_REQUIRE_GPU(rig);
  const test::GrownNetwork grown(test::windingNetwork(10, 5));
  const Camera camera = lookingAt(grown, 6, true);
  RenderOptions options;
  const double none = opacityOf(pictureOf(rig, grown, camera, options).image);
  options.capillaries = {.levels = 3, .smallest = 0};
  const double ribbons = opacityOf(pictureOf(rig, grown, camera, options).image) - none;
  options.capillaries.smallest = 1e-6f;
  const double threads = opacityOf(pictureOf(rig, grown, camera, options).image) - none;
  REQUIRE(ribbons > 0.1 * none);
  CHECK(threads != ribbons);
  CHECK(threads / ribbons == doctest::Approx(1).epsilon(0.2));
}
