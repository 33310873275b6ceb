#pragma once
#include <optional>

#include "network/builder.h"

namespace vasa {

/// Vessels as files of centre lines tell them: polylines of sections and where they meet.
struct Centrelines {
  struct Line {
    std::string name;
    std::string ontologyId;
    VesselKind kind = VesselKind::other;
    std::vector<vec4> samples;  ///< (x, y, z, r) [m], at least 2, neighbours distinct, r > 0
  };
  struct Place {
    std::uint32_t line = 0, sample = 0;
  };
  struct End {
    std::uint32_t line = 0;
    bool last = false;
  };
  /// Ends that meet at a sample of another line, or, without a host, at one another.
  struct Joint {
    std::optional<Place> host;
    std::vector<End> ends;
  };
  std::vector<Line> lines;
  std::vector<Joint> joints;

  std::size_t sampleCount() const;
  void append(Centrelines&& other);
};

struct CentrelineNetwork {
  Network network;                             ///< vessel i is line i
  std::vector<std::vector<float>> parameters;  ///< of each line's samples
};

/// A vessel for each line, a node for each joint. A sweep comes within 5 % of a sample's radius of its centre
/// and within 0.5 % of its radius (curve/interpolate.h).
/// @param bodyHeight  [m]; 0: the largest extent of the samples
/// Fails as NetworkBuilder::build does, and without a line. In parallel over lines.
Result<CentrelineNetwork> networkOfCentrelines(const Centrelines& centrelines, float bodyHeight = 0);

/// The other way: samples of a network in some shape, at every knot, at `perSpan - 1` places between knots,
/// and where a side branch leaves. @param points  as Network::points()
Centrelines centrelinesOfNetwork(const Network& network, std::span<const vec4> points,
                                 std::uint32_t perSpan = 1);

}  // namespace vasa
