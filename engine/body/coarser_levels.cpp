#include "body/coarser_levels.h"

#include <algorithm>
#include <optional>

#include "core/name_words.h"

namespace vasa {
namespace {

struct Level {
  std::vector<std::string> words;  // of the name without the number
  unsigned long number;
};

std::optional<Level> levelOf(const std::string& name) {
  // Before the name of a material, of which coarser levels have fewer.
  std::vector<std::string> words = nameWords(std::string_view(name).substr(0, name.find('/')));
  const auto lod = std::ranges::find(words, "lod");
  if (lod == words.end() || lod + 1 == words.end()) return std::nullopt;
  const std::string digits = *(lod + 1);
  if (digits.size() > 2 || digits.find_first_not_of("0123456789") != digits.npos) return std::nullopt;
  words.erase(lod + 1);
  return Level{std::move(words), std::stoul(digits)};
}

}  // namespace

std::vector<std::string> leaveOutCoarserLevels(Body& body) {
  std::vector<std::optional<Level>> levels;
  for (const SkinnedMesh& mesh : body.meshes) levels.push_back(levelOf(mesh.name));
  std::vector<std::string> left;
  std::vector<SkinnedMesh> kept;
  for (std::size_t m = 0; m < body.meshes.size(); ++m) {
    const bool coarser =
        levels[m] && std::ranges::any_of(levels, [&](const std::optional<Level>& other) {
          return other && other->number < levels[m]->number && other->words == levels[m]->words;
        });
    if (coarser)
      left.push_back(body.meshes[m].name);
    else
      kept.push_back(std::move(body.meshes[m]));
  }
  body.meshes = std::move(kept);
  return left;
}

}  // namespace vasa
