#include "scene/vessel_files.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "convert/convert.h"
#include "convert/duplicates.h"
#include "core/atomic_file.h"
#include "core/log.h"
#include "core/visible.h"
#include "io/foreign_files.h"
#include "io/gltf.h"
#include "io/markups.h"
#include "io/obj.h"
#include "io/stl.h"
#include "io/swc.h"
#include "io/vtk.h"
#include "io/vtp.h"
#include "mesh/components.h"
#include "network/file.h"
#include "network/join_lines.h"

namespace vasa {
namespace {

constexpr float kTallestPerson = 2.2f;  // [m]

bool isVtk(const std::filesystem::path& path) {
  const std::string extension = extensionOf(path);
  return extension == ".vtp" || extension == ".vtu" || extension == ".vtk";
}

Result<std::vector<MeshElement>> readElements(const std::filesystem::path& path, const ImportFrame& frame) {
  const std::string extension = extensionOf(path);
  if (isGltfFile(path)) return readGltfElements(path);
  if (extension == ".obj") return readObj(path, frame);
  if (extension == ".stl") return readStl(path, frame);
  if (isVtk(path)) return readVtkSurface(path, frame);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    auto missing = readFile(path);  // says what it is instead
    if (!missing) return missing.error();
  }
  return Error{
      Fault::usage,
      path.string() +
          ": unknown kind of file; convert reads .glb, .gltf, .obj, .stl, .vtp, .vtu, .vtk, .swc and .mrk.json" +
          remedyFor(path, FileUse::vessels)};
}

// As asked for, but for axes that the file tells itself.
ImportFrame frameOf(const std::filesystem::path& path, const ImportFrame& asked) {
  return {asked.metresPerUnit, toldFrame(path).up.value_or(asked.up)};
}

float farthest(const Aabb& bounds) { return bounds.empty() ? 0 : bounds.distance(vec3(0)); }

// What `read` gives, in the likely unit.
template <class Read>
auto readInLikelyUnit(const std::filesystem::path& path, Read read, ImportFrame::Up up = ImportFrame::Up::y)
    -> decltype(read(VesselImport{})) {
  HeldWarnings ofFirst;  // reading again says them again
  auto found = read(VesselImport{{1, up}, {}});
  if (!found || isGltfFile(path) || isMarkupsFile(path)) return found;  // in units of their own
  const auto [unit, why] = likelyUnit(boundsOf(*found), path);
  if (unit == 1) return found;
  logInfo(path.string() + ": read as " + why + "; --unit of vasa convert and vasa fit says otherwise");
  ofFirst.drop();
  return read(VesselImport{{unit, up}, {}});
}

// Of a file that is converted on the way: nobody sees the report that vasa convert prints.
void tellDoubtful(const std::filesystem::path& path, const ConvertReport& report) {
  const auto first = std::ranges::find(report.elements, ElementStatus::doubtful, &ElementReport::status);
  if (first == report.elements.end()) return;
  logWarning(
      fmt::format("{}: {} of {} elements are doubtful as vessels, the first '{}': {}; vasa convert "
                  "lists them; leave out what is no vessel, and give a body with --body",
                  path.string(), report.summary.doubtful, report.elements.size(), visible(first->name),
                  visible(first->reason)));
}

Result<Network> networkOfSurfaces(const std::filesystem::path& path, float bodyHeight,
                                  const ReadingProgress& told) {
  auto sources = readSurfacesInLikelyUnit(path, ImportFrame::Up::y);
  if (!sources) return sources.error();
  leaveOutNamedOthers(*sources);
  if (auto near = checkReach(boundsOf(*sources), path.string()); !near) return near.error();
  ConvertOptions options{.bodyHeight = bodyHeight};
  if (told) {
    told("converting vessels", 0, sources->size());
    options.progress = [&](std::size_t done, std::size_t total) {
      if (done < total)
        told("converting vessels", done, total);
      else
        told("joining and measuring vessels", 0, 0);
    };
  }
  auto conversion = convertElements(*sources, options);
  if (!conversion) return Error{conversion.error().fault, path.string() + ": " + conversion.error().message};
  tellDoubtful(path, conversion->report);
  return std::move(conversion->network);
}

Result<Network> networkOfLines(const std::filesystem::path& path, float bodyHeight) {
  const auto lines =
      readInLikelyUnit(path, [&](const VesselImport& import) { return readCentrelines(path, import); });
  if (!lines) return lines.error();
  if (auto near = checkReach(boundsOf(*lines), path.string()); !near) return near.error();
  auto made = networkOfCentrelines(*lines, bodyHeight);
  if (!made) return badInput(path.string() + ": " + made.error().message);
  return std::move(made->network);
}

}  // namespace

