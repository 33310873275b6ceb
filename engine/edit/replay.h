#pragma once
#include <span>

#include "edit/journal.h"
#include "network/network.h"

namespace vasa {

/// What became of an edit.
struct ReplayRow {
  std::string where;  ///< "journal.vedit:7"
  std::string operation, vessel;
  std::string change;   ///< what it did; empty where it was refused
  std::string refusal;  ///< "journal.vedit:7: stenosis of \"x\" at 0.10: ..."; empty where it was applied
  bool applied() const { return refusal.empty(); }
};

struct Replay {
  Network network;
  std::vector<ReplayRow> rows;  ///< one an edit
  std::vector<VesselId>
      origins;  ///< of each vessel, its number in the network that was begun with; invalid: it was added
  std::vector<char> redrawn;  ///< of each vessel, whether its points are other than the origin's

  std::size_t applied() const;
};

/// Replays edits onto a network, which is not changed: each on what those before it made, each whole or not
/// at all. What the first n of them make is what a journal of n lines makes, so that undoing is leaving lines
/// out. A refused edit is passed over; its row says why. O(edits · network)
Replay replayEdits(const Network& network, std::span<const Edit> edits);

/// The network after all edits. badInput where one is refused, with every refusal on a line of its own.
Result<Network> editNetwork(const Network& network, std::span<const Edit> edits);

/// The vessel with this name, as journals mean it: to the letter, else with upper and lower case alike. The
/// error says what names are near.
Result<VesselId> findVessel(const Network& network, const std::string& name);

}  // namespace vasa
