#pragma once
#include <span>
#include <vector>

#include "avoid/metric.h"
#include "network/network.h"

namespace vasa {

/// How vessels may be pushed aside without coming apart. A point p of a vessel moves by
///   Δq_p = z_p + φ_start(p) Δ(start node) + φ_end(p) Δ(end node),
/// where z is free but 0 at an end that hangs on a node, and φ falls smoothly from 1 at the node to 0 some points on.
/// A node on a host's side moves as the host's centre line there; any other node has a variable of its own. Whatever
/// z is, every end stays on its node, and what branches off goes along. The price of a motion, ½ zᵀ W z, falls apart
/// into one banded matrix a vessel and one number a node. Immutable; the network must outlive it.
class MotionSpace {
 public:
  explicit MotionSpace(const Network& network, float beta);

  /// One number a point, then one a node; those of fixed ends and hosted nodes stay 0.
  std::uint32_t variableCount() const { return std::uint32_t(pointCount_ + nodeWeight_.size()); }

  /// A linear function of the variables, the same for x, y and z, with its W⁻¹ times: what a force on it does.
  struct Term {
    std::uint32_t variable;
    float weight;
  };
  struct Run {
    std::uint32_t first, count;  ///< variables; values lie one after the other
  };
  struct Row {
    std::vector<Term> terms;
    std::vector<Run> runs;
    std::vector<float> response;
    float diagonal = 0;  ///< row · response
  };

  /// Adds weight · C(vessel at span, t) to a row's terms.
  void addPlace(VesselId vessel, std::uint32_t span, float t, float weight, std::vector<Term>& terms) const;
  /// Joins equal variables, and fills response and diagonal. Responses below a thousandth of the largest are left out.
  void finish(Row& row) const;

  /// points += Δq(z), ends exactly on their nodes; radii stay. @param z  variableCount()
  void apply(std::span<const vec3> z, std::span<vec4> points) const;

 private:
  struct Block {
    std::uint32_t first;  // first free point
    BendingMetric metric;
  };
  void addPoint(const Vessel& vessel, std::uint32_t local, float weight, std::vector<Term>& terms) const;
  void addNode(NodeId node, float weight, std::vector<Term>& terms) const;
  vec3 motionOf(const Vessel& vessel, std::uint32_t local, std::span<const vec3> z, std::span<const vec3> nodes) const;

  const Network* network_;
  std::size_t pointCount_;
  std::vector<Block> blocks_;              // a vessel each
  std::vector<std::uint32_t> vesselOf_;    // of a point
  std::vector<float> startShare_, endShare_;  // φ, one a point
  std::vector<float> nodeWeight_;          // W of a node's own variable
};

}  // namespace vasa
