#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "network/builder.h"

namespace vasa {

constexpr float kMm = 0.001f;  ///< [m] journals are in mm

/// A network while it is edited. Vessels keep their numbers and new ones are appended; what is taken away
/// stays as a gap until build() closes it.
struct Draft {
  struct Line {
    NetworkBuilder::Label label;
    std::vector<vec4> points;  ///< de Boor points [m]
    VesselId origin;           ///< in the network that was begun with; invalid: appended
    bool gone = false;
    bool touched = false;  ///< its points are no longer the origin's
  };
  struct Joint {
    std::optional<Host> host;
    std::vector<VesselEnd> ends;
  };

  std::vector<Line> lines;
  std::vector<Joint> joints;
  std::vector<ForkPatch> patches;
  float bodyHeight = 1;

  explicit Draft(const Network& network);

  /// Fails as NetworkBuilder::build() does.
  /// @param origins  if given, receives each vessel's origin
  Result<Network> build(std::vector<VesselId>* origins = nullptr) const;

  /// The vessel with this name, upper and lower case alike where no name is the same to the letter. The error
  /// says what names are near.
  Result<VesselId> find(const std::string& name) const;
  bool hasName(const std::string& name) const;

  Line& line(VesselId id) { return lines[id.value]; }
  const Line& line(VesselId id) const { return lines[id.value]; }
  /// The joint that an end belongs to; none where it is free. O(joints)
  Joint* jointOf(VesselEnd end);
  const Joint* jointOf(VesselEnd end) const;
  /// Names of the vessels that hang on a vessel's side within these parameters.
  std::vector<std::string> hangingOn(VesselId vessel, float from, float to) const;

  /// Where places on a redrawn vessel have come to; none: they were on what is no longer there.
  struct Place {
    VesselId vessel;
    float parameter = 0;
  };
  using PlaceMap = std::function<std::optional<Place>(float parameter)>;
  /// Gives a vessel other points, moves what hangs on its side along, and that of those (falling off along
  /// each over three times the way that it is moved). Ends of the vessel itself must not have moved where
  /// they meet others. Kept walls of forks (network/fork_patch.h) that stood on what was `changed` are
  /// dropped.
  /// @param changed  old parameters within which the shape is another
  void redraw(VesselId vessel, std::vector<vec4> points, const PlaceMap& map, float changedFrom,
              float changedTo);

  /// Takes a vessel out of all joints and marks it gone; joints that join nothing any more go too.
  void remove(VesselId vessel);
  void dropEmptyJoints();
  void dropPatchesOn(VesselId vessel);
};

/// The end point of a line.
const vec4& endPoint(const Draft::Line& line, bool last);

}  // namespace vasa
