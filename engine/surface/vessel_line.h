#pragma once
#include <array>
#include <vector>

#include "network/network.h"

namespace vasa {

/// A place of a line: on which vessel, and which way the line runs there.
struct LinePlace {
  std::uint32_t vessel = 0;
  float u = 0;            ///< in [0, spans]
  bool reversed = false;  ///< the line runs against the vessel's parameter
};

/// Vessels joined end to end, at rest: the course that a fork's trunk follows. Measured by the way along it
/// from its first end [m], which chords of an eighth of a span approximate.
class VesselLine {
 public:
  struct Part {
    VesselId vessel;
    bool reversed = false;
  };
  VesselLine(const Network& network, std::vector<Part> parts);

  std::span<const Part> parts() const { return parts_; }
  float length() const { return samples_.back().at; }
  /// Of its course and radii, whatever the numbers of its vessels.
  std::uint64_t key() const;
  /// Where one part ends and the next begins, `gap` further along.
  struct Join {
    float at = 0, gap = 0;
  };
  std::span<const Join> joins() const { return joins_; }
  /// Way of a vessel's parameter, for a vessel of this line.
  float wayOf(VesselId vessel, float u) const;
  LinePlace place(float way) const;
  /// Centre and radius.
  vec4 point(float way) const;
  /// Unit, the way the line runs.
  vec3 tangent(float way) const;

  struct Foot {
    float way = 0, distance = 0, radius = 0;
  };
  /// The nearest place of the line within `reach` of the way `around`.
  Foot nearest(vec3 point, float around, float reach) const;

 private:
  struct Sample {
    vec3 centre;
    float radius, at, u;
    std::uint32_t part;
  };
  std::size_t sampleBefore(float way) const;

  std::vector<Part> parts_;
  std::vector<Join> joins_;
  std::vector<Sample> samples_;
};

/// How the vessels of a network hang together for the eye.
struct LineEnd {
  bool isBranch = false;   ///< leaves the side of `host`; else nothing is there: a cap
  std::uint32_t host = 0;  ///< line
  float hostWay = 0;       ///< where on it the vessels meet
};
struct VesselLines {
  std::vector<VesselLine> lines;
  std::vector<std::array<LineEnd, 2>> ends;  ///< of each line: its first and its last
  std::uint32_t doubles = 0;                 ///< vessels in no line
};

/// At a node without host the two ends that run on into one another best (straight, of like size) become one
/// line, the others branches of it; an end on the side of a vessel is a branch of that vessel's line, unless
/// it meets the vessel's free end, which it then prolongs. What meets a vessel's side within a radius or two
/// of its end, or where that still runs within its own host, meets where that end does: scanned parts
/// overlap. No line is closed. A vessel that leads from another's end to its side a few radii on, or from
/// such a place to itself, is a double: it is in no line, and what hangs on it hangs on the other.
/// @param apart  pairs of vessels that do not become one line
VesselLines makeVesselLines(const Network& network, std::span<const std::array<VesselId, 2>> apart = {});

}  // namespace vasa
