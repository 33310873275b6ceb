#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "convert/convert.h"
#include "core/cancellation.h"
#include "paper_easel.h"

// Figure 2: a vessel with its branches as polygons and as sweeps, which the mesh is converted to here, in the
// paper's way (a sweep between every two sections, through both) and in ours (the fewest that come near
// enough).
namespace vasa::cli {
namespace {

constexpr int kPiecesPerSpan = 16;

// The vessel that most others branch off, and those.
std::vector<std::string> namesOfGroup(const Network& network) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> branches;
  for (const Node& node : network.nodes())
    if (node.host)
      for (const VesselEnd& end : network.ends(node))
        branches[node.host->vessel.value].push_back(end.vessel.value);
  std::vector<std::string> names;
  if (branches.empty()) return {network.vessels().front().name};
  const auto thickness = [&](const auto& entry) {
    const auto points = network.pointsOf(network.vessel(VesselId{entry.first}));
    return float(entry.second.size()) * points[points.size() / 2].w;
  };
  const auto& [host, sides] = *std::ranges::max_element(branches, {}, thickness);
  names.push_back(network.vessels()[host].name);
  for (const std::uint32_t side : sides) names.push_back(network.vessels()[side].name);
  return names;
}

// An element's label is its vessels' name, with a number behind where there are several.
bool isNamed(const SourceElement& element, std::span<const std::string> names) {
  return std::ranges::any_of(names, [&](const std::string& name) {
    return name == element.label || name.starts_with(element.label + " (");
  });
}

std::vector<SourceElement> groupOf(const PaperStudy& study) {
  std::vector<SourceElement> group;
  const auto names = namesOfGroup(study.scene.network);
  for (const SourceElement& element : study.meshes)
    if (isNamed(element, names)) group.push_back(element);
  if (group.empty())
    group.push_back(*std::ranges::max_element(study.meshes, {},
                                              [](const SourceElement& e) { return e.element.mesh.area(); }));
  return group;
}

// Straight pieces of tubes, to measure distances from walls by.
struct Piece {
  vec4 from, to;
};

std::vector<Piece> piecesOf(const Network& network) {
  std::vector<Piece> pieces;
  for (const Vessel& vessel : network.vessels()) {
    const auto points = network.pointsOf(vessel);
    for (std::uint32_t i = 0; i < vessel.spanCount() * kPiecesPerSpan; ++i)
      pieces.push_back(
          {evaluate(points, float(i) / kPiecesPerSpan), evaluate(points, float(i + 1) / kPiecesPerSpan)});
  }
  return pieces;
}

// [m] from the nearest tube's wall, inside it or outside.
float wallDistance(std::span<const Piece> pieces, vec3 p) {
  float least = 1e9f;
  for (const Piece& piece : pieces) {
    const vec3 along = vec3(piece.to) - vec3(piece.from);
    const float t = glm::clamp(
        glm::dot(p - vec3(piece.from), along) / std::max(glm::dot(along, along), 1e-20f), 0.0f, 1.0f);
    const vec4 nearest = glm::mix(piece.from, piece.to, t);
    least = std::min(least, std::abs(glm::distance(p, vec3(nearest)) - nearest.w));
  }
  return least;
}

struct Band {
  float within;  // [m]
  vec3 colour;   // sRGB
};
constexpr std::array<Band, 5> kBands{{{5e-5f, {0.18f, 0.35f, 0.65f}},
                                      {1e-4f, {0.35f, 0.65f, 0.75f}},
                                      {2.5e-4f, {0.65f, 0.82f, 0.55f}},
                                      {5e-4f, {0.95f, 0.80f, 0.35f}},
                                      {1e9f, {0.85f, 0.30f, 0.22f}}}};

// Each triangle in four, again and again, so that colours follow the distance.
void divide(const std::array<vec3, 3>& corners, int times, const auto& take) {
  if (times == 0) return take(corners);
  const auto& [a, b, c] = corners;
  const vec3 ab = 0.5f * (a + b), bc = 0.5f * (b + c), ca = 0.5f * (c + a);
  for (const std::array<vec3, 3>& part : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
    divide(part, times - 1, take);
}

std::vector<SkinnedMesh> colouredByDistance(std::span<const SourceElement> group, const Network& sweeps) {
  const std::vector<Piece> pieces = piecesOf(sweeps);
  std::array<TriangleMesh, kBands.size()> parts;
  for (const SourceElement& source : group) {
    const TriangleMesh& mesh = source.element.mesh;
    const int times = mesh.triangles.size() > 4000 ? 0 : 2;
    for (const uvec3& t : mesh.triangles)
      divide({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]}, times,
             [&](const std::array<vec3, 3>& corners) {
               const float distance = wallDistance(pieces, (corners[0] + corners[1] + corners[2]) / 3.0f);
               const auto band =
                   std::ranges::find_if(kBands, [&](const Band& b) { return distance <= b.within; });
               TriangleMesh& part = parts[std::size_t(band - kBands.begin())];
               const auto first = std::uint32_t(part.positions.size());
               part.positions.insert(part.positions.end(), corners.begin(), corners.end());
               part.triangles.push_back({first, first + 1, first + 2});
             });
  }
  std::vector<SkinnedMesh> meshes;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!parts[i].empty())
      meshes.push_back(stillMesh(fmt::format("band {}", i), std::move(parts[i]), kBands[i].colour, false));
  return meshes;
}

