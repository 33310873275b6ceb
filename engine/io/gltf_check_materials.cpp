#include "io/gltf_check.h"

// Only the base colour is used; pictures are never opened. References are checked all the same: a file whose
// references dangle was damaged or cut.
namespace vasa::gltf {
namespace {

void checkTextureInfo(const JsonView& holder, const char* key, std::size_t textures) {
  if (const auto info = holder.find(key)) info->at("index").index(textures, "textures");
}

void checkMaterial(const JsonView& material, std::size_t textures) {
  for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"})
    checkTextureInfo(material, key, textures);
  const auto pbr = material.find("pbrMetallicRoughness");
  if (!pbr) return;
  for (const char* key : {"baseColorTexture", "metallicRoughnessTexture"})
    checkTextureInfo(*pbr, key, textures);
  if (const auto colour = pbr->find("baseColorFactor")) colour->numbers(4);  // brighter than white is white
}

void checkImage(const JsonView& image, std::size_t views) {
  const auto view = image.find("bufferView");
  const auto uri = image.find("uri");
  if (view.has_value() == uri.has_value()) image.fail("must have either uri or bufferView");
  if (uri) uri->text();
  if (view) view->index(views, "bufferViews");
}

}  // namespace

void checkMaterials(const JsonView& root) {
  const std::size_t textures = countOf(root, "textures");
  for (const JsonView& material : root.items("materials")) checkMaterial(material, textures);
  for (const JsonView& texture : root.items("textures")) {
    if (const auto source = texture.find("source")) source->index(countOf(root, "images"), "images");
    if (const auto sampler = texture.find("sampler")) sampler->index(countOf(root, "samplers"), "samplers");
  }
  for (const JsonView& image : root.items("images")) checkImage(image, countOf(root, "bufferViews"));
}

}  // namespace vasa::gltf
