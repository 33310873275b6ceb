#include <cmath>

#include "golden/gallery.h"
#include "network/builder.h"
#include "network/measure.h"
#include "render/renderer.h"
#include "support/growth.h"
#include "support/networks.h"

namespace vasa::golden {
namespace {

// What is drawn of a network, from where, and how finely.
struct Shot {
  Network (*network)() = nullptr;
  vec3 from{0, 0, 1};  // direction of view, as the camera stands off the middle
  float nearer = 1;    // 0.3: close up
  RenderOptions options;
  LookStyle style = LookStyle::atlas;
  std::uint32_t growLevels = 0;
  unsigned system = 2;  // of the capillaries: 0, 1, or 2 for both
  float arteryOpacity = 1, capillaryOpacity = 1;
  bool others = true;                                              // vessels that are neither artery nor vein
  std::vector<std::uint32_t> (*colours)(std::uint32_t) = nullptr;  // of so many sweeps; none: by kind
};

RenderOptions fixed(std::uint32_t around, std::uint32_t along) {
  return {.samples = 4, .shape = {around, along}, .timed = false};
}

RenderOptions one(RenderOptions options) {
  options.samples = 1;
  return options;
}
RenderOptions shrunk(RenderOptions options) {
  options.samples = 1;
  options.supersample = 3;
  return options;
}
RenderOptions unjoined(RenderOptions options) {
  options.forks = false;
  return options;
}

RenderOptions automatic() { return {.samples = 4, .pixelError = kAutoPixelError, .timed = false}; }

Camera cameraOf(const Shot& shot, const Aabb& box) {
  Camera camera = cameraFrom(View::front, box, float(kWidth) / kHeight);
  const float distance = glm::distance(camera.position, camera.target) * shot.nearer;
  camera.position = camera.target + distance * glm::normalize(shot.from);
  return camera;
}

Image draw(gpu::Device& device, Shot shot) {
  test::GrownNetwork grown(shot.network());
  if (shot.system < 2)
    for (shared::GrowthBed& bed : grown.beds.beds) bed.system = shot.system;
  const Growth growth{grown.rules, grown.beds};
  shot.options.width = kWidth;
  shot.options.height = kHeight;
  if (shot.growLevels > 0) {
    shot.options.growth = &growth;
    shot.options.capillaries = {.levels = shot.growLevels, .smallest = 0};
  }
  Renderer renderer(device, grown.network, {}, shot.options);
  RenderInput input{.points = grown.points, .knotFrames = grown.frames};
  input.camera = cameraOf(shot, measure(grown.network, grown.points).bounds);
  input.look.style = shot.style;
  // Light that shines through adds up: on white there is nothing to see.
  input.look.background = shot.style == LookStyle::xray ? vec4(0, 0, 0, 1) : vec4(1);
  input.look.arteryOpacity = shot.arteryOpacity;
  input.look.capillaryOpacity = shot.capillaryOpacity;
  input.look.drawOtherVessels = shot.others;
  if (shot.colours) renderer.setSweepColours(shot.colours(renderer.sweepCount()));
  renderer.draw(input);
  return renderer.readBack();
}

Picture picture(std::string name, const Shot& shot) {
  return {std::move(name), [shot](gpu::Device& device) { return draw(device, shot); }};
}

std::vector<vec4> line(vec3 from, vec3 to, float r0, float r1, vec3 bow = vec3(0)) {
  std::vector<vec4> points;
  for (int i = 0; i <= 8; ++i) {
    const float t = float(i) / 8;
    points.emplace_back(glm::mix(from, to, t) + bow * (4 * t * (1 - t)), std::lerp(r0, r1, t));
  }
  return points;
}

Network built(const NetworkBuilder& builder) { return *builder.build(1); }

Network winding() { return test::windingNetwork(40, 9); }
Network thinWinding() { return test::windingNetwork(300, 7); }
Network tapered() { return test::straightVessel(0.4f, 0.06f, 0.01f, 5); }

Network bow() {
  NetworkBuilder builder;
  builder.addVessel({"bow", "", VesselKind::vein},
                    line({-0.2f, 0, 0}, {0.2f, 0, 0}, 0.03f, 0.02f, {0, 0.2f, 0}));
  return built(builder);
}

// Bends one way and the other, thinner towards its end.
Network snake() {
  NetworkBuilder builder;
  std::vector<vec4> points;
  for (int i = 0; i <= 12; ++i) {
    const float x = float(i) / 12;
    points.emplace_back(0.5f * x, 0.1f * std::sin(9 * x), 0.06f * std::cos(7 * x), 0.035f - 0.025f * x);
  }
  builder.addVessel({"snake", "", VesselKind::artery}, points);
  return built(builder);
}

// Vessels that leave one place, along directions around the z axis.
Network star(std::initializer_list<float> degrees, float radius) {
  NetworkBuilder builder;
  std::vector<VesselEnd> ends;
  for (const float d : degrees) {
    const float a = d * kPi / 180;
    ends.push_back({builder.addVessel(
                        {"arm " + std::to_string(ends.size()), "", VesselKind::artery},
                        line(vec3(0), 0.3f * vec3(std::cos(a), std::sin(a), 0.05f), radius, 0.7f * radius)),
                    false});
  }
  builder.joinEnds(ends);
  return built(builder);
}

Network tee(float angle, float ratio) {
  NetworkBuilder builder;
  const VesselId trunk =
      builder.addVessel({"trunk", "", VesselKind::artery}, line({0, -0.3f, 0}, {0, 0.3f, 0}, 0.05f, 0.045f));
  const vec3 way(std::sin(angle), std::cos(angle), 0.2f);
  const VesselId branch = builder.addVessel({"branch", "", VesselKind::artery},
                                            line(vec3(0), 0.3f * way, 0.05f * ratio, 0.04f * ratio));
  builder.joinToSide({branch, false}, {trunk, 3});
  return built(builder);
}

// A vessel of every kind, one above the other.
Network allKinds() {
  NetworkBuilder builder;
  for (int kind = 0; kind <= int(VesselKind::other); ++kind) {
    const float y = 0.1f * float(kind);
    builder.addVessel({std::string(kindName(VesselKind(kind))), "", VesselKind(kind)},
                      line({-0.3f, y, 0}, {0.3f, y, 0}, 0.04f, 0.02f, {0, 0.05f, 0}));
  }
  return built(builder);
}

// An artery before a vein, so that one may be seen through the other.
Network crossed() {
  NetworkBuilder builder;
  builder.addVessel({"behind", "", VesselKind::vein},
                    line({-0.3f, 0, -0.1f}, {0.3f, 0, -0.1f}, 0.05f, 0.05f));
  builder.addVessel({"before", "", VesselKind::artery},
                    line({0, -0.2f, 0.1f}, {0, 0.2f, 0.1f}, 0.06f, 0.06f));
  return built(builder);
}

// From yellow to blue, sweep after sweep; of the others every third is hidden.
std::vector<std::uint32_t> fading(std::uint32_t sweeps) {
  std::vector<std::uint32_t> colours;
  for (std::uint32_t i = 0; i < sweeps; ++i) {
    const float t = float(i) / float(sweeps);
    colours.push_back(packColour({1 - t, 1 - t, t, 1}));
  }
  return colours;
}
std::vector<std::uint32_t> gaps(std::uint32_t sweeps) {
  auto colours = fading(sweeps);
  for (std::uint32_t i = 2; i < sweeps; i += 3) colours[i] = 0;
  return colours;
}

Network yFork() { return star({-90, 55, 125}, 0.04f); }
Network sharpFork() { return star({-90, 75, 105}, 0.03f); }
Network crossing() { return star({0, 90, 180, 270}, 0.035f); }
Network fiveWay() { return star({0, 72, 144, 216, 288}, 0.03f); }
Network smallTee() { return tee(1.57f, 0.25f); }
Network largeTee() { return tee(1.0f, 0.8f); }
Network otherTee() { return tee(1.0f, 0.6f); }

}  // namespace

std::vector<Picture> syntheticPictures() {
  return {
      picture("tubes/winding", {.network = winding, .options = fixed(8, 5)}),
      picture("tubes/coarsest", {.network = snake, .options = fixed(3, 2)}),
      picture("tubes/finest", {.network = snake, .options = fixed(16, 20)}),
      picture("tubes/paper_4x5", {.network = snake, .options = fixed(4, 5)}),
      picture("tubes/paper_8x10", {.network = snake, .options = fixed(8, 10)}),
      picture("tubes/automatic_near", {.network = snake, .nearer = 0.4f, .options = automatic()}),
      picture("tubes/automatic_far", {.network = thinWinding, .options = automatic()}),
      picture("tubes/bow", {.network = bow, .options = automatic()}),
      picture("tubes/one_sample", {.network = snake, .options = one(automatic())}),
      picture("tubes/supersampled", {.network = thinWinding, .options = shrunk(automatic())}),
      picture("forks/coloured", {.network = crossing, .options = automatic(), .colours = fading}),
      picture("kinds/atlas", {.network = allKinds, .options = automatic()}),
      picture("kinds/clinical", {.network = allKinds, .options = automatic(), .style = LookStyle::clinical}),
      picture("kinds/xray", {.network = allKinds, .options = automatic(), .style = LookStyle::xray}),
      picture("colours/fading", {.network = snake, .options = automatic(), .colours = fading}),
      picture("colours/gaps", {.network = snake, .options = automatic(), .colours = gaps}),
      picture("opacity/half", {.network = crossed, .options = automatic(), .arteryOpacity = 0.5f}),
      picture("caps/thick_end", {.network = tapered, .from = {0.4f, 0.3f, -1}, .options = fixed(16, 4)}),
      picture("caps/thin_end", {.network = tapered, .from = {0.6f, 0.3f, 1}, .options = fixed(8, 2)}),
      picture("forks/y", {.network = yFork, .from = {0.2f, 0.1f, 1}, .options = automatic()}),
      picture("forks/sharp", {.network = sharpFork, .options = automatic()}),
      picture("forks/crossing", {.network = crossing, .from = {0.3f, 0.4f, 1}, .options = automatic()}),
      picture("forks/five", {.network = fiveWay, .from = {0.1f, 0.3f, 1}, .options = automatic()}),
      picture("forks/small_tee", {.network = smallTee, .from = {0.5f, 0.1f, 1}, .options = automatic()}),
      picture("forks/large_tee", {.network = largeTee, .from = {0.4f, 0.1f, 1}, .options = automatic()}),
      picture("forks/coarse", {.network = largeTee, .from = {0.4f, 0.1f, 1}, .options = fixed(4, 2)}),
      picture("forks/unjoined",
              {.network = largeTee, .from = {0.4f, 0.1f, 1}, .options = unjoined(automatic())}),
      picture("forks/clinical", {.network = largeTee,
                                 .from = {-0.4f, 0.1f, 1},
                                 .options = automatic(),
                                 .style = LookStyle::clinical}),
      picture("capillaries/oak_1", {.network = bow, .options = automatic(), .growLevels = 1, .system = 0}),
      picture("capillaries/oak_2", {.network = bow, .options = automatic(), .growLevels = 2, .system = 0}),
      picture("capillaries/oak_3", {.network = bow, .options = automatic(), .growLevels = 3, .system = 0}),
      picture("capillaries/reed_2", {.network = bow, .options = automatic(), .growLevels = 2, .system = 1}),
      picture("capillaries/reed_4",
              {.network = bow, .nearer = 0.6f, .options = automatic(), .growLevels = 4, .system = 1}),
      picture(
          "capillaries/faint",
          {.network = bow, .options = automatic(), .growLevels = 3, .system = 0, .capillaryOpacity = 0.3f}),
  };
}

std::vector<Picture> syntheticMutations() {
  return {
      picture("tubes/paper_8x10", {.network = snake, .options = fixed(4, 5)}),
      picture("caps/thick_end", {.network = tapered, .from = {0.4f, 0.3f, -1}, .options = fixed(4, 4)}),
      picture("forks/large_tee", {.network = otherTee, .from = {0.4f, 0.1f, 1}, .options = automatic()}),
      picture("forks/unjoined", {.network = largeTee, .from = {0.4f, 0.1f, 1}, .options = automatic()}),
      picture("forks/coloured", {.network = crossing, .options = automatic(), .colours = gaps}),
      picture("capillaries/oak_2", {.network = bow, .options = automatic(), .growLevels = 2, .system = 1}),
      picture("capillaries/faint", {.network = bow, .options = automatic(), .growLevels = 3, .system = 0}),
      picture("kinds/atlas", {.network = allKinds, .options = automatic(), .others = false}),
      picture("colours/gaps", {.network = snake, .options = automatic(), .colours = fading}),
      picture("opacity/half", {.network = crossed, .options = automatic(), .arteryOpacity = 0.7f}),
  };
}

}  // namespace vasa::golden
