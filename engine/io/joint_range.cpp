#include "io/joint_range.h"

#include <algorithm>
#include <array>
#include <utility>

#include "body/mirror.h"
#include "io/csv.h"

namespace vasa {
namespace {

constexpr std::array kMotions{std::pair("flexion", JointRange::Motion::flexion),
                              std::pair("abduction", JointRange::Motion::abduction),
                              std::pair("twist", JointRange::Motion::twist)};

Result<JointRange::Motion> motionNamed(std::string_view name) {
  for (const auto& [known, motion] : kMotions)
    if (name == known) return motion;
  return badInput(csv::quoted(name) + " is no motion; there are flexion, abduction and twist");
}

}  // namespace

JointAngles JointRange::at(float angle) const {
  JointAngles angles{part};
  (motion == Motion::flexion     ? angles.flexion
   : motion == Motion::abduction ? angles.abduction
                                 : angles.twist) = angle;
  return angles;
}

Result<std::vector<JointRange>> readJointRanges(const std::filesystem::path& path) {
  auto table = csv::Table::read(path);
  if (!table) return table.error();
  std::vector<JointRange> ranges;
  for (std::size_t r = 0; r < table->rowCount(); ++r) {
    JointRange range{std::string(table->text(r, "name")), std::string(table->text(r, "part")),
                     table->take(r, motionNamed(table->text(r, "motion"))),
                     glm::radians(table->number(r, "low_deg")), glm::radians(table->number(r, "high_deg"))};
    if (!(range.low <= 0 && range.high >= 0 && range.low < range.high))
      table->fault(r, "low_deg and high_deg must be on both sides of 0, the rest pose");
    if (!(range.low >= -kPi && range.high <= kPi))
      table->fault(
          r, "low_deg and high_deg must be from -180 to 180, as a joint comes to the same place beyond");
    if (std::ranges::count(ranges, range.name, &JointRange::name))
      table->fault(r, "there are two ranges called " + csv::quoted(range.name));
    ranges.push_back(range);
    if (!hasSide(range.part)) continue;
    range.name = mirrored(range.name), range.part = mirrored(range.part);
    ranges.push_back(std::move(range));
  }
  if (!table->state()) return table->state().error();
  if (ranges.empty())
    return badInput(path.string() +
                    ": has no row below its header; data/realism/ranges.csv shows what one is like");
  return ranges;
}

}  // namespace vasa
