#include "realism/protocol.h"

#include <algorithm>
#include <array>

#include "io/csv.h"

namespace vasa {
namespace {

struct MetricWords {
  std::string_view name, unit;
};
// By PoseMetric.
constexpr std::array kMetrics{
    MetricWords{"length_change_percent", "%"},
    MetricWords{"length_change_mm", "mm"},
    MetricWords{"greatest_shortening_percent", "%"},
    MetricWords{"twist_degrees", "degrees"},
    MetricWords{"twist_degrees_per_cm", "degrees/cm"},
    MetricWords{"greatest_twist_degrees_per_cm", "degrees/cm"},
    MetricWords{"curvature_change_per_cm", "1/cm"},
    MetricWords{"curvature_change_percent", "%"},
    MetricWords{"least_bend_radius_mm", "mm"},
    MetricWords{"chord_by_arc_percent", "%"},
    MetricWords{"bone_distance_change_mm", "mm"},
    MetricWords{"fork_angle_change_percent", "%"},
    MetricWords{"radius_change_percent", "%"},
};

const MetricWords& wordsOf(PoseMetric metric) { return kMetrics[std::size_t(metric)]; }

Result<PoseMetric> metricNamed(std::string_view name) {
  const auto found = std::ranges::find(kMetrics, name, &MetricWords::name);
  if (found != kMetrics.end()) return PoseMetric(found - kMetrics.begin());
  std::string known;
  for (const MetricWords& words : kMetrics) known += (known.empty() ? "" : ", ") + std::string(words.name);
  return badInput(csv::quoted(name) + " is no metric; there are " + known);
}

std::optional<float> optionalNumber(csv::Table& table, std::size_t row, std::string_view column) {
  if (table.text(row, column).empty()) return std::nullopt;
  return table.number(row, column);
}

std::string textOf(csv::Table& table, std::size_t row, std::string_view column) {
  return std::string(table.text(row, column));
}

void checkPose(csv::Table& table, std::size_t row, const Protocol& protocol, const std::string& pose) {
  if (pose != "rest" && !protocol.poses.contains(pose))
    table.fault(row, "poses.csv has no pose " + csv::quoted(pose));
}

}  // namespace

std::string_view metricName(PoseMetric metric) { return wordsOf(metric).name; }
std::string_view unitOf(PoseMetric metric) { return wordsOf(metric).unit; }

Result<Protocol> readProtocol(const std::filesystem::path& folder) {
  Protocol protocol;
  auto poses = csv::Table::read(folder / "poses.csv");
  if (!poses) return poses.error();
  for (std::size_t r = 0; r < poses->rowCount(); ++r)
    protocol.poses[textOf(*poses, r, "pose")].push_back(
        {textOf(*poses, r, "part"), glm::radians(poses->number(r, "flex_deg")),
         glm::radians(poses->number(r, "abduct_deg")), glm::radians(poses->number(r, "twist_deg"))});
  if (!poses->state()) return poses->state().error();

  auto rows = csv::Table::read(folder / "protocol.csv");
  if (!rows) return rows.error();
  for (std::size_t r = 0; r < rows->rowCount(); ++r) {
    ProtocolRow row;
    row.id = textOf(*rows, r, "id");
    row.from = textOf(*rows, r, "from"), row.to = textOf(*rows, r, "to");
    row.firstShare = rows->numberOr(r, "first_share", 0), row.lastShare = rows->numberOr(r, "last_share", 1);
    row.firstPose = textOf(*rows, r, "from_pose"), row.lastPose = textOf(*rows, r, "to_pose");
    row.metric = rows->take(r, metricNamed(rows->text(r, "metric")));
    if (const auto level = optionalNumber(*rows, r, "level_mm")) row.level = 1e-3f * *level;
    row.mean = rows->number(r, "mean");
    row.deviation = optionalNumber(*rows, r, "sd");
    row.low = optionalNumber(*rows, r, "low"), row.high = optionalNumber(*rows, r, "high");
    row.blind = rows->text(r, "blind") == "yes";
    row.source = textOf(*rows, r, "source"), row.note = textOf(*rows, r, "note");
    checkPose(*rows, r, protocol, row.firstPose), checkPose(*rows, r, protocol, row.lastPose);
    if (!(row.firstShare >= 0 && row.firstShare < row.lastShare && row.lastShare <= 1))
      rows->fault(r, "shares must rise from 0 to 1");
    protocol.rows.push_back(std::move(row));
  }
  if (!rows->state()) return rows->state().error();

  auto sweeps = csv::Table::read(folder / "sweeps.csv");
  if (!sweeps) return sweeps.error();
  for (std::size_t r = 0; r < sweeps->rowCount(); ++r) {
    ProtocolSweep sweep{textOf(*sweeps, r, "sweep"),
                        textOf(*sweeps, r, "pose"),
                        textOf(*sweeps, r, "from"),
                        textOf(*sweeps, r, "to"),
                        sweeps->take(r, metricNamed(sweeps->text(r, "metric"))),
                        sweeps->number(r, "degrees")};
    checkPose(*sweeps, r, protocol, sweep.pose);
    protocol.sweeps.push_back(std::move(sweep));
  }
  if (!sweeps->state()) return sweeps->state().error();
  return protocol;
}

}  // namespace vasa
