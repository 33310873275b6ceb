#include "scene/holds.h"

#include <algorithm>

#include "body/mirror.h"
#include "core/nearest_names.h"
#include "io/csv.h"

namespace vasa {

Result<std::vector<VesselHold>> readHolds(const std::filesystem::path& path, const Network& network) {
  auto table = csv::Table::read(path);
  if (!table) return table.error();
  std::vector<std::string> names;
  for (const Vessel& vessel : network.vessels()) names.push_back(vessel.name);
  std::vector<VesselHold> holds;
  for (std::size_t r = 0; r < table->rowCount(); ++r) {
    const VesselHold hold{std::string(table->text(r, "vessel")), table->number(r, "at")};
    if (!(hold.at >= 0 && hold.at <= 1)) table->fault(r, "at must be a share from 0 to 1");
    if (std::ranges::find(names, hold.vessel) == names.end())
      table->fault(r, "no vessel is called " + csv::quoted(hold.vessel) + "; " +
                          didYouMean(hold.vessel, names, "vasa info NET --vessels lists them"));
    holds.push_back(hold);
  }
  if (!table->state()) return table->state().error();
  const std::vector<VesselHold> rows = holds;
  for (const VesselHold& hold : rows)
    if (const std::string other = mirrored(hold.vessel);
        hold.vessel.starts_with("left ") && std::ranges::find(names, other) != names.end() &&
        std::ranges::find(rows, other, &VesselHold::vessel) == rows.end())
      holds.push_back({other, hold.at});
  return holds;
}

}  // namespace vasa
