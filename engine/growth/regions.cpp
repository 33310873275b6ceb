#include "growth/regions.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>

#include "core/letters.h"
#include "core/text_file.h"
#include "growth/rule_text.h"

namespace vasa {
namespace {

constexpr std::array<std::string_view, 11> kColumns{"region",  "system",      "joints",      "vessels",
                                                    "kinds",   "thinnest_mm", "thickest_mm", "bed_mm",
                                                    "surface", "organs",      "wall_mm"};
constexpr std::size_t kFewestColumns = 9;  // tables that know of no organs
constexpr std::size_t kMaximumRegionsBytes = 1 << 20;
constexpr std::size_t kMostRegions = 255;  // beds keep a byte; 255 is none

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::vector<std::string> list(std::string_view cell) {
  std::vector<std::string> items;
  for (const std::string_view part : split(cell, '|'))
    if (!part.empty()) items.push_back(lowerCase(part));
  return items;
}

bool holdsAny(const std::vector<std::string>& parts, const std::string& text) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const std::string& part) { return text.find(part) != std::string::npos; });
}

// Reads a row's cells; the first fault is kept.
class Row {
 public:
  Row(const std::string& file, std::size_t line, std::vector<std::string_view> cells)
      : file_(file), line_(line), cells_(std::move(cells)) {}

  std::string_view text(std::size_t column) const { return cells_[column]; }
  float millimetres(std::size_t column, float low, float high) {
    const auto value = numberIn(cells_[column]);
    if (value && *value >= low && *value <= high) return *value * 1e-3f;
    fail(std::string(kColumns[column]) + " is '" + std::string(cells_[column].substr(0, 40)) +
         "' but must be a number from " + std::to_string(int(low)) + " to " + std::to_string(int(high)));
    return 0;
  }
  void fail(const std::string& what) {
    if (state) state = ruleFault(file_, line_, what);
  }
  Result<void> state;

 private:
  const std::string& file_;
  std::size_t line_;
  std::vector<std::string_view> cells_;
};

std::uint32_t systemNamed(Row& row, const GrowthRules& rules) {
  const std::string_view name = row.text(1);
  if (name == "-") return GrowthRegion::kNoSystem;
  const auto found = std::find(rules.systems.begin(), rules.systems.end(), name);
  if (found != rules.systems.end()) return std::uint32_t(found - rules.systems.begin());
  std::string known;
  for (const std::string& system : rules.systems) known.append(", ").append(system);
  row.fail("there is no system '" + std::string(name.substr(0, 40)) + "'; use one of -" + known);
  return GrowthRegion::kNoSystem;
}

std::vector<VesselKind> kindsIn(Row& row) {
  constexpr std::array kAll{VesselKind::artery, VesselKind::vein, VesselKind::portalVein,
                            VesselKind::lymphatic, VesselKind::other};
  std::vector<VesselKind> kinds;
  for (const std::string& word : list(row.text(4))) {
    const auto found =
        std::find_if(kAll.begin(), kAll.end(), [&](VesselKind kind) { return kindName(kind) == word; });
    if (found == kAll.end())
      row.fail("kinds has '" + word.substr(0, 40) +
               "', which is no kind of vessel; use artery, vein, portal vein, lymphatic or other");
    else
      kinds.push_back(*found);
  }
  return kinds;
}