std::vector<LeftOut> leaveOutNamedOthers(std::vector<SourceElement>& sources) {
  const std::size_t all = sources.size();
  std::vector<LeftOut> left = leaveOutNoVessels(sources);
  if (!left.empty())
    logInfo(fmt::format(
        "left out by their names or their width, which are those of no vessels: {} of {} elements, '{}' ({}) "
        "first; what is a vessel needs a vessel's name, or --kind",
        left.size(), all, visible(left.front().name), reasonOf(left.front().why)));
  return left;
}

Result<void> checkReach(const Aabb& bounds, const std::string& name) {
  constexpr float kFarthest = 1000;
  const float far = bounds.empty() ? 0 : glm::length(glm::max(glm::abs(bounds.low), glm::abs(bounds.high)));
  if (far <= kFarthest) return {};
  return badInput(fmt::format(
      "{}: vessels lie {:.0f} m from the origin, where places are rounded to {:.1g} mm; move them to it in "
      "the program that made the file (Blender: Set Origin, then location 0), or have its unit told right",
      name, far, 1e3 * (std::nextafter(far, std::numeric_limits<float>::infinity()) - far)));
}

Aabb boundsOf(const std::vector<SourceElement>& sources) {
  Aabb box;
  for (const SourceElement& source : sources) box.add(source.element.mesh.bounds());
  return box;
}

Aabb boundsOf(const Centrelines& lines) {
  Aabb box;
  for (const Centrelines::Line& line : lines.lines)
    for (const vec4& sample : line.samples) box.add(vec3(sample));
  return box;
}

LikelyUnit likelyUnit(const Aabb& bounds, const std::filesystem::path& path) {
  if (const double told = toldFrame(path).metresPerUnit; told > 0 && bounds.size() * told <= kTallestBody)
    return {told, std::string(nameOfUnit(told)) + ", as its head says"};
  if (bounds.size() <= kTallestBody && farthest(bounds) <= kFarthestBody) return {1, {}};
  if (const float high = 1e-3f * bounds.size(); high > kTallestBody)
    return {1e-6, fmt::format("micrometres, as in millimetres they would be {:.0f} m large", high)};
  return {0.001, "millimetres, as in metres " + sizeInMetres(bounds)};
}

std::string sizeInMetres(const Aabb& bounds) {
  if (bounds.size() <= kTallestBody)
    return fmt::format("they would lie {:.0f} m from the origin", farthest(bounds));
  std::string said = fmt::format("they would be {:.0f} m large", bounds.size());
  if (const float inCentimetres = 0.01f * bounds.size(); inCentimetres <= kTallestPerson)
    said += fmt::format(" (in centimetres {:.2g} m)", inCentimetres);
  return said;
}

bool holdsSurfaces(const std::filesystem::path& path) {
  const std::string extension = extensionOf(path);
  return isGltfFile(path) || extension == ".obj" || extension == ".stl" ||
         (isVtk(path) && vtkContent(path) != VtkContent::lines);
}

