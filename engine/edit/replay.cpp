#include "edit/replay.h"

#include <fmt/format.h>

#include <algorithm>

#include "edit/shapes.h"
#include "edit/topology.h"

namespace vasa {
namespace {

// Operations that the builder's rules have to be asked about; those of shape keep them by what they are.
bool changesTopology(const EditOperation& operation) {
  return std::holds_alternative<GraftEdit>(operation) || std::holds_alternative<BranchEdit>(operation) ||
         std::holds_alternative<CutEdit>(operation) || std::holds_alternative<JoinEdit>(operation) ||
         std::holds_alternative<DeleteEdit>(operation);
}

Result<std::string> applyTo(Draft& draft, const EditOperation& operation) {
  const auto vessel = draft.find(vesselOf(operation));
  if (!vessel) return vessel.error();
  const auto applied = [&](Draft& to) {
    return std::visit([&](const auto& edit) { return apply(edit, *vessel, to); }, operation);
  };
  if (!changesTopology(operation)) return applied(draft);
  Draft changed = draft;
  auto done = applied(changed);
  if (!done) return done;
  if (std::ranges::all_of(changed.lines, &Draft::Line::gone)) return badInput("no vessel would be left");
  if (auto built = changed.build(); !built) return built.error();
  draft = std::move(changed);
  return done;
}

}  // namespace

std::size_t Replay::applied() const { return std::size_t(std::ranges::count_if(rows, &ReplayRow::applied)); }

Replay replayEdits(const Network& network, std::span<const Edit> edits) {
  Draft draft(network);
  Replay replay;
  for (const Edit& edit : edits) {
    const EditOperation& operation = edit.operation;
    ReplayRow row{edit.where(), std::string(operationName(operation)), vesselOf(operation), {}, {}};
    auto done = applyTo(draft, operation);
    const double place = placeOf(operation);
    if (done)
      row.change = std::move(*done);
    else
      row.refusal = fmt::format("{}: {} of \"{}\"{}: {}", row.where, row.operation, row.vessel,
                                place >= 0 ? fmt::format(" at {:.3g}", place) : "", done.error().message);
    replay.rows.push_back(std::move(row));
  }
  auto built = draft.build(&replay.origins);
  // Shapes alone were changed since the builder last agreed: ends are where they were, radii above 0.
  if (built)
    replay.network = std::move(*built);
  else
    replay.network = network;
  if (!built) replay.rows.push_back({"", "", "", "", built.error().message});
  for (const Draft::Line& line : draft.lines)
    if (!line.gone) replay.redrawn.push_back(line.touched);
  return replay;
}

Result<VesselId> findVessel(const Network& network, const std::string& name) {
  return Draft(network).find(name);
}

Result<Network> editNetwork(const Network& network, std::span<const Edit> edits) {
  Replay replay = replayEdits(network, edits);
  std::string refusals;
  for (const ReplayRow& row : replay.rows)
    if (!row.applied()) refusals += (refusals.empty() ? "" : "\n") + row.refusal;
  if (!refusals.empty()) return badInput(refusals);
  return std::move(replay.network);
}

}  // namespace vasa
