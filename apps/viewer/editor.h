#pragma once
#include <optional>
#include <string>
#include <vector>

#include "edit/journal.h"
#include "viewer/document.h"
#include "viewer/input.h"
#include "viewer/layout.h"
#include "viewer/pose_worker.h"
#include "viewer/view_state.h"

namespace vasa::viewer {

/// What a person changes the chosen vessel by: every act is a line of the journal in the state, which is
/// replayed like any other (editedDocument). An act that goes on, such as a drag, writes its line anew.
class Editor {
 public:
  float lengthMm = 10;  ///< of a stenosis, and of a stretch whose radius is scaled
  std::string refusal;  ///< why the latest line was not done; empty: it was

  /// @param scale  pixels for one of an ordinary screen
  explicit Editor(float scale = 1) : scale_(scale) {}

  void hover(vec2 place) { place_ = place; }
  /// Drags the chosen place in the picture's plane. @return whether the event was a drag's
  bool feed(const InputEvent& event, const Document& document, const PosedBody& body, const Camera& camera,
            const Rect& picture, ViewState& state);
  bool held() const { return held_.has_value(); }

  /// A click where a branch or a graft is to end, or beside all vessels at a place that the graft is to pass,
  /// as far from the eye as the chosen place. @param hit  the vessel there. @return whether it meant that
  bool click(vec2 place, const std::optional<VesselPlace>& hit, const Document& document,
             const PosedBody& body, const Camera& camera, const Rect& picture, ViewState& state);

  /// Where such places are now [m].
  std::vector<vec3> passed(const Document& document, const PosedBody& body, const ViewState& state) const;
  /// Takes the last of them back. @return whether there was one
  bool dropPassed(const Document& document, const ViewState& state);

  void setStenosis(double percent, const Document& document, ViewState& state) const;
  void setRadius(double factor, const Document& document, ViewState& state) const;
  void remove(bool tree, const Document& document, ViewState& state) const;  ///< with all that hangs on it
  /// What the last line sets at the chosen place; nothing where it is about something else.
  std::optional<StenosisEdit> stenosisThere(const Document& document, const ViewState& state) const;
  std::optional<RadiusEdit> radiusThere(const Document& document, const ViewState& state) const;

 private:
  bool keepsWay(const Document& document, const ViewState& state) const;

  struct Held {
    MoveEdit line;
    vec3 from;     // [m] in the posed world
    quat back;     // from there to rest
    vec2 pressed;  // [pixels]
    double leastFalloffMm = 0;
    bool written = false;
  };
  float scale_;
  vec2 place_{0};
  std::optional<Held> held_;
  // Places that a graft is to pass; gone with the tool, and where it begins elsewhere.
  struct Way {
    std::shared_ptr<const Network> base;  // Document::base
    VesselPlace begin;
    std::vector<vec3> via;  // [m] at rest
  };
  Way way_;
};

/// A place on a vessel as journals have it: a share of its arc length at rest.
double shareOf(const Network& network, const VesselPlace& place);
VesselPlace placeAt(const Network& network, VesselId vessel, double share);

/// Where a place is now [m], and the turn of its surroundings since rest.
vec3 centreOf(const Document& document, const PosedBody& body, const VesselPlace& place);
quat turnSinceRest(const Document& document, const PosedBody& body, const VesselPlace& place);

}  // namespace vasa::viewer