Result<GrowthRegion> regionIn(Row row, const GrowthRules& rules) {
  GrowthRegion region;
  region.name = row.text(0);
  region.system = systemNamed(row, rules);
  region.joints = list(row.text(2));
  region.vessels = list(row.text(3));
  region.kinds = kindsIn(row);
  region.organs = list(row.text(9));
  const bool grows = region.system != GrowthRegion::kNoSystem;
  if (grows) region.bed = row.millimetres(7, 2, 1000);
  if (!region.organs.empty()) {
    for (const std::size_t column : {2, 4, 5, 6})
      if (!row.text(column).empty())
        row.fail("names organs and " + std::string(kColumns[column]) +
                 "; an organ is filled whatever vessels are near, leave that empty");
    if (!row.text(10).empty()) region.wall = row.millimetres(10, 0, 1000);
  } else if (!row.text(10).empty()) {
    row.fail("names wall_mm but no organs; name them or leave it empty");
  } else if (grows) {
    region.thinnest = row.millimetres(5, 0, 100);
    region.thickest = row.millimetres(6, 0, 100);
    if (region.thickest < region.thinnest) row.fail("thickest_mm is less than thinnest_mm; exchange them");
  }
  region.inBone = row.text(8) == "bone";
  if (!region.inBone && row.text(8) != "skin" && !row.text(8).empty())
    row.fail("surface is '" + std::string(row.text(8).substr(0, 40)) + "' but must be skin, bone or empty");
  if (!row.state) return row.state.error();
  return region;
}

std::string headerText(std::size_t columns = kColumns.size()) {
  std::string text;
  for (const std::string_view column : std::span(kColumns).first(columns))
    text.append(text.empty() ? "" : ",").append(column);
  return text;
}

}  // namespace

const GrowthRegion* regionOf(const std::vector<GrowthRegion>& regions, const RegionQuestion& question) {
  const std::string joint = lowerCase(question.joint);
  for (const GrowthRegion& region : regions) {
    if (!region.organs.empty()) continue;
    const bool named = namesVessel(region, question.vessel, question.ontologyId);
    const bool placed = region.joints.empty() || holdsAny(region.joints, joint);
    const bool kind = region.kinds.empty() || std::find(region.kinds.begin(), region.kinds.end(),
                                                        question.kind) != region.kinds.end();
    if (named && placed && kind) return &region;
  }
  return nullptr;
}

bool namesVessel(const GrowthRegion& region, std::string_view vessel, std::string_view ontologyId) {
  return region.vessels.empty() || holdsAny(region.vessels, lowerCase(vessel)) ||
         std::ranges::find(region.vessels, lowerCase(ontologyId)) != region.vessels.end();
}

const GrowthRegion* regionOfOrgan(const std::vector<GrowthRegion>& regions, std::string_view mesh) {
  const std::string name = lowerCase(mesh);
  const auto found = std::find_if(regions.begin(), regions.end(),
                                  [&](const GrowthRegion& region) { return holdsAny(region.organs, name); });
  return found == regions.end() ? nullptr : &*found;
}

Result<std::vector<GrowthRegion>> parseRegions(std::string_view text, const std::string& name,
                                               const GrowthRules& rules) {
  std::vector<GrowthRegion> regions;
  std::size_t columns = 0;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    if (columns == 0) {
      for (const std::size_t count : {kColumns.size(), kFewestColumns})
        if (line == headerText(count)) columns = count;
      if (columns == 0)
        return ruleFault(name, number, "the first line must name the columns: " + headerText());
      continue;
    }
    std::vector<std::string_view> cells = split(line, ',');
    if (cells.size() != columns)
      return ruleFault(name, number,
                       "has " + std::to_string(cells.size()) + " cells but must have " +
                           std::to_string(columns) + ": " + headerText(columns));
    cells.resize(kColumns.size());
    auto region = regionIn(Row(name, number, std::move(cells)), rules);
    if (!region) return region.error();
    if (regions.size() == kMostRegions)
      return ruleFault(name, number,
                       "is row " + std::to_string(kMostRegions + 1) + "; leave out what is not needed");
    regions.push_back(std::move(*region));
  }
  if (regions.empty())
    return badInput(
        name +
        ": has no regions; the least is a line of columns and a row for everything: default,SYSTEM,,,,0,3,20,");
  return regions;
}

Result<std::vector<GrowthRegion>> readRegions(const std::filesystem::path& path, const GrowthRules& rules) {
  const auto text = readText(path, kMaximumRegionsBytes);
  if (!text) return text.error();
  return parseRegions(*text, path.string(), rules);
}

}  // namespace vasa