Result<bool> holdsSurfacesAlone(const std::filesystem::path& path) {
  if (!holdsSurfaces(path)) return false;
  if (!isGltfFile(path)) return true;
  const auto summary = countGltf(path);
  if (!summary) return summary.error();
  if (!summary->body || summary->skins > 0) return !summary->body;
  // Rigid pieces that hang on one another like limbs: a person's, or the vessels of each limb below a node of
  // its name. A person's trunk and head are wider than any vessel.
  const auto pieces = readGltfElements(path);
  if (!pieces) return pieces.error();
  return std::ranges::none_of(*pieces, [](const MeshElement& piece) {
    return !piece.mesh.empty() && roughRadius(piece.mesh) > kWidestVessel;
  });
}

bool holdsCentrelines(const std::filesystem::path& path) {
  return extensionOf(path) == ".swc" || isMarkupsFile(path) ||
         (isVtk(path) && vtkContent(path) == VtkContent::lines);
}

Result<std::vector<SourceElement>> readSurfaces(const std::filesystem::path& path,
                                                const VesselImport& import) {
  auto elements = readElements(path, frameOf(path, import.frame));
  if (!elements) return withTrueKind(elements.error(), path);
  if (std::ranges::all_of(*elements, [](const MeshElement& e) { return e.mesh.empty(); }))
    return badInput(path.string() + ": the file holds no triangles; export the vessels as surfaces");
  std::vector<SourceElement> sources = describeElements(std::move(*elements), path.stem().string());
  if (import.kind)
    for (SourceElement& source : sources) source.kind = *import.kind, source.noVessel = NoVessel::none;
  return sources;
}

Result<std::vector<SourceElement>> readSurfacesInLikelyUnit(const std::filesystem::path& path,
                                                            ImportFrame::Up up) {
  return readInLikelyUnit(
      path, [&](const VesselImport& import) { return readSurfaces(path, import); }, up);
}

TriangleMesh meshOf(const std::vector<SourceElement>& sources) {
  TriangleMesh whole;
  for (const SourceElement& source : sources) appendMesh(whole, source.element.mesh);
  return whole;
}

namespace {

Result<Centrelines> linesOf(const std::filesystem::path& path, const VesselImport& import) {
  const std::string name = path.stem().string();
  const VesselKind kind = import.kind.value_or(kindOf(MeshElement{name, {}, {}, {}}, name));
  if (isMarkupsFile(path)) {
    auto curves = readMarkups(path, kind);
    if (curves) joinTouchingLines(*curves);
    return curves;
  }
  if (extensionOf(path) == ".swc") {
    const auto samples = readSwc(path, import.frame);
    if (!samples) return samples.error();
    Centrelines traces = centrelinesOfSwc(*samples, name, kind);
    if (import.kind)
      for (Centrelines::Line& line : traces.lines) line.kind = kind;
    joinTouchingLines(traces);
    return traces;
  }
  const ImportFrame frame = frameOf(path, import.frame);
  const auto lines = readVtkLines(path, frame);
  if (!lines) return lines.error();
  auto centrelines = centrelinesOfVtp(*lines, name, kind);
  if (!centrelines) return badInput(path.string() + ": " + centrelines.error().message);
  if (!lines->find("VesselIds")) joinTouchingLines(*centrelines);  // ours say themselves what is joined
  return centrelines;
}

}  // namespace

Result<Centrelines> readCentrelines(const std::filesystem::path& path, const VesselImport& import) {
  auto lines = linesOf(path, import);
  return lines ? std::move(lines) : withTrueKind(lines.error(), path);
}

Result<Network> readNetworkFile(const std::filesystem::path& path) {
  auto network = readNetwork(path);
  if (network || network.error().fault != Fault::badInput || extensionOf(path) == ".vasa") return network;
  const std::string remedy = remedyFor(path, FileUse::vessels);
  return remedy.empty() ? std::move(network) : badInput(path.string() + ": is no .vasa file" + remedy);
}

Result<Network> readVessels(const std::filesystem::path& path, float bodyHeight,
                            const ReadingProgress& told) {
  if (holdsSurfaces(path)) return networkOfSurfaces(path, bodyHeight, told);
  if (holdsCentrelines(path)) return networkOfLines(path, bodyHeight);
  return readNetworkFile(path);
}

}  // namespace vasa
