#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "body/body.h"
#include "body/phases.h"
#include "body/spine.h"
#include "network/network.h"

namespace vasa {

/// What a point is bound to: a station of a spine and its share in the point's motion. The paper's "where
/// along the link, at which angle around it, how far from it" is this station and the rest point in the
/// station's rest frame, which the network holds already.
struct BindingRecord {
  static constexpr float kAlongOne = 32767;  ///< how Station::along is counted: 0, 1 and 2 are exact

  std::uint16_t along;  ///< Station::along, in these
  std::uint16_t joint;  ///< Station::joint
  std::uint16_t share;  ///< of kWholeShare; a point's records follow one another until theirs add up to it

  BindingRecord(const Station& station, std::uint16_t of)
      : along(std::uint16_t(station.along * kAlongOne + 0.5f)),
        joint(std::uint16_t(station.joint.value)),
        share(of) {}
  Station station() const { return {{joint}, float(along) / kAlongOne}; }
};
static_assert(sizeof(BindingRecord) == 6);

constexpr std::uint32_t kWholeShare = 65535;

/// How a set of points hangs on a body. Most points have one record; those between limbs have one for each
/// limb that takes part, and move to the mean of the places.
struct Binding {
  static constexpr std::size_t kBlock = 256;  ///< points that are found by one entry of firstRecord

  SpineSet spines;
  std::uint32_t pointCount = 0;
  std::vector<BindingRecord> records;
  std::vector<std::uint32_t> firstRecord;  ///< of every kBlock-th point
  std::vector<BindingRecord> axialBones;   ///< of the body, one after another, as of points

  /// Bytes of the records and their index: the paper's "binding".
  std::size_t bytes() const {
    return records.size() * sizeof(BindingRecord) + firstRecord.size() * sizeof(std::uint32_t);
  }
};

/// Binds points of a body at rest, first choosing the length of every joint's arc from them.
///
/// In what share a joint has set in at a point is measured from the bones before and behind it and the skin
/// (body/phases.h), over an arc as long as the largest bend in the body's clips and the distance of the
/// joint's vessels ask for (body/arcs.h). At a fork of limbs, those that are not much farther away than the
/// nearest take part. The map from a rest point to its posed place is continuous, and along ties no steeper
/// than the arcs need.
///
/// Fails with badInput: no joints, a broken rest transform, no points, or points that do not belong to this
/// body (body/belonging.h). The body's axial bones are bound as points in their places, along the spine.
/// @param points  (x, y, z, r) [m]; r is not looked at
/// @param name    of what the points are, for messages: the network's file
/// @param ties    points that are next to each other along a vessel
/// O(points · joints), in parallel; the result does not depend on the number of threads.
Result<Binding> bindPoints(const Body& body, std::span<const vec4> points, std::string_view name,
                           std::span<const Tie> ties = {});

/// The station with the largest share in each point's motion. O(points)
std::vector<Station> mainStations(const Binding& binding);

/// Binds a network's de Boor points, with its ties (body/ties.h).
Result<Binding> bind(const Body& body, const Network& network, std::string_view name);

}  // namespace vasa
