#include "pose_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "atlas/colouring.h"
#include "plate/chart_paper.h"
#include "plate/lettering.h"
#include "render/camera.h"
#include "render/renderer.h"
#include "scene/frame.h"

namespace vasa::cli {
namespace {

constexpr float kLetters = 15;  // [pixels]
constexpr int kRowHeight = 24, kMargin = 20, kPerDegree = 3, kTick = 30;

using plate::blank;
using plate::fill;
using plate::Lettering;
using Align = Lettering::Align;

// Between colours at 0, 1, 2 …
template <std::size_t N>
vec3 blend(const std::array<vec3, N>& colours, float at) {
  at = std::clamp(at, 0.0f, float(N - 1));
  const std::size_t first = std::min(std::size_t(at), N - 2);
  return glm::mix(colours[first], colours[first + 1], at - float(first));
}

// Nothing, half of the limit, the limit, twice the limit: lightness falls all the way.
vec3 heat(float severity) {
  static constexpr std::array kHeat{vec3(0.93f, 0.95f, 0.96f), vec3(0.99f, 0.86f, 0.55f),
                                    vec3(0.87f, 0.40f, 0.27f), vec3(0.40f, 0.05f, 0.15f)};
  return blend(kHeat, severity <= 1 ? 2 * severity : 1 + severity);
}

// A bar with the colours from one end of a scale to the other.
template <class ColourOf>
void legend(Image& picture, const Lettering& letters, int left, int top,
            std::span<const std::pair<float, std::string>> marks, const ColourOf& colourOf) {
  constexpr int kWidth = 240, kHeight = 12;
  const float low = marks.front().first, high = marks.back().first;
  for (int x = 0; x < kWidth; ++x)
    fill(picture, left + x, top, left + x + 1, top + kHeight,
         colourOf(glm::mix(low, high, (float(x) + 0.5f) / kWidth)));
  for (const auto& [value, text] : marks)
    letters.write(picture, left + int(std::lround(kWidth * (value - low) / (high - low))), top + kHeight + 18,
                  text, Align::centre);
}

}  // namespace

Result<Image> drawHeatMap(const HeatMap& map) {
  const auto letters = Lettering::load(kLetters), title = Lettering::load(1.3f * kLetters);
  if (!letters) return letters.error();
  if (!title) return title.error();
  float low = 0, high = 0;
  int names = 0;
  for (const HeatMap::Row& row : map.rows) {
    names = std::max(names, letters->widthOf(row.name));
    for (const HeatMap::Cell& cell : row.cells)
      low = std::min(low, cell.from), high = std::max(high, cell.to);
  }
  const int left = kMargin + names + 12, top = 64, plot = int(std::ceil((high - low) * kPerDegree));
  const int bottom = top + kRowHeight * int(map.rows.size());
  Image picture = blank(std::max(left + plot, title->widthOf(map.title) + kMargin) + kMargin, bottom + 116);
  title->write(picture, kMargin, 34, map.title);
  const auto x = [&](float degrees) { return left + int(std::lround((degrees - low) * kPerDegree)); };
  for (std::size_t r = 0; r < map.rows.size(); ++r) {
    const int y = top + kRowHeight * int(r);
    letters->write(picture, left - 12, y + kRowHeight / 2 + 5, map.rows[r].name, Align::right);
    for (const HeatMap::Cell& cell : map.rows[r].cells)
      fill(picture, x(cell.from), y + 1, x(cell.to), y + kRowHeight - 1, heat(cell.severity));
  }
  for (int tick = int(std::ceil(low / kTick)) * kTick; float(tick) <= high; tick += kTick) {
    fill(picture, x(float(tick)), bottom, x(float(tick)) + 1, bottom + 5, vec3(0.4f));
    letters->write(picture, x(float(tick)), bottom + 21, fmt::format("{}°", tick), Align::centre);
  }
  letters->write(picture, left + plot / 2, bottom + 44, map.axis, Align::centre);
  const std::array<std::pair<float, std::string>, 3> marks{{{0, "free"}, {1, "at a limit"}, {2, "twice it"}}};
  legend(picture, *letters, left, bottom + 70, marks, heat);
  return picture;
}

Result<Image> drawStrains(const Scene& scene, std::span<const float> strains, float full,
                          gpu::Device& device) {
  const auto letters = Lettering::load(kLetters);
  if (!letters) return letters.error();
  constexpr std::uint32_t kWidth = 640, kHeight = 1200;
  Renderer renderer(
      device, scene.network, scene.body.meshes,
      {.width = kWidth, .height = kHeight, .supersample = 2, .occlusion = true, .timed = false});
  const atlas::ColourLegend scale = atlas::legendOf(scene.network, {}, atlas::Colouring::strain);
  const auto colourOf = [&](float strain) { return scale.at(0.5f + 0.5f * strain / full); };
  std::vector<std::uint32_t> colours;
  for (std::size_t v = 0; v < strains.size(); ++v)
    colours.insert(colours.end(), scene.network.vessels()[v].spanCount(),
                   packColour(vec4(colourOf(strains[v]), 1)));
  renderer.setSweepColours(colours);
  FrameMaker maker(scene);
  maker.make(nullptr, 0);
  Look look = lookNamed("atlas").value_or(Look{});
  look.background = vec4(1);
  look.boneOpacity = 0.4f, look.drawHeart = false;
  const Aabb box = motionBounds(scene, nullptr);
  const Camera camera = focusOn({.position = box.centre() + vec3(0, 0, 1),
                                 .target = box.centre(),
                                 .up = vec3(0, 1, 0),
                                 .verticalAngle = 0.35f},
                                box, float(kWidth) / float(kHeight));
  renderer.draw({.points = maker.points(),
                 .knotFrames = maker.knotFrames(),
                 .jointMatrices = maker.jointMatrices(),
                 .camera = camera,
                 .look = look});
  Image picture = renderer.readBack();
  const auto percent = [](float share) { return fmt::format("{:+.0f} %", 100 * share); };
  const std::array<std::pair<float, std::string>, 3> marks{
      {{-full, percent(-full)}, {0, "length at rest"}, {full, percent(full)}}};
  legend(picture, *letters, int(kWidth) / 2 - 120, int(kHeight) - 44, marks, colourOf);
  return picture;
}

}  // namespace vasa::cli
