#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "curve/bspline.h"
#include "network/measure_course.h"
#include "network/measure_fork.h"
#include "network/measure_lesion.h"
#include "viewer/flow.h"
#include "viewer/fuzzy.h"
#include "viewer/panels.h"
#include "viewer/projection.h"
#include "viewer/way_profile.h"

// The chosen vessel: what it is, how large, and where it belongs; search by name; measuring along vessels.
namespace vasa::viewer {
namespace {

void choose(const PanelInput& in, VesselId vessel, bool go) {
  in.state.selected = VesselPlace{vessel, 0};
  in.state.alsoChosen.clear();
  revealChoice(in.state, *in.document->groups);
  if (go) in.state.wishFocus = true;
}

void showSearch(const PanelInput& in) {
  ViewState& state = in.state;
  if (state.wishSearch) ImGui::SetKeyboardFocusHere();
  state.wishSearch = false;
  ImGui::SetNextItemWidth(-1);
  bool first = ImGui::InputTextWithHint("##search", "Search vessels (Ctrl F)", &state.search,
                                        ImGuiInputTextFlags_EnterReturnsTrue);
  if (state.search.empty()) return;
  const auto& vessels = in.document->scene.network.vessels();
  std::vector<std::string_view> names;
  for (const Vessel& vessel : vessels) names.push_back(vessel.name);
  const std::vector<std::uint32_t> found = fuzzySearch(state.search, names);
  if (found.empty()) return ImGui::TextDisabled("No vessel answers to that.");
  constexpr std::size_t kMostRows = 6;
  const float rows = float(std::min(found.size(), kMostRows)) * ImGui::GetTextLineHeightWithSpacing();
  if (ImGui::BeginChild("##found", {0, rows + 2 * ImGui::GetStyle().WindowPadding.y}, true)) {
    for (const std::uint32_t v : found) {
      ImGui::PushID(int(v));
      const bool chosen =
          ImGui::Selectable(vessels[v].name.c_str(), state.selected && state.selected->vessel.value == v);
      if (chosen || std::exchange(first, false)) choose(in, {v}, true);
      ImGui::PopID();
    }
  }
  ImGui::EndChild();
}

// Two columns: now, at rest; in a narrow panel one above the other.
class Facts {
 public:
  explicit Facts(float scale)
      : narrow_(ImGui::GetContentRegionAvail().x < 250 * scale),
        open_(ImGui::BeginTable("##facts", narrow_ ? 2 : 3)) {
    if (!open_) return;
    const float names = narrow_ ? ImGui::CalcTextSize("Clearance").x : 72 * scale;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, names);
    ImGui::TableSetupColumn(narrow_ ? "now, at rest" : "now", ImGuiTableColumnFlags_WidthStretch);
    if (!narrow_) ImGui::TableSetupColumn("at rest", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
  }
  ~Facts() {
    if (open_) ImGui::EndTable();
  }
  void row(const char* name, const std::string& now, const std::string& rest) {
    if (!open_) return;
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name);
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted(now.c_str());
    if (!narrow_) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(rest.c_str());
    } else if (!rest.empty()) {
      ImGui::TextDisabled("%s", rest.c_str());
    }
    ImGui::PopTextWrapPos();
  }

 private:
  bool narrow_, open_;
};

std::string winding(const CourseMeasures& course) {
  return course.tortuosity > 0 ? fmt::format("{:.2f} x chord", course.tortuosity) : "its ends meet";
}

std::string inflections(const CourseMeasures& course) {
  return fmt::format("{}, {:.0f}°/cm", course.inflections, glm::degrees(course.sumOfAngles) / 100);
}

std::string leastBend(const CourseMeasures& course) {
  if (!(course.leastBendRadius > 0)) return "straight";
  return fmt::format("{:.1f} mm{}", 1000 * course.leastBendRadius, course.greatestKink >= 1 ? ", kinks" : "");
}

std::string narrowing(std::span<const ProfileStation> stations) {
  const auto worst = worstStenosis(stations);
  if (!worst || worst->ecst() < kNotableStenosis) return "none";
  return fmt::format("NASCET {:.0f} %, ECST {:.0f} %, area {:.0f} %", 100 * worst->nascet(),
                     100 * worst->ecst(), 100 * worst->area());
}

