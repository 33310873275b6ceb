#pragma once
#include "make_human/layout.h"
#include "make_human/segment_grid.h"

namespace vasa::human {

/// Vessels while small ones grow on them: shapes, forks, and how many branches each can still carry.
class GrowingTree {
 public:
  /// @param step  [m] between the points that stand for a curve
  /// @param clearance  [m] between walls
  /// @param cell  [m] of the grid that finds what is near
  GrowingTree(const std::vector<LaidVessel>& laid, float step, float clearance, float cell);

  struct Branch {
    std::vector<vec3> points;
    int host = -1;
    float hostArc = 0;  ///< [m] along the host
    float reserve = 0;  ///< [m] radius that is kept free for it
    float tip = 0;      ///< [m] radius at its end
  };
  struct Vessel {
    Branch branch;  ///< of a vessel of the table, only the points
    std::vector<float> arcs, radii;
    std::vector<float> forks;   ///< arcs at which branches leave
    std::vector<int> children;  ///< in the order of forks
    bool removed = false;
    int load = 1;  ///< tips behind its root, its own included

    float length() const { return arcs.back(); }
  };

  const std::vector<Vessel>& vessels() const { return vessels_; }
  const SegmentGrid& grid() const { return grid_; }
  float clearance() const { return clearance_; }

  vec3 positionAt(int vessel, float arc) const;
  vec3 tangentAt(int vessel, float arc) const;
  float radiusAt(int vessel, float arc) const;

  /// Whether a branch of this tip may leave here: clear of forks and ends, and every stem can carry one more.
  bool admits(int vessel, float arc, float reserve, float tip) const;

  /// The first other vessel that comes too near to a branch, or -1. Near its root its host may overlap it.
  int obstacleOf(const Branch& branch) const;
  /// How a point of a branch has to move to clear the vessels around it.
  vec3 push(const Branch& branch, std::size_t point, float arc) const;

  int add(Branch branch);
  /// Its place stays taken, so that nothing else grows there.
  void remove(int vessel);

  /// Radii by Murray's law at each point of a grown vessel.
  std::vector<float> murrayRadii(int vessel) const;

 private:
  bool mayOverlap(const Branch& branch, float arc, float radius, const SegmentGrid::Segment& other) const;
  void enter(int vessel);

  std::vector<Vessel> vessels_;
  std::size_t laidCount_ = 0;
  SegmentGrid grid_;
  float clearance_;
};

}  // namespace vasa::human
