#include "scene/vessel_files.h"

#include <algorithm>
#include <cctype>

#include "convert/convert.h"
#include "io/gltf.h"
#include "io/obj.h"
#include "io/stl.h"
#include "io/swc.h"
#include "io/vtp.h"
#include "network/file.h"

namespace vasa {
namespace {

std::string extensionOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

Result<std::vector<MeshElement>> readElements(const std::filesystem::path& path, const ImportFrame& frame) {
  const std::string extension = extensionOf(path);
  if (extension == ".glb" || extension == ".gltf") return readGltfElements(path);
  if (extension == ".obj") return readObj(path, frame);
  if (extension == ".stl") return readStl(path, frame);
  return Error{Fault::usage, path.string() + ": unknown kind of file; convert reads .glb, .gltf, .obj, .stl, .swc and .vtp"};
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

// What `read` gives, in millimetres if it would be a giant in metres.
template <class Read>
auto readInLikelyUnit(Read read) -> decltype(read(VesselImport{})) {
  auto found = read(VesselImport{});
  if (!found) return found;
  const Aabb box = boundsOf(*found);
  const vec3 extent = box.empty() ? vec3(0) : box.extent();
  if (std::max({extent.x, extent.y, extent.z}) <= kTallestBody) return found;
  return read(VesselImport{{0.001, ImportFrame::Up::y}, {}});
}

Result<Network> networkOfSurfaces(const std::filesystem::path& path, float bodyHeight, const ReadingProgress& told) {
  const auto sources = readInLikelyUnit([&](const VesselImport& import) { return readSurfaces(path, import); });
  if (!sources) return sources.error();
  ConvertOptions options{.bodyHeight = bodyHeight};
  if (told) {
    told("converting vessels", 0, sources->size());
    options.progress = [&](std::size_t done, std::size_t total) {
      if (done < total) told("converting vessels", done, total);
      else told("joining and measuring vessels", 0, 0);
    };
  }
  auto conversion = convertElements(*sources, options);
  if (!conversion) return Error{conversion.error().fault, path.string() + ": " + conversion.error().message};
  return std::move(conversion->network);
}

Result<Network> networkOfLines(const std::filesystem::path& path, float bodyHeight) {
  const auto lines = readInLikelyUnit([&](const VesselImport& import) { return readCentrelines(path, import); });
  if (!lines) return lines.error();
  auto made = networkOfCentrelines(*lines, bodyHeight);
  if (!made) return badInput(path.string() + ": " + made.error().message);
  return std::move(made->network);
}

}  // namespace

bool holdsSurfaces(const std::filesystem::path& path) {
  const std::string extension = extensionOf(path);
  return extension == ".glb" || extension == ".gltf" || extension == ".obj" || extension == ".stl";
}

bool holdsCentrelines(const std::filesystem::path& path) {
  const std::string extension = extensionOf(path);
  return extension == ".swc" || extension == ".vtp";
}

Result<std::vector<SourceElement>> readSurfaces(const std::filesystem::path& path, const VesselImport& import) {
  auto elements = readElements(path, import.frame);
  if (!elements) return elements.error();
  if (std::ranges::all_of(*elements, [](const MeshElement& e) { return e.mesh.empty(); }))
    return badInput(path.string() + ": the file holds no triangles; export the vessels as surfaces");
  std::vector<SourceElement> sources = describeElements(std::move(*elements), path.stem().string());
  for (SourceElement& source : sources) source.kind = import.kind.value_or(source.kind);
  return sources;
}

Result<Centrelines> readCentrelines(const std::filesystem::path& path, const VesselImport& import) {
  const std::string name = path.stem().string();
  const VesselKind kind = import.kind.value_or(kindOf(MeshElement{name, {}, {}, {}}, name));
  if (extensionOf(path) == ".swc") {
    const auto samples = readSwc(path, import.frame);
    if (!samples) return samples.error();
    return centrelinesOfSwc(*samples, name, kind);
  }
  const auto lines = readVtp(path, import.frame);
  if (!lines) return lines.error();
  auto centrelines = centrelinesOfVtp(*lines, name, kind);
  if (!centrelines) return badInput(path.string() + ": " + centrelines.error().message);
  return centrelines;
}

Result<Network> readVessels(const std::filesystem::path& path, float bodyHeight, const ReadingProgress& told) {
  if (holdsSurfaces(path)) return networkOfSurfaces(path, bodyHeight, told);
  if (holdsCentrelines(path)) return networkOfLines(path, bodyHeight);
  return readNetwork(path);
}

}  // namespace vasa
