#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "shared/growth.h"

namespace vasa {

/// Curves of a tree that begins with a letter. @param sparse  with every second one of the last generation
inline std::uint32_t treeSize(const shared::GrowthSymbol& symbol, std::uint32_t levels, bool sparse) {
  return sparse ? symbol.sparseSize[levels] : symbol.treeSize[levels];
}

/// L-systems of capillaries, ready for growing, by the CPU and the shaders alike.
struct GrowthRules {
  shared::GrowthTables tables{};
  std::vector<std::string> systems;  ///< names, as numbered in tables.system
  std::vector<std::string> symbols;  ///< letters, as numbered in tables.symbol

  /// Curves of one tree of system `s`.
  std::uint32_t treeSize(std::uint32_t s, std::uint32_t levels, bool sparse = false) const {
    return vasa::treeSize(tables.symbol[tables.system[s].axiom], levels, sparse);
  }
};

/// Reads L-systems from text: see data/growth/capillaries.lsys, which explains the notation. Radii of
/// branches are not written down but follow from Murray's law (r³ = Σ r_i³ at every branching): a side branch
/// takes what its parent's taper gives away around it, the branches at the end share what is left. badInput
/// names file, line, cause and remedy: unknown words, numbers that are no numbers or out of range, letters
/// without a production, trees larger than a ring of curves, more than fits the tables.
Result<GrowthRules> parseGrowthRules(std::string_view text, const std::string& name);
Result<GrowthRules> readGrowthRules(const std::filesystem::path& path);

}  // namespace vasa