std::string widening(std::span<const ProfileStation> stations) {
  const auto widest = widestAneurysm(stations);
  if (!widest || widest->ratio() < kNotableAneurysm) return "none";
  return fmt::format("{:.1f} mm wide, {:.1f} times, saccular index {:.1f}", 1000 * widest->diameter(),
                     widest->ratio(), widest->saccularIndex());
}

void showFacts(const PanelInput& in, VesselId id) {
  const Network& network = in.document->scene.network;
  const Vessel& vessel = network.vessel(id);
  const auto posed = Network::pointsOf(vessel, in.body->points), asMade = network.pointsOf(vessel);
  const VesselMeasures now = measureVessel(posed), rest = measureVessel(asMade);
  const CourseMeasures course = measureCourse(posed), restCourse = measureCourse(asMade);
  const auto stations = stationsOf(posed, lesionStep(posed)),
             restStations = stationsOf(asMade, lesionStep(asMade));
  const auto mm = [](float metres) { return fmt::format("{:.2f} mm", 1000 * metres); };
  const auto range = [](const VesselMeasures& m) {
    return fmt::format("{:.2f}–{:.2f} mm", 1000 * m.leastRadius, 1000 * m.greatestRadius);
  };
  Facts facts(in.scale);
  facts.row("Length", fmt::format("{:.1f} mm", 1000 * now.length),
            fmt::format("{:.1f} mm", 1000 * rest.length));
  facts.row("Radius", range(now), range(rest));
  facts.row("Mean", mm(now.meanRadius), mm(rest.meanRadius));
  facts.row("Volume", fmt::format("{:.3f} ml", 1e6 * now.volume),
            fmt::format("{:.3f} ml", 1e6 * rest.volume));
  facts.row("Least bend", leastBend(course), leastBend(restCourse));
  facts.row("Winding", winding(course), winding(restCourse));
  facts.row("Inflections", inflections(course), inflections(restCourse));
  facts.row("Narrowing", narrowing(stations), narrowing(restStations));
  facts.row("Widening", widening(stations), widening(restStations));
  std::string clearance = "when paused";
  if (!in.body->measures.empty()) {
    const auto gap = in.body->measures[id.value].clearance;
    clearance = gap ? mm(*gap) : "> 10 mm";
  }
  facts.row("Clearance", clearance, "");
}

void tellArm(const ForkMeasures& fork, const ForkArm& arm) {
  std::string text =
      fmt::format("  {:.0f}° aside, {:.1f} mm wide", glm::degrees(arm.angle), 2000 * arm.radius);
  if (fork.murray) text += fmt::format(", Murray {:.1f}", *fork.murray);
  ImGui::PushTextWrapPos();
  ImGui::TextDisabled("%s", text.c_str());
  ImGui::PopTextWrapPos();
  if (fork.murray && ImGui::IsItemHovered())
    ImGui::SetTooltip("The fork's arms and trunk keep r^x for x = %.1f (Murray's law: 3)",
                      double(*fork.murray));
}

// @param forks  where some of them leave the chosen vessel, in the present pose
void showRelatives(const PanelInput& in, const char* title, std::span<const VesselId> relatives,
                   std::span<const ForkMeasures> forks) {
  if (relatives.empty()) return;
  ImGui::TextDisabled("%s", title);
  for (const VesselId vessel : relatives) {
    ImGui::PushID(int(vessel.value));
    if (selectableLines(in.document->scene.network.vessel(vessel).name)) choose(in, vessel, false);
    ImGui::PopID();
    for (const ForkMeasures& fork : forks)
      for (const ForkArm& arm : fork.arms)
        if (arm.vessel == vessel) tellArm(fork, arm);
  }
}

