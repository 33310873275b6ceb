#include "io/gltf.h"

#include <exception>
#include <new>

#include "core/atomic_file.h"
#include "io/foreign_files.h"
#include "io/gltf_asset.h"
#include "io/gltf_body.h"
#include "io/gltf_check.h"
#include "io/gltf_container.h"
#include "io/gltf_rule.h"

namespace vasa {
namespace {

/// Strings of the file get into messages; they must not steer the terminal.
std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text;
}

/// Loads a file, makes something of it, and turns what is thrown on the way into an Error that begins with
/// the file's name.
template <class T, class Maker>
Result<T> parse(std::vector<std::byte> bytes, const std::filesystem::path& path, Maker make) {
  const std::string file = path.string() + ": ";
  try {
    return make(gltf::loadAsset(std::move(bytes), path));
  } catch (const gltf::BrokenRule& broken) {
    return badInput(file + printable(broken.place + ": " + broken.rule + "; " + broken.remedy));
  } catch (const Error& error) {
    return error.message.starts_with(file) ? error : Error{error.fault, file + error.message};
  } catch (const std::bad_alloc&) {
    return Error{Fault::failed, file + "needs more memory than there is; split or reduce the asset"};
  } catch (const std::exception& error) {
    return badInput(file + "cannot be read: " + error.what() + "; " + gltf::kExportAgain);
  }
}

Result<std::vector<std::byte>> bytesOf(const std::filesystem::path& path) {
  auto bytes = readFile(path, gltf::kMaximumFileBytes);
  const std::string file = path.string() + ": ";
  if (!bytes && !bytes.error().message.starts_with(file))
    return Error{bytes.error().fault, file + bytes.error().message};
  return bytes;
}

GltfSummary summaryOf(const gltf::Asset& asset) {
  const auto& model = asset.model;
  return {model.nodes.size(), model.meshes.size(), model.skins.size(), model.animations.size(),
          gltf::holdsBody(asset)};
}

// Under another name.
bool looksLikeGltf(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return text.starts_with("glTF") || text.substr(0, text.find_first_not_of(" \t\r\n") + 1).ends_with('{');
}

}  // namespace

Result<Body> parseBody(std::vector<std::byte> bytes, const std::filesystem::path& path) {
  return parse<Body>(std::move(bytes), path, gltf::bodyOf);
}

Result<Body> readBody(const std::filesystem::path& path) {
  auto bytes = bytesOf(path);
  if (!bytes) return bytes.error();
  if (!isGltfFile(path) && !looksLikeGltf(*bytes))
    return badInput(path.string() + ": a body is a glTF file (.glb, .gltf, .vrm), and this is none" +
                    remedyFor(path, FileUse::body));
  return parseBody(std::move(*bytes), path);
}

Result<std::vector<MeshElement>> parseGltfElements(std::vector<std::byte> bytes,
                                                   const std::filesystem::path& path) {
  return parse<std::vector<MeshElement>>(std::move(bytes), path, gltf::elementsOf);
}

Result<std::vector<MeshElement>> readGltfElements(const std::filesystem::path& path) {
  auto bytes = bytesOf(path);
  return bytes ? parseGltfElements(std::move(*bytes), path) : bytes.error();
}

Result<GltfSummary> countGltf(const std::filesystem::path& path) {
  auto bytes = bytesOf(path);
  if (!bytes) return bytes.error();
  return parse<GltfSummary>(std::move(*bytes), path, summaryOf);
}

Result<GltfSummary> checkGltf(const std::filesystem::path& path) {
  auto bytes = bytesOf(path);
  if (!bytes) return bytes.error();
  return parse<GltfSummary>(std::move(*bytes), path, [](const gltf::Asset& asset) {
    gltf::AnimationChecks checks(asset);
    for (const auto& animation : asset.model.animations)
      for (const auto& channel : animation.channels) checks.channel(animation, channel);
    return summaryOf(asset);
  });
}

}  // namespace vasa
