#pragma once
#include <memory>
#include <set>
#include <span>
#include <string>

#include "network/network.h"

namespace vasa::viewer {

/// Vessels that are not shown, by name, so that they stay hidden when an edit numbers the others anew. A
/// value: copies are cheap, which an undo history of a thousand of them asks for.
class HiddenVessels {
 public:
  bool any() const { return names_ && !names_->empty(); }
  bool has(const std::string& name) const { return names_ && names_->contains(name); }

  void set(const Network& network, std::span<const VesselId> vessels, bool hidden) {
    auto names = names_ ? std::make_shared<Names>(*names_) : std::make_shared<Names>();
    for (const VesselId vessel : vessels)
      if (hidden)
        names->insert(network.vessel(vessel).name);
      else
        names->erase(network.vessel(vessel).name);
    names_ = std::move(names);
  }
  /// Hides all but these.
  void leaveOnly(const Network& network, std::span<const VesselId> vessels) {
    auto names = std::make_shared<Names>();
    for (const Vessel& vessel : network.vessels()) names->insert(vessel.name);
    for (const VesselId vessel : vessels) names->erase(network.vessel(vessel).name);
    names_ = std::move(names);
  }
  void clear() { names_.reset(); }

  bool operator==(const HiddenVessels& other) const {
    if (names_ == other.names_ || (!any() && !other.any())) return true;
    return any() && other.any() && *names_ == *other.names_;
  }

 private:
  using Names = std::set<std::string>;
  std::shared_ptr<const Names> names_;
};

}  // namespace vasa::viewer
