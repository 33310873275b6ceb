#include "viewer/outliner.h"

#include <algorithm>

#include "viewer/fuzzy.h"
#include "viewer/view_state.h"

namespace vasa::viewer {
namespace {

using atlas::VesselSystem;

std::uint32_t keyOfSystem(VesselSystem system) { return 1 + std::uint32_t(system); }
std::uint32_t keyOfRegion(VesselSystem system, atlas::BodyRegion region) {
  return 100 * keyOfSystem(system) + std::uint32_t(atlas::rankOf(region));
}

OutlinerRow vesselRow(const Network& network, VesselId vessel, int depth) {
  return {network.vessel(vessel).name, depth, 0, false, vessel, {vessel}};
}

void addRegion(std::vector<OutlinerRow>& rows, const Network& network, OutlinerRow group) {
  if (group.vessels.empty()) return;
  const std::vector<VesselId> vessels = group.vessels;
  const bool unfolded = group.unfolded;
  rows.push_back(std::move(group));
  if (!unfolded) return;
  for (const VesselId vessel : vessels) rows.push_back(vesselRow(network, vessel, 2));
}

std::vector<OutlinerRow> answers(const Network& network, const std::string& search) {
  std::vector<std::string_view> names;
  for (const Vessel& vessel : network.vessels()) names.push_back(vessel.name);
  std::vector<OutlinerRow> rows;
  for (const std::uint32_t v : fuzzySearch(search, names)) rows.push_back(vesselRow(network, {v}, 0));
  return rows;
}

bool isAmong(const std::vector<VesselId>& vessels, VesselId vessel) {
  return std::ranges::find(vessels, vessel) != vessels.end();
}

void select(ViewState& state, VesselId vessel) {
  state.selected = VesselPlace{vessel, 0};
  state.outliner.scroll = true;
}

}  // namespace

std::vector<OutlinerRow> outlinerRows(const Network& network, const atlas::VesselGroups& groups,
                                      const OutlinerState& state, const std::string& search) {
  if (search.find_first_not_of(' ') != std::string::npos) return answers(network, search);
  std::vector<OutlinerRow> rows;
  const auto isUnfolded = [&](std::uint32_t key) { return state.unfolded.contains(key); };
  for (std::size_t s = 0; s < atlas::kSystemNames.size(); ++s) {
    const auto system = VesselSystem(s);
    std::vector<std::vector<VesselId>> regions(atlas::bodyRegions().size());
    OutlinerRow whole{std::string(atlas::kSystemNames[s]), 0,  keyOfSystem(system),
                      isUnfolded(keyOfSystem(system)),     {}, {}};
    for (std::uint32_t v = 0; v < groups.system.size(); ++v) {
      if (groups.system[v] != system) continue;
      regions[atlas::rankOf(groups.region[v])].push_back({v});
      whole.vessels.push_back({v});
    }
    if (whole.vessels.empty()) continue;
    const bool unfolded = whole.unfolded;
    rows.push_back(std::move(whole));
    for (std::size_t r = 0; unfolded && r < regions.size(); ++r) {
      const atlas::BodyRegion region = atlas::bodyRegions()[r];
      const std::uint32_t key = keyOfRegion(system, region);
      addRegion(rows, network, {atlas::nameOf(region), 1, key, isUnfolded(key), {}, std::move(regions[r])});
    }
  }
  return rows;
}

RowSight sightOf(const OutlinerRow& row, const Network& network, const VesselNames& hidden) {
  if (!hidden.any()) return RowSight::shown;
  const auto count = std::ranges::count_if(
      row.vessels, [&](VesselId vessel) { return hidden.has(network.vessel(vessel).name); });
  if (count == 0) return RowSight::shown;
  return std::size_t(count) < row.vessels.size() ? RowSight::partly : RowSight::hidden;
}

std::vector<VesselId> chosenVessels(const ViewState& state) {
  std::vector<VesselId> all;
  if (!state.selected) return all;
  all.push_back(state.selected->vessel);
  for (const VesselId vessel : state.alsoChosen)
    if (!isAmong(all, vessel)) all.push_back(vessel);
  return all;
}

void chooseRow(ViewState& state, std::span<const OutlinerRow> rows, std::size_t row, bool add, bool upTo) {
  const VesselId vessel = rows[row].vessel;
  if (upTo && state.selected) {
    const auto from = std::ranges::find(rows, state.selected->vessel, &OutlinerRow::vessel);
    if (from == rows.end()) return chooseRow(state, rows, row, add, false);
    const auto there = std::size_t(from - rows.begin());
    const std::size_t low = std::min(there, row), high = std::max(there, row);
    state.alsoChosen.clear();
    for (std::size_t r = low; r <= high; ++r)
      if (rows[r].vessel.valid()) state.alsoChosen.push_back(rows[r].vessel);
    return;
  }
  if (!add) {
    state.alsoChosen.clear();
    return select(state, vessel);
  }
  std::vector<VesselId> all = chosenVessels(state);
  if (const auto there = std::ranges::find(all, vessel); there != all.end())
    all.erase(there);
  else
    all.insert(all.begin(), vessel);
  state.selected.reset();
  if (!all.empty()) state.selected = VesselPlace{all.front(), 0};
  state.alsoChosen = std::move(all);
}

void stepChoice(ViewState& state, std::span<const OutlinerRow> rows, int way, bool extend) {
  std::vector<VesselId> vessels;
  for (const OutlinerRow& row : rows)
    if (row.vessel.valid()) vessels.push_back(row.vessel);
  if (vessels.empty()) return;
  const auto now = state.selected ? std::ranges::find(vessels, state.selected->vessel) : vessels.end();
  std::vector<VesselId> before = chosenVessels(state);
  if (now == vessels.end())
    select(state, vessels.front());
  else
    select(state,
           vessels[std::size_t(std::clamp(int(now - vessels.begin()) + way, 0, int(vessels.size()) - 1))]);
  state.alsoChosen.clear();
  if (extend) state.alsoChosen = std::move(before);
}

void revealChoice(ViewState& state, const atlas::VesselGroups& groups) {
  if (!state.selected) return;
  const std::uint32_t v = state.selected->vessel.value;
  state.outliner.unfolded.insert(keyOfSystem(groups.system[v]));
  state.outliner.unfolded.insert(keyOfRegion(groups.system[v], groups.region[v]));
  state.outliner.scroll = true;
}

}  // namespace vasa::viewer
