#include "vessel_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "network/measure_course.h"
#include "network/measure_fork.h"
#include "network/measure_lesion.h"

namespace vasa::cli {
namespace {

Report maybe(bool there, double value) { return there ? Report(value) : Report(nullptr); }

double degrees(float radians) { return double(radians) * 180 / double(kPi); }

std::string cell(const Report& value, double factor, int digits) {
  return value.is_null() ? "-" : fmt::format("{:.{}f}", factor * value.get<double>(), digits);
}

Report oneVessel(const Vessel& vessel, std::span<const vec4> points) {
  const CourseMeasures course = measureCourse(points);
  const auto stations = stationsOf(points, lesionStep(points));
  const auto [least, greatest] = std::ranges::minmax(stations, {}, &ProfileStation::radius);
  const auto stenosis = worstStenosis(stations);
  const auto aneurysm = widestAneurysm(stations);
  const auto share = [&](float along) { return course.arc > 0 ? along / course.arc : 0.0f; };
  return {{"name", vessel.name},
          {"kind", kindName(vessel.kind)},
          {"id", vessel.ontologyId},
          {"sweeps", vessel.spanCount()},
          {"length_m", course.arc},
          {"volume_m3", volumeOf(points)},
          {"radius_start_m", points.front().w},
          {"radius_end_m", points.back().w},
          {"radius_least_m", least.radius},
          {"radius_greatest_m", greatest.radius},
          {"nascet", stenosis ? stenosis->nascet() : 0},
          {"ecst", stenosis ? stenosis->ecst() : 0},
          {"area_stenosis", stenosis ? stenosis->area() : 0},
          {"stenosis_at", maybe(stenosis.has_value(), stenosis ? share(stenosis->along) : 0)},
          {"stenosis_length_m", maybe(stenosis.has_value(), stenosis ? stenosis->length() : 0)},
          {"aneurysm_diameter_m", maybe(aneurysm.has_value(), aneurysm ? aneurysm->diameter() : 0)},
          {"aneurysm_ratio", aneurysm ? aneurysm->ratio() : 1},
          {"aneurysm_at", maybe(aneurysm.has_value(), aneurysm ? share(aneurysm->along) : 0)},
          {"aneurysm_length_m", maybe(aneurysm.has_value(), aneurysm ? aneurysm->length() : 0)},
          {"saccular_index", maybe(aneurysm.has_value(), aneurysm ? aneurysm->saccularIndex() : 0)},
          {"chord_m", course.chord},
          {"tortuosity", maybe(course.tortuosity > 0, course.tortuosity)},
          {"inflections", course.inflections},
          {"inflection_metric", maybe(course.tortuosity > 0, course.inflectionMetric)},
          {"sum_of_angles_rad_m", course.sumOfAngles},
          {"least_bend_radius_m", maybe(course.leastBendRadius > 0, course.leastBendRadius)},
          {"bend_at", maybe(course.leastBendRadius > 0, share(course.bendAt))},
          {"radius_times_curvature", course.greatestKink}};
}

}  // namespace

Report vesselReport(const Network& network) {
  Report vessels = Report::array();
  for (const Vessel& vessel : network.vessels())
    vessels.push_back(oneVessel(vessel, network.pointsOf(vessel)));
  return vessels;
}

Report forkReport(const Network& network) {
  Report forks = Report::array();
  for (const ForkMeasures& fork : measureForks(network, network.points())) {
    Report arms = Report::array();
    for (const ForkArm& arm : fork.arms)
      arms.push_back({{"name", network.vessel(arm.vessel).name},
                      {"goes_on", arm.host},
                      {"radius_m", arm.radius},
                      {"angle_deg", degrees(arm.angle)}});
    forks.push_back({{"name", network.vessel(fork.trunk).name},
                     {"radius_m", fork.trunkRadius},
                     {"parameter", fork.trunkParameter},
                     {"arms", std::move(arms)},
                     {"murray_exponent", maybe(fork.murray.has_value(), fork.murray.value_or(0))}});
  }
  return forks;
}

std::string vesselTable(const Report& vessels) {
  std::string text =
      fmt::format("{:<44} {:<7} {:>8} {:>13} {:>8} {:>6} {:>8} {:>6} {:>8}\n", "vessel", "kind", "mm long",
                  "mm wide", "NASCET %", "ECST %", "widened", "arc/ch", "bend mm");
  for (const Report& vessel : vessels) {
    const bool narrow = vessel["ecst"].get<double>() >= kNotableStenosis,
               wide = vessel["aneurysm_ratio"].get<double>() >= kNotableAneurysm;
    text += fmt::format(
        "{:<44} {:<7} {:>8} {:>13} {:>8} {:>6} {:>8} {:>6} {:>8}\n", plainText(vessel["name"]),
        plainText(vessel["kind"]), cell(vessel["length_m"], 1e3, 1),
        cell(vessel["radius_least_m"], 2e3, 1) + " to " + cell(vessel["radius_greatest_m"], 2e3, 1),
        narrow ? cell(vessel["nascet"], 100, 1) : "", narrow ? cell(vessel["ecst"], 100, 1) : "",
        wide ? cell(vessel["aneurysm_diameter_m"], 1e3, 1) : "", cell(vessel["tortuosity"], 1, 2),
        cell(vessel["least_bend_radius_m"], 1e3, 1));
  }
  return text +
         "per cent of the diameter lost at the narrowest place, from 10 %; widened: mm of diameter where it is 1.2 times what\n"
         "it would be, and more; all of the lumen. --json has every measure.\n";
}

std::string forkTable(const Report& forks) {
  std::string text = fmt::format("{:<44} {:<44} {:>8} {:>7}\n", "fork of", "arm", "mm wide", "degrees");
  for (const Report& fork : forks) {
    bool first = true;
    for (const Report& arm : fork["arms"]) {
      if (arm["goes_on"].get<bool>()) continue;
      text +=
          fmt::format("{:<44} {:<44} {:>8} {:>7}\n", first ? plainText(fork["name"]) : "",
                      plainText(arm["name"]), cell(arm["radius_m"], 2e3, 1), cell(arm["angle_deg"], 1, 0));
      first = false;
    }
  }
  return text;
}

}  // namespace vasa::cli
