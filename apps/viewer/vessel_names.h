#pragma once
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "network/network.h"

namespace vasa::viewer {

/// Vessels that something is done with (hidden, labelled), by name, so that they stay so when an edit numbers
/// the others anew. A value: copies are cheap, which an undo history of a thousand of them asks for.
class VesselNames {
 public:
  VesselNames() = default;
  explicit VesselNames(const std::vector<std::string>& names)
      : names_(names.empty() ? nullptr : std::make_shared<Names>(names.begin(), names.end())) {}

  bool any() const { return names_ && !names_->empty(); }
  bool has(const std::string& name) const { return names_ && names_->contains(name); }
  /// By name.
  std::vector<std::string> list() const {
    return names_ ? std::vector<std::string>(names_->begin(), names_->end()) : std::vector<std::string>();
  }

  /// @param in  whether they belong to these vessels from now on, or no longer
  void set(const Network& network, std::span<const VesselId> vessels, bool in) {
    auto names = names_ ? std::make_shared<Names>(*names_) : std::make_shared<Names>();
    for (const VesselId vessel : vessels)
      if (in)
        names->insert(network.vessel(vessel).name);
      else
        names->erase(network.vessel(vessel).name);
    names_ = std::move(names);
  }
  /// All but these.
  void setAllBut(const Network& network, std::span<const VesselId> vessels) {
    auto names = std::make_shared<Names>();
    for (const Vessel& vessel : network.vessels()) names->insert(vessel.name);
    for (const VesselId vessel : vessels) names->erase(network.vessel(vessel).name);
    names_ = std::move(names);
  }
  void clear() { names_.reset(); }

  bool operator==(const VesselNames& other) const {
    if (names_ == other.names_ || (!any() && !other.any())) return true;
    return any() && other.any() && *names_ == *other.names_;
  }

 private:
  using Names = std::set<std::string>;
  std::shared_ptr<const Names> names_;
};

}  // namespace vasa::viewer
