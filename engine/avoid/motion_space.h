#pragma once
#include <span>
#include <vector>

#include "avoid/metric.h"
#include "core/function_ref.h"
#include "network/network.h"

namespace vasa {

/// Vessels, pairs of tubes or places that are worth another thread.
constexpr std::size_t kGrain = 64;

/// How vessels may be pushed aside without coming apart. A point p of a vessel moves by
///   Δq_p = z_p + φ_start(p) Δ(start node) + φ_end(p) Δ(end node),
/// where z is free but 0 at an end that hangs on a node, and φ falls smoothly from 1 at the node to 0 as
/// many points on as a bow takes. A node on a host's side moves as the host's centre line there; any other
/// node has a variable of its own. Whatever z is, every end stays on its node, and what branches off goes
/// along. The price of a motion, ½ zᵀ W z, falls apart into one banded matrix a vessel and one number a node.
/// The network must outlive it; one object serves one caller.
class MotionSpace {
 public:
  /// @param beta    > 0 (avoid/metric.h)
  /// @param masses  one a vessel: what moving its points costs, times; or none: 1 for all
  explicit MotionSpace(const Network& network, float beta, std::span<const float> masses = {});

  /// One number a point, then one a node; those of fixed ends and hosted nodes stay 0.
  std::uint32_t variableCount() const { return std::uint32_t(pointCount_ + nodeWeight_.size()); }

  /// A linear function of the variables, the same for x, y and z, with its W⁻¹ times: what a force on it
  /// does.
  struct Term {
    std::uint32_t variable;
    float weight;
  };
  struct Run {
    std::uint32_t first, count;  ///< variables; values lie one after the other
  };
  struct Row {
    std::uint32_t firstTerm = 0, termCount = 0, firstRun = 0, runCount = 0, firstResponse = 0;
    float diagonal = 0;  ///< row · response
  };
  /// Where the numbers of many rows lie.
  struct Rows {
    std::vector<Term> terms;
    std::vector<Run> runs;
    std::vector<float> responses;
    void clear() { terms.clear(), runs.clear(), responses.clear(); }
    Row append(const Rows& others, const Row& row);  ///< what lies there of a row
    std::span<const Term> termsOf(const Row& row) const {
      return std::span(terms).subspan(row.firstTerm, row.termCount);
    }
    std::span<const Run> runsOf(const Row& row) const {
      return std::span(runs).subspan(row.firstRun, row.runCount);
    }
  };

  /// Adds weight · C(vessel at span, t) to a row's terms.
  void addPlace(VesselId vessel, std::uint32_t span, float t, float weight, std::vector<Term>& terms) const;
  /// Makes a row of some terms, which it sorts and joins: its response and diagonal. Responses below a
  /// thousandth of the largest are left out. O(points the response reaches). On several threads at once, with
  /// Rows of their own.
  Row finish(std::vector<Term>& terms, Rows& rows) const;

  /// points += Δq(z), ends exactly on their nodes; radii stay. @param z  variableCount()
  void apply(std::span<const vec3> z, std::span<vec4> points);

  /// Draws z nearer to another motion where a point would be farther from it than it may.
  /// @param always   [m] so far any may be
  /// @param allowed  (point, distance [m]) -> what it may be where it is farther; for a node, that of an end
  /// there. Called by several threads at once.
  void keepNear(std::span<const vec3> other, std::span<vec3> z, float always,
                FunctionRef<float(std::uint32_t, float)> allowed);

 private:
  struct Block {
    std::uint32_t first;  // first free point
    BendingMetric metric;
    float lightness;  // W is the metric by this
  };
  // A node on a host's side moves as four neighbouring points of the host do, by their weights there.
  struct Hosting {
    const Vessel* host = nullptr;
    std::uint32_t span = 0;
    vec4 weights{0};
  };
  void addPoint(const Vessel& vessel, std::uint32_t local, float weight, std::vector<Term>& terms) const;
  void addNode(NodeId node, float weight, std::vector<Term>& terms) const;
  void moveNodes(std::span<const vec3> z);
  vec3 motionOf(const Vessel& vessel, std::uint32_t local, std::span<const vec3> z) const;

  const Network* network_;
  std::size_t pointCount_;
  std::vector<Block> blocks_;                 // a vessel each
  std::vector<std::uint32_t> vesselOf_;       // of a point
  std::vector<float> startShare_, endShare_;  // φ, one a point
  std::vector<float> nodeWeight_;             // W of a node's own variable
  std::vector<Hosting> hostings_;             // a node each
  std::vector<vec3> nodeMotion_, difference_;
  std::vector<char> nodeChanged_, again_;  // a node each, a vessel each
};

}  // namespace vasa