Report errorsOf(const ConvertReport& report) {
  const ErrorStatistics& error = report.summary.error;
  return {{"sweeps", report.summary.sweeps},
          {"error_mm", {{"mean", 1e3 * error.mean}, {"p95", 1e3 * error.p95}, {"max", 1e3 * error.max}}}};
}

std::string errorText(const char* what, const ConvertReport& report) {
  const ErrorStatistics& error = report.summary.error;
  return fmt::format(
      "{}: {} sweeps, {:.3f} mm from the mesh on average, 95 % within {:.2f} mm, {:.2f} mm at most. ", what,
      report.summary.sweeps, 1e3 * error.mean, 1e3 * error.p95, 1e3 * error.max);
}

// What the colours mean, in millimetres.
std::string legend() {
  std::string text = "(c), in mm:";
  for (std::size_t i = 0; i < kBands.size(); ++i) {
    const auto hex = [](float c) { return int(std::lround(255 * c)); };
    const vec3 c = kBands[i].colour;
    const std::string words =
        i + 1 < kBands.size() ? fmt::format("to {:g}", 1e3f * kBands[i].within) : fmt::format("more");
    text += fmt::format("<span class=\"band\" style=\"background:#{:02x}{:02x}{:02x}\"></span>{}", hex(c.x),
                        hex(c.y), hex(c.z), words);
  }
  return text;
}

Look meshLook() {
  Look look = pageLook();
  look.drawArteries = look.drawVeins = look.drawOtherVessels = false;
  return look;
}

// Around where the thickest vessel is thickest.
Aabb closeUp(const Network& network) {
  vec4 thickest(0);
  for (const vec4& p : network.points())
    if (p.w > thickest.w) thickest = p;
  Aabb box;
  box.add(vec3(thickest), 6 * thickest.w);
  return box;
}

}  // namespace

Result<PaperFigure> conversionFigure(const PaperStudy& study, gpu::Device& device) {
  PaperFigure figure{
      "Converting blood vessels from (a) a polygonal mesh model to (b) sweep surfaces; (c) how far the mesh is from them.",
      {},
      {},
      {}};
  const std::vector<SourceElement> group = groupOf(study);
  ConvertOptions options;
  options.bodyHeight = study.scene.network.bodyHeight();
  const auto fitted = convertElements(group, options);
  options.fit.interpolate = true;
  const auto interpolated = convertElements(group, options);
  checkpoint();
  if (!fitted) return fitted.error();
  if (!interpolated) return interpolated.error();
  const Network& sweeps = interpolated->network;

  std::vector<SkinnedMesh> facets;
  std::size_t triangles = 0;
  for (const SourceElement& element : group) {
    triangles += element.element.mesh.triangles.size();
    facets.push_back(stillMesh("element", element.element.mesh, vec3(colourOf(element.kind)), false));
  }
  const PictureSize size{360, 480};
  Easel easel(study, device, {.network = sweeps, .meshes = facets}, size);
  const Camera camera = cameraOn(closeUp(sweeps), {0.3f, 0.1f, 1}, easel.aspect());
  figure.panels.push_back({"(a) mesh", easel.draw(camera, meshLook())});
  Look vessels = pageLook();
  vessels.drawOther = false;
  figure.panels.push_back({"(b) sweeps", easel.draw(camera, vessels)});
  const std::vector<SkinnedMesh> bands = colouredByDistance(group, sweeps);
  checkpoint();
  Easel coloured(study, device, {.network = sweeps, .meshes = bands}, size);
  figure.panels.push_back({"(c) distance", coloured.draw(camera, meshLook())});
  figure.facts = {{"elements", group.size()},
                  {"triangles", triangles},
                  {"interpolated", errorsOf(interpolated->report)},
                  {"fitted", errorsOf(fitted->report)}};
  figure.note = legend() + "<br>" +
                errorText("Interpolated, as in the paper and shown here", interpolated->report) +
                errorText("Fitted, as vasa convert does", fitted->report) +
                (study.meshesGiven ? "" : "The mesh is the network's own, eight vertices a section.");
  return figure;
}

}  // namespace vasa::cli
