#pragma once
#include <set>
#include <string>
#include <vector>

#include "atlas/vessel_groups.h"
#include "viewer/vessel_names.h"

namespace vasa::viewer {

struct ViewState;

/// How far the list of all vessels is unfolded.
struct OutlinerState {
  bool on = false;
  bool focused = false;              ///< keys are the list's
  std::set<std::uint32_t> unfolded;  ///< keys of groups
  bool scroll = false;               ///< to the choice, with the next picture
};

/// A line of the list: a system, a region of one, or a vessel.
struct OutlinerRow {
  std::string name;
  int depth = 0;
  std::uint32_t key = 0;  ///< of a group; a vessel's is not looked at
  bool unfolded = false;
  VesselId vessel;                ///< invalid: a group
  std::vector<VesselId> vessels;  ///< of the group, or the vessel alone
};

/// The lines that are to be seen. With a search: the vessels that answer it, best first (viewer/fuzzy.h).
std::vector<OutlinerRow> outlinerRows(const Network& network, const atlas::VesselGroups& groups,
                                      const OutlinerState& state, const std::string& search);

/// What a row is of what is shown.
enum class RowSight : std::uint8_t { shown, partly, hidden };
RowSight sightOf(const OutlinerRow& row, const Network& network, const VesselNames& hidden);

/// All vessels that are chosen: the selected one first.
std::vector<VesselId> chosenVessels(const ViewState& state);

/// A click on a vessel's row. @param add  Ctrl: in addition, or no longer. @param upTo  Shift: all rows from
/// the selected vessel's to this
void chooseRow(ViewState& state, std::span<const OutlinerRow> rows, std::size_t row, bool add, bool upTo);

/// The choice goes on by so many vessels' rows, up where negative; to the first where nothing is chosen.
void stepChoice(ViewState& state, std::span<const OutlinerRow> rows, int way, bool extend);

/// Unfolds where the selected vessel is.
void revealChoice(ViewState& state, const atlas::VesselGroups& groups);

}  // namespace vasa::viewer
