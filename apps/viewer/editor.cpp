#include "viewer/editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "curve/arc_length.h"
#include "curve/frame.h"
#include "edit/replay.h"
#include "surface/sweep_table.h"
#include "viewer/projection.h"

namespace vasa::viewer {
namespace {

constexpr float kHandleReach = 9;    // [pixels of an ordinary screen] of the handle, as a joint's
constexpr double kSamePlace = 2e-3;  // of a vessel
// [radii] to either side that a drag takes along, where the default of `move` (three times the way) is less:
// a wall that is moved within less of its own width folds. An abdominal aorta of 6.6 mm is moved by 1 mm and
// more.
constexpr double kLeastFalloff = 5;
constexpr double kWayToFalloff = 3;

// A number of so many decimals that is written with no more of them.
double decimals(double value, int count) { return std::stod(fmt::format("{:.{}f}", value, count)) + 0.0; }

template <class Line>
std::optional<Line> lastLine(const ViewState& state) {
  if (state.journal.empty()) return std::nullopt;
  const auto edits = parseJournal(state.journal.back(), "");
  if (!edits || edits->empty()) return std::nullopt;
  const auto* line = std::get_if<Line>(&edits->front().operation);
  return line ? std::optional(*line) : std::nullopt;
}

struct Chosen {
  std::string vessel;
  double share;
};
std::optional<Chosen> chosenOf(const Document& document, const ViewState& state) {
  if (!state.selected) return std::nullopt;
  const Network& network = document.scene.network;
  return Chosen{network.vessel(state.selected->vessel).name, shareOf(network, *state.selected)};
}

// The last line where it is of this kind and about this place.
template <class Line>
std::optional<Line> lineThere(const std::optional<Chosen>& chosen, const ViewState& state) {
  auto line = lastLine<Line>(state);
  if (!line || !chosen || line->vessel != chosen->vessel ||
      std::abs(placeOf(EditOperation(*line)) - chosen->share) > kSamePlace)
    return std::nullopt;
  return line;
}

void writeLine(ViewState& state, const EditOperation& operation, bool anew) {
  if (anew) state.journal.pop_back();
  state.journal.push_back(journalLine(operation));
}

double lengthOf(const Network& network, VesselId vessel) {
  return 1e3 * ArcLength(network.pointsOf(network.vessel(vessel))).length();
}

// [m] centre and radius
vec4 atRest(const Network& network, const VesselPlace& place) {
  return evaluate(network.pointsOf(network.vessel(place.vessel)), place.parameter);
}

// A name that no vessel has.
std::string newName(const Network& network, const std::string& stem) {
  for (int n = 1;; ++n) {
    std::string name = n == 1 ? stem : fmt::format("{} {}", stem, n);
    if (std::ranges::none_of(network.vessels(), [&](const Vessel& v) { return v.name == name; })) return name;
  }
}

}  // namespace

double shareOf(const Network& network, const VesselPlace& place) {
  const ArcLength arc(network.pointsOf(network.vessel(place.vessel)));
  return arc.length() > 0 ? decimals(double(arc.along(place.parameter) / arc.length()), 4) : 0;
}

VesselPlace placeAt(const Network& network, VesselId vessel, double share) {
  const ArcLength arc(network.pointsOf(network.vessel(vessel)));
  return {vessel, arc.parameterAt(float(share) * arc.length())};
}

vec3 centreOf(const Document& document, const PosedBody& body, const VesselPlace& place) {
  const Vessel& vessel = document.scene.network.vessel(place.vessel);
  return vec3(evaluate(Network::pointsOf(vessel, body.points), place.parameter));
}

// Both frames are carried along the vessel from its start, whose reference turns with what surrounds it.
quat turnSinceRest(const Document& document, const PosedBody& body, const VesselPlace& place) {
  const Network& network = document.scene.network;
  const Vessel& vessel = network.vessel(place.vessel);
  const auto points = network.pointsOf(vessel);
  std::vector<quat> rest(vessel.spanCount() + 1);
  knotFrames(points, anyPerpendicular(unitTangent(points, 0)), rest);
  const auto knot = std::min(std::uint32_t(std::lround(place.parameter)), vessel.spanCount());
  return body.knotFrames[firstKnot(network, place.vessel) + knot] * glm::inverse(rest[knot]);
}

bool Editor::feed(const InputEvent& event, const Document& document, const PosedBody& body,
                  const Camera& camera, const Rect& picture, ViewState& state) {
  if (!keepsWay(document, state)) way_ = {};
  if (const auto* moved = std::get_if<PointerMoved>(&event)) {
    place_ = moved->place;
    if (!held_ || place_ == held_->pressed) return held();
    const vec3 way = held_->back * wayInPlane(camera, held_->from, place_ - held_->pressed, picture.height);
    for (int axis = 0; axis < 3; ++axis) held_->line.byMm[axis] = decimals(1e3 * double(way[axis]), 2);
    const bool narrow = kWayToFalloff * glm::length(held_->line.byMm) < held_->leastFalloffMm;
    held_->line.falloffMm = narrow ? held_->leastFalloffMm : 0;
    writeLine(state, held_->line, std::exchange(held_->written, true));
    return true;
  }
  const auto* button = std::get_if<ButtonChanged>(&event);
  if (!button || button->button != Button::left) return false;
  if (!button->down) return std::exchange(held_, std::nullopt).has_value();
  if (state.editTool != EditTool::change || !state.selected) return false;
  const vec3 centre = centreOf(document, body, *state.selected);
  const auto seen = seenAt(centre, camera, picture);
  if (!seen || glm::distance(*seen, place_) > kHandleReach * scale_) return false;
  const auto chosen = chosenOf(document, state);
  held_ = Held{};  // clang 14 knows no emplace() of a class that is nested here
  Held& held = *held_;
  held.line.vessel = chosen->vessel;
  held.line.at = chosen->share;
  held.from = centre;
  held.back = glm::inverse(turnSinceRest(document, body, *state.selected));
  held.pressed = place_;
  held.leastFalloffMm =
      decimals(kLeastFalloff * 1e3 * double(atRest(document.scene.network, *state.selected).w), 1);
  return true;
}

bool Editor::click(vec2 place, const std::optional<VesselPlace>& hit, const Document& document,
                   const PosedBody& body, const Camera& camera, const Rect& picture, ViewState& state) {
  if (state.editTool == EditTool::change || !state.selected) return false;
  const Network& network = document.scene.network;
  const auto chosen = chosenOf(document, state);
  const double radius = decimals(1e3 * double(atRest(network, *state.selected).w), 2);
  const vec3 centre = centreOf(document, body, *state.selected);
  const auto seen = seenAt(centre, camera, picture);
  const vec3 way = seen ? glm::inverse(turnSinceRest(document, body, *state.selected)) *
                              wayInPlane(camera, centre, place - *seen, picture.height)
                        : vec3(0);
  if (state.editTool == EditTool::graft) {
    if (!hit && !seen) {
      refusal = "The place where the graft begins is not in the picture.";
      return true;
    }
    if (!keepsWay(document, state)) way_ = {document.base, *state.selected, {}};
    if (!hit) {
      way_.via.push_back(vec3(atRest(network, *state.selected)) + way);
      return true;
    }
    state.editTool = EditTool::change;
    const std::string& other = network.vessel(hit->vessel).name;
    const double least = std::min(radius, decimals(1e3 * double(atRest(network, *hit).w), 2));
    GraftEdit line{chosen->vessel,
                   chosen->share,
                   other,
                   shareOf(network, *hit),
                   least,
                   newName(network, "graft from " + chosen->vessel + " to " + other),
                   {}};
    for (const vec3& passed : std::exchange(way_, {}).via)
      line.via.emplace_back(decimals(1e3 * double(passed.x), 1), decimals(1e3 * double(passed.y), 1),
                            decimals(1e3 * double(passed.z), 1));
    writeLine(state, line, false);
    return true;
  }
  state.editTool = EditTool::change;
  if (!seen) return true;
  BranchEdit line{chosen->vessel, chosen->share, newName(network, "branch of " + chosen->vessel)};
  line.radiusMm = decimals(0.5 * radius, 2);
  line.lengthMm = decimals(1e3 * double(glm::length(way)), 2);
  for (int axis = 0; axis < 3; ++axis)
    line.direction[axis] = decimals(double(way[axis]) / std::max(double(glm::length(way)), 1e-9), 3);
  writeLine(state, line, false);
  return true;
}

std::vector<vec3> Editor::passed(const Document& document, const PosedBody& body,
                                 const ViewState& state) const {
  std::vector<vec3> now;
  if (!keepsWay(document, state)) return now;
  const vec3 centre = centreOf(document, body, *state.selected),
             rest = vec3(atRest(document.scene.network, *state.selected));
  const quat turn = turnSinceRest(document, body, *state.selected);
  for (const vec3& place : way_.via) now.push_back(centre + turn * (place - rest));
  return now;
}

bool Editor::keepsWay(const Document& document, const ViewState& state) const {
  return state.editing && state.editTool == EditTool::graft && state.selected && document.base == way_.base &&
         state.selected->vessel == way_.begin.vessel && state.selected->parameter == way_.begin.parameter;
}

bool Editor::dropPassed(const Document& document, const ViewState& state) {
  if (!keepsWay(document, state) || way_.via.empty()) return false;
  way_.via.pop_back();
  return true;
}

std::optional<StenosisEdit> Editor::stenosisThere(const Document& document, const ViewState& state) const {
  return lineThere<StenosisEdit>(chosenOf(document, state), state);
}

std::optional<RadiusEdit> Editor::radiusThere(const Document& document, const ViewState& state) const {
  return lineThere<RadiusEdit>(chosenOf(document, state), state);
}

void Editor::setStenosis(double percent, const Document& document, ViewState& state) const {
  const auto chosen = chosenOf(document, state);
  if (!chosen) return;
  const auto before = stenosisThere(document, state);
  StenosisEdit line = before.value_or(StenosisEdit{chosen->vessel, chosen->share});
  line.lengthMm = decimals(lengthMm, 1);
  line.percent = std::round(percent);
  writeLine(state, line, before.has_value());
}

// All along the stretch, which may be cut short by the vessel's ends.
void Editor::setRadius(double factor, const Document& document, ViewState& state) const {
  const auto chosen = chosenOf(document, state);
  if (!chosen) return;
  const auto before = radiusThere(document, state);
  const double length = lengthOf(document.scene.network, state.selected->vessel);
  const double half = std::min({0.5 * lengthMm / length, chosen->share, 1 - chosen->share});
  RadiusEdit line{chosen->vessel, decimals(chosen->share - half, 4), decimals(chosen->share + half, 4)};
  if (before) line = *before;
  line.factor = decimals(factor, 2);
  writeLine(state, line, before.has_value());
}

void Editor::remove(bool tree, const Document& document, ViewState& state) const {
  if (const auto chosen = chosenOf(document, state))
    writeLine(state, DeleteEdit{chosen->vessel, tree}, false);
}

}  // namespace vasa::viewer
