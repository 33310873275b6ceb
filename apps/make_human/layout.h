#pragma once
#include "make_human/course.h"
#include "make_human/vessel_rows.h"

namespace vasa::human {

/// A vessel with its shape, ready for the network.
struct LaidVessel {
  NetworkBuilder::Label label;
  std::vector<vec4> points;   ///< de Boor points (x, y, z, r)
  Attachment source, target;  ///< kind `continues`: shares the end of that vessel; vessels by number
};

/// The vessels of the table as courses through their waypoints. Rows linked by `continues` are one smooth
/// course, cut where the names change.
class VesselLayout {
 public:
  static Result<VesselLayout> make(VesselRows& table, const Surroundings& around);

  /// Moves vessels apart (course.h).
  void settle() { human::settle(courses_, *around_); }
  /// From now on the vessel has to lie deeper around a place than it does. @param share  of its length
  void sink(std::size_t vessel, float share, float by);
  /// From now on the vessel's spline keeps closer to its course. False: it does so already as well as it may.
  bool refine(std::size_t vessel);
  /// The vessels with splines fitted to their courses, numbered as the table's rows.
  std::vector<LaidVessel> fitted() const;

 private:
  friend class LayoutMaker;
  /// Where a row lies in its course.
  struct Stretch {
    int course = -1;
    std::uint32_t first = 0, last = 0;  ///< points
    bool begun = false;
  };
  std::span<const VesselRow> rows_;
  const Surroundings* around_ = nullptr;
  std::vector<Stretch> stretches_;
  std::vector<Course> courses_;
  std::vector<float> tolerances_;  // [m] of the splines, one a row
};

/// The spline with the fewest spans, knots at equal distances, that keeps to a polyline within a tolerance
/// and an eighth of its radius, or half the tolerance; no span is shorter than 12 tolerances. Tangents at its
/// ends are those given. What bows out of a bend (body/bowing.h) has as many spans as that takes.
std::vector<vec4> fitCourse(std::span<const vec3> points, std::span<const float> radii, vec3 startTangent,
                            vec3 endTangent, float tolerance);

Result<Network> joinVessels(const std::vector<LaidVessel>& vessels, float bodyHeight);

}  // namespace vasa::human
