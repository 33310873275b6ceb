#include "plate/plate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/mesh_role.h"
#include "body/skinning.h"
#include "plate/plate_measures.h"
#include "surface/surface_mesh.h"

namespace vasa::plate {
namespace {

constexpr float kPictureMargin = 1.03f;  // of what the camera was fitted to
constexpr float kCell = 0.3f;            // [mm] of paper that a cell of the map takes
constexpr float kFade = 0.06f;           // of the picture's longer side
constexpr float kLegible = 0.5f;         // of the picture: no label points at what remains less of
constexpr float kOpaque = 0.5f;          // what is drawn with less lets labels point through
constexpr float kNarrowestColumn = 0.145f, kWidestColumn = 0.2f;  // of the page's width
constexpr float kWidestText = 20;                                 // ems of a label
constexpr float kMainArea = 2;                                    // [mm²] that a main vessel shows on paper
constexpr float kMainWidth = 0.3f;                                // [mm] of it on paper
constexpr float kAbove = 0.42f;     // of the height that a picture leaves: it rests a little above the middle
constexpr float kColumnGap = 2.0f;  // [mm] between the lines' level parts and the picture
constexpr float kLabelGap = 1.0f;   // [mm] between texts
constexpr SweepShape kMapShape{8, 4};

bool isDrawn(const Look& look, MeshRole role) {
  switch (role) {
    case MeshRole::bones:
      return look.drawBones && look.boneOpacity > kOpaque;
    case MeshRole::heart:
      return look.drawHeart && look.heartOpacity > kOpaque;
    case MeshRole::skin:
      return look.drawSkin && look.skinOpacity > kOpaque;
    case MeshRole::other:
      return look.drawOther && look.otherOpacity > kOpaque;
    case MeshRole::organs:  // they always let vessels shine through
    case MeshRole::keepOut:
      break;
  }
  return false;
}

// What is drawn, as triangles of the pose.
struct DrawnPart {
  std::vector<vec3> positions;
  const std::vector<uvec3>* triangles;
  bool hides;  // what lies behind it
};

struct DrawnParts {
  std::vector<DrawnPart> meshes;
  SurfaceMesh vessels;
};

DrawnParts drawnParts(const PlateScene& scene) {
  DrawnParts parts;
  const std::vector<mat4> matrices(scene.frame.jointMatrices().begin(), scene.frame.jointMatrices().end());
  for (const SkinnedMesh& mesh : scene.meshes) {
    parts.meshes.push_back({{}, &mesh.mesh.triangles, isDrawn(scene.look, roleNamed(mesh.name))});
    skinPositions(mesh, matrices, parts.meshes.back().positions);
  }
  parts.vessels = surfaceMesh({scene.table, scene.frame.points(), scene.frame.knotFrames()}, kMapShape);
  return parts;
}

bool isDrawn(const PlateScene& scene, std::uint32_t vessel) {
  return scene.vessels[vessel] && draws(scene.look, scene.scene.network.vessels()[vessel].kind);
}

// Vessels by their index, what hides them by the number behind the last.
SeenMap mapOf(const PlateScene& scene, const DrawnParts& parts, const Camera& camera, std::uint32_t width,
              std::uint32_t height) {
  SeenMap map(camera, width, height);
  const auto solid = std::uint32_t(scene.scene.network.vessels().size());
  for (const DrawnPart& part : parts.meshes)
    if (part.hides) map.draw(part.positions, *part.triangles, [&](std::uint32_t) { return solid; });
  map.draw(parts.vessels.positions, parts.vessels.triangles, [&](std::uint32_t t) {
    const std::uint32_t vessel = parts.vessels.vesselOfVertex[parts.vessels.triangles[t].x];
    return isDrawn(scene, vessel) ? vessel : SeenMap::kNothing;
  });
  return map;
}

// Marks the cells along each edge where a triangle reaches over it.
void markCuts(CutEdges& cut, const SeenMap& seen, std::span<const vec3> positions, const uvec3& triangle) {
  const vec2 size(seen.width(), seen.height());
  vec2 low(1e9f), high(-1e9f), cell;
  for (int k = 0; k < 3; ++k)
    if (seen.project(positions[triangle[k]], cell)) low = glm::min(low, cell), high = glm::max(high, cell);
  for (int edge = 0; edge < 4; ++edge) {
    const int across = edge < 2 ? 0 : 1, along = 1 - across;
    const float at = edge % 2 ? size[across] : 0;
    if (low[across] > at || high[across] < at || high[along] < 0 || low[along] >= size[along]) continue;
    const auto last = std::min(high[along], size[along] - 1);
    for (auto i = std::size_t(std::max(low[along], 0.0f)); float(i) <= last; ++i)
      cut.along[std::size_t(edge)][i] = 1;
  }
}

CutEdges cutEdges(const PlateScene& scene, const DrawnParts& parts, const SeenMap& seen) {
  CutEdges cut;
  for (std::size_t edge = 0; edge < 4; ++edge)
    cut.along[edge].resize(edge < 2 ? seen.height() : seen.width());
  for (const DrawnPart& part : parts.meshes)
    for (const uvec3& triangle : *part.triangles) markCuts(cut, seen, part.positions, triangle);
  for (const uvec3& triangle : parts.vessels.triangles)
    if (isDrawn(scene, parts.vessels.vesselOfVertex[triangle.x]))
      markCuts(cut, seen, parts.vessels.positions, triangle);
  // A fade begins and ends softly along the edge, too.
  const float reach = kFade * float(std::max(seen.width(), seen.height()));
  for (auto& edge : cut.along) {
    std::vector<float> soft(edge.size());
    for (std::size_t i = 0; i < edge.size(); ++i)
      for (std::size_t j = 0; j < edge.size() && edge[i] > 0; ++j)
        soft[j] = std::max(soft[j], 1 - glm::smoothstep(0.3f, 1.0f, std::abs(float(i) - float(j)) / reach));
    edge = std::move(soft);
  }
  return cut;
}

// From where to where something is drawn, as shares of the picture's width.
vec2 drawnWidth(const PlateScene& scene, const DrawnParts& parts, const SeenMap& seen) {
  float low = float(seen.width()), high = 0;
  const auto add = [&](vec3 place) {
    vec2 cell;
    if (!seen.project(place, cell) || cell.y < 0 || cell.y > float(seen.height())) return;
    low = std::min(low, cell.x), high = std::max(high, cell.x);
  };
  for (const DrawnPart& part : parts.meshes)
    for (const uvec3& triangle : *part.triangles) add(part.positions[triangle.x]);
  for (std::size_t i = 0; i < parts.vessels.positions.size(); ++i)
    if (isDrawn(scene, parts.vessels.vesselOfVertex[i])) add(parts.vessels.positions[i]);
  if (low > high) return {0, 1};
  return glm::clamp(vec2(low, high) / float(seen.width()), 0.0f, 1.0f);
}

struct PageLayout {
  float top, bottom;  // of picture and labels
};

PageLayout layoutOf(const PlateStyle& style) {
  PageLayout page{style.margin, style.page.y - style.margin};
  if (!style.title.empty()) page.top += 3.3f * style.letters;
  if (!style.subtitle.empty()) page.top += kTitleStep * style.letters;
  if (!style.title.empty() || !style.subtitle.empty()) page.top += 1.1f * style.letters;
  if (style.legend || style.scale) page.bottom -= 13;
  return page;
}

// Between the columns and the picture.
float besidePicture(const PlateStyle& style) {
  return style.labels.empty() ? 0 : kTextGap + kStub + kColumnGap;
}

float widestColumn(const PlateStyle& style) {
  return std::min(kWidestColumn * style.page.x, kWidestText * style.letters);
}
float narrowestColumn(const PlateStyle& style) {
  return std::min(kNarrowestColumn * style.page.x, widestColumn(style));
}

// As wide as leaves the picture its whole height.
float columnBeside(const PlateStyle& style, const PageLayout& page, float aspect) {
  if (style.labels.empty()) return 0;
  if (style.wideColumns) return widestColumn(style);
  const float room = style.page.x - 2 * (style.margin + besidePicture(style));
  return std::clamp(0.5f * (room - aspect * (page.bottom - page.top)), narrowestColumn(style),
                    widestColumn(style));
}

// The largest picture of an aspect between two columns.
void placePicture(PlatePlan& plan, const PlateStyle& style, const PageLayout& page, float aspect,
                  float columns[2]) {
  const float beside = besidePicture(style);
  const float room = style.page.x - 2 * style.margin - columns[0] - columns[1] - 2 * beside;
  const float width = std::min(room, aspect * (page.bottom - page.top));
  plan.pictureSize = vec2(width, width / aspect);
  // Picture and columns stand in the middle of the page together.
  plan.pictureAt.x = style.margin + columns[0] + beside + 0.5f * (room - width);
  plan.pictureAt.y = page.top + kAbove * (page.bottom - page.top - plan.pictureSize.y);
  plan.columns = {.left = plan.pictureAt.x - kColumnGap,
                  .right = plan.pictureAt.x + width + kColumnGap,
                  .top = page.top,
                  .bottom = page.bottom,
                  .gap = kLabelGap,
                  .clearance = 1.0f};
}

}  // namespace

FittedCamera cameraOnto(std::span<const vec3> places, vec3 towards, vec3 up, std::span<const vec3> drawn) {
  Camera camera{.position = glm::normalize(towards), .target = vec3(0), .up = up};
  const mat3 axes = cameraAxes(camera);
  Aabb box, all;
  for (const vec3& place : places) box.add(place * axes);
  for (const vec3& place : drawn) all.add(place * axes);
  all.add(box);
  const vec3 middle = axes * box.centre();
  const vec2 extent = glm::max(kPictureMargin * vec2(box.extent()), vec2(0.01f));
  const float depth = all.high.z - box.centre().z;
  camera.nearDistance = 0.02f;
  camera.target = middle;
  camera.position = middle + (depth + 0.1f) * axes[2];
  camera.orthographicHeight = extent.y;
  camera.farDistance = all.extent().z + 0.5f;
  return {camera, extent.x / extent.y};
}

vec2 pictureRoom(const PlateStyle& style) {
  const PageLayout page = layoutOf(style);
  const float column = style.labels.empty() ? 0
                       : style.wideColumns  ? widestColumn(style)
                                            : 0.5f * (narrowestColumn(style) + widestColumn(style));
  return glm::max(
      vec2(style.page.x - 2 * (style.margin + column + besidePicture(style)), page.bottom - page.top),
      vec2(1));
}

Result<PlatePlan> planPlate(const PlateScene& scene, const PlateStyle& style, const Typesetter& type,
                            const Camera& camera, float aspect) {
  PlatePlan plan;
  plan.camera = camera;
  const PageLayout page = layoutOf(style);
  const float column = columnBeside(style, page, aspect);
  float columns[2] = {column, column};
  placePicture(plan, style, page, aspect, columns);
  if (plan.pictureSize.x < 10 || plan.pictureSize.y < 10)
    return Error{Fault::usage,
                 fmt::format("a page of {:g} x {:g} mm has no room for a picture between its labels; "
                             "choose a larger one",
                             style.page.x, style.page.y)};
  const auto width = std::uint32_t(std::ceil(plan.pictureSize.x / kCell));
  const auto height = std::uint32_t(std::ceil(plan.pictureSize.y / kCell));
  const DrawnParts parts = drawnParts(scene);
  const SeenMap seen = mapOf(scene, parts, camera, width, height);
  plan.cut = cutEdges(scene, parts, seen);
  plan.seen.resize(scene.vessels.size());
  for (const std::uint32_t what : seen.cells())
    if (what < plan.seen.size()) plan.seen[what] = 1;
  plan.millimetresAMetre = seen.cellsAMetre(camera.target) * plan.pictureSize.y / float(height);
  if (style.labels.empty()) return plan;

  const float lineHeight = kLine * style.letters;
  LabelWishes wishes{.which = style.labels};
  wishes.leastArea = kMainArea / (kCell * kCell);
  wishes.leastWidth = kMainWidth / kCell;
  wishes.of = scene.own;
  const vec2 size(width, height);
  wishes.allowed = [&plan, size](vec2 cell) { return plan.cut.remains(cell, size) >= kLegible; };
  wishes.most = std::size_t(2 * (page.bottom - page.top) / (lineHeight + kLabelGap));
  // A body part on its side has as much to name in lower columns.
  if (style.labels == "main") wishes.most /= style.page.x > style.page.y ? 2 : 3;
  auto choice = chooseLabels(scene.scene.network, scene.frame.points(), seen, wishes);
  if (!choice) return choice.error();
  plan.labels = std::move(choice->labels);
  plan.unseen = std::move(choice->unseen);

  float widest = 0;
  for (const VesselLabel& label : plan.labels) {
    plan.lines.push_back(type.wrap(label.text, style.letters, column));
    for (const std::string& line : plan.lines.back())
      widest = std::max(widest, type.widthOf(line, style.letters));
  }
  if (!style.wideColumns) columns[0] = columns[1] = widest;
  placePicture(plan, style, page, aspect, columns);
  plan.millimetresAMetre = seen.cellsAMetre(camera.target) * plan.pictureSize.y / float(height);
  // Where the picture is empty beside the figure, labels come nearer.
  const vec2 drawn = plan.pictureAt.x + plan.pictureSize.x * drawnWidth(scene, parts, seen);
  plan.columns.left = drawn.x - kColumnGap, plan.columns.right = drawn.y + kColumnGap;
  std::vector<LabelWish> texts;
  for (std::size_t i = 0; i < plan.labels.size(); ++i) {
    LabelWish wish{vec2(widest, lineHeight * float(plan.lines[i].size())), {}};
    for (const vec2& cell : plan.labels[i].anchors)
      wish.anchors.push_back(plan.pictureAt + cell / vec2(width, height) * plan.pictureSize);
    texts.push_back(std::move(wish));
  }
  plan.layout = layOutLabels(texts, plan.columns);
  return plan;
}

float CutEdges::remains(vec2 place, vec2 size) const {
  const float reach = kFade * std::max(size.x, size.y);
  float share = 1;
  for (std::size_t edge = 0; edge < 4; ++edge) {
    const int across = edge < 2 ? 0 : 1;
    const float from = edge % 2 ? size[across] - place[across] : place[across];
    if (from >= reach || along[edge].empty()) continue;
    const float at = place[1 - across] / size[1 - across] * float(along[edge].size());
    const auto cell = std::min(std::size_t(std::max(at, 0.0f)), along[edge].size() - 1);
    share *= glm::mix(1.0f, glm::smoothstep(0.0f, reach, from), along[edge][cell]);
  }
  return share;
}

void fadeEdges(Image& picture, const CutEdges& cut, vec3 paper) {
  const vec2 size(picture.width, picture.height);
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const float share = cut.remains(vec2(float(x) + 0.5f, float(y) + 0.5f), size);
      if (share >= 1) continue;
      std::uint8_t* pixel = &picture.rgba[4 * (std::size_t(y) * picture.width + x)];
      for (int c = 0; c < 3; ++c)
        pixel[c] = std::uint8_t(std::lround(glm::mix(255 * paper[c], float(pixel[c]), share)));
    }
}

}  // namespace vasa::plate
