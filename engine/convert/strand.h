#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/ids.h"
#include "math/types.h"
#include "network/network.h"

// Vessels in the making. Everything that decides how vessels hang together works on strands, runs of sampled
// sections; splines are fitted once, at the end, when the topology is settled.
namespace vasa {

using Sections = std::vector<vec4>;  ///< centres and radii (x, y, z, r) [m], neighbours distinct

struct Strand {
  Sections sections;  ///< at least 2; empty once the strand was dropped or merged into others
  std::uint32_t element = 0;
  VesselKind kind = VesselKind::other;
  std::uint32_t startJoint = kNone, endJoint = kNone;

  bool dropped() const { return sections.empty(); }
};

struct StrandEnd {
  std::uint32_t strand = 0;
  bool last = false;
  bool operator==(const StrandEnd&) const = default;
};

/// A place that strands share: on the side of a host strand, or where ends meet.
struct Joint {
  std::optional<std::uint32_t> host;
  vec3 place{0};
  std::vector<StrandEnd> ends;  ///< empty once the joint was dissolved
};

/// A place along a strand's polyline.
struct Along {
  std::uint32_t segment = 0;
  float t = 0;         ///< in [0, 1] on that segment
  float arc = 0;       ///< [m] from the first section
  vec4 section{0};     ///< centre and radius there
  float distance = 0;  ///< of the point asked about from the centre
};

/// The place on the polyline whose centre is nearest to p. O(sections).
Along nearestAlong(const Sections& sections, vec3 p);
float lengthOf(const Sections& sections);
/// The place at an arc length from the first section, clamped.
Along atArc(const Sections& sections, float arc);

/// The strand's radius near an end [m]: the largest within two radii of the tip, since sections taper where
/// the surface is cut at a slant.
float endRadius(const Sections& sections, bool last);

/// Unit direction in which the strand leaves its end, judged between about half and two and a half radii from
/// it.
vec3 outwardDirection(const Sections& sections, bool last);

/// Takes sections off an end where the radius falls off because the surface is cut at a slant: those thinner
/// than 70 % of the radius behind them, over one radius of length at most. A ball-shaped cap stands there
/// anyway.
void trimTaper(Sections& sections, bool last);

class StrandGraph {
 public:
  std::vector<Strand> strands;
  std::vector<Joint> joints;

  std::uint32_t add(Strand strand);
  std::uint32_t jointAt(StrandEnd end) const {
    const Strand& s = strands[end.strand];
    return end.last ? s.endJoint : s.startJoint;
  }
  bool isFree(StrandEnd end) const { return jointAt(end) == kNone; }
  vec4 sectionAt(StrandEnd end) const;

  /// A new joint of free ends, on the side of `host` or on none. Each end's first section is set to the place
  /// by extendTo. @return its number
  std::uint32_t join(std::optional<std::uint32_t> host, vec3 place, std::span<const StrandEnd> ends);
  void addEnd(std::uint32_t joint, StrandEnd end);

  /// Takes the strand out: its ends leave their joints, and joints with too little left are dissolved. Side
  /// branches that hung on it become free ends.
  void drop(std::uint32_t strand);
  /// Takes one end out of its joint, dissolving that if too little is left.
  void release(StrandEnd end);

  /// Cuts a strand in two at an arc length inside it; a joint of the two halves is made there and `ends` of
  /// what hung on the strand at this place come along. @return the joint
  std::uint32_t split(std::uint32_t strand, float arc);

  /// Takes out sections at which tubes would fold (convert/without_folds.h). What hangs on a strand is led to
  /// its new axis, inside of its tube, however sharp it bends there.
  void removeFolds();

  /// Splits hosts until no side branches hang on one another in a circle, and none on its own strand.
  void breakCircles();

 private:
  void dissolve(std::uint32_t joint);
  void extendTo(StrandEnd end, vec3 place);
  std::optional<std::uint32_t> jointInCircle() const;
};

}  // namespace vasa