// From its start, on the left, to its end.
void showProfile(const PanelInput& in, const WayProfile& way) {
  std::vector<float> radii;
  for (const ProfileStation& station : way.stations) radii.push_back(1000 * station.radius);
  const float most = *std::ranges::max_element(radii);
  ImGui::TextDisabled("radius, up to %.1f mm", double(most));
  ImGui::PlotLines("##profile", radii.data(), int(radii.size()), 0, nullptr, 0, 1.1f * most,
                   {ImGui::GetContentRegionAvail().x, 64 * in.scale});
  if (ImGui::Button("Save profile")) in.state.wishSaveProfile = true;
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("Radius and area along %s, as a picture (PNG) and a table (CSV)", way.title.c_str());
}

void showMeasure(const PanelInput& in) {
  ViewState& state = in.state;
  ImGui::Checkbox("Measure (M)", &state.measuring);
  if (!state.measuring) return;
  const Network& network = in.document->scene.network;
  const auto name = [&](const std::optional<VesselPlace>& place) {
    return place ? network.vessel(place->vessel).name.c_str() : "click a vessel";
  };
  ImGui::PushTextWrapPos();
  ImGui::TextDisabled("from");
  ImGui::SameLine(50 * in.scale);
  ImGui::TextUnformatted(name(state.from));
  ImGui::TextDisabled("to");
  ImGui::SameLine(50 * in.scale);
  ImGui::TextUnformatted(name(state.to));
  ImGui::PopTextWrapPos();
  if (!state.from || !state.to) return;
  const auto way = profileOf(state, network, in.body->points);
  if (!way) return ImGui::TextUnformatted("No vessel joins them.");
  ImGui::PushTextWrapPos();
  ImGui::Text("%.1f mm along %zu vessel%s, %.1f mm straight", double(1000 * way->length()), way->vessels,
              way->vessels == 1 ? "" : "s", double(1000 * way->straight()));
  ImGui::PopTextWrapPos();
  showProfile(in, *way);
}

}  // namespace

void showInspectorSection(const PanelInput& in) {
  if (!in.document || !in.body || !ImGui::CollapsingHeader("Chosen vessel", ImGuiTreeNodeFlags_DefaultOpen))
    return;
  showSearch(in);
  if (in.state.selected) {
    const VesselId id = in.state.selected->vessel;
    const Vessel& vessel = in.document->scene.network.vessel(id);
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted(vessel.name.c_str());
    ImGui::PopTextWrapPos();
    ImGui::TextDisabled("%s%s%s", std::string(kindName(vessel.kind)).c_str(),
                        vessel.ontologyId.empty() ? "" : ", ", vessel.ontologyId.c_str());
    showFacts(in, id);
    if (ImGui::Button("Go to (F)")) in.state.wishFocus = true;
    sameLineWithRoom(checkboxWidth("Only its tree (I)"));
    ImGui::Checkbox("Only its tree (I)", &in.state.isolate);
    const Relatives relatives = relativesOf(in.document->scene.network, id);
    showRelatives(in, "comes from", relatives.parents, {});
    showRelatives(in, "gives off", relatives.children,
                  measureForks(in.document->scene.network, in.body->points, id));
    if (!in.state.measuring)
      if (const auto way = profileOf(in.state, in.document->scene.network, in.body->points))
        showProfile(in, *way);
  } else {
    ImGui::TextDisabled("Click a vessel to choose it.");
  }
  showMeasure(in);
}

void showChosen(const PanelInput& in) {
  if (!in.document || !in.body || !in.state.selected) return;
  constexpr int kStepsPerSpan = 6;
  const Vessel& vessel = in.document->scene.network.vessel(in.state.selected->vessel);
  const auto points = Network::pointsOf(vessel, in.body->points);
  const Rect& picture = in.layout.picture;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect({picture.left, picture.top},
                    {picture.left + picture.width, picture.top + picture.height});
  std::optional<vec2> before;
  for (std::uint32_t i = 0; i <= kStepsPerSpan * vessel.spanCount(); ++i) {
    const auto here = seenAt(vec3(evaluate(points, float(i) / kStepsPerSpan)), in.camera, picture);
    if (before && here)
      list.AddLine({before->x, before->y}, {here->x, here->y}, IM_COL32(255, 176, 20, 200), 1.5f * in.scale);
    before = here;
  }
  list.PopClipRect();
}

}  // namespace vasa::viewer
