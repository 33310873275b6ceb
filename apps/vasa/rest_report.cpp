#include "rest_report.h"

#include <fmt/format.h>

#include "core/visible.h"

namespace vasa::cli {

void addRestRepair(Report& report, const RestRepair& repair) {
  report["rest_pairs_before"] = repair.pairsBefore;
  report["rest_pairs_after"] = repair.pairsAfter;
  report["rest_moved_max_mm"] = 1e3 * repair.movedMax;
  report["rest_thinned_max"] = repair.thinnedMax;
  Report left = Report::array();
  for (const RestOverlap& overlap : repair.left)
    left.push_back(
        {{"vessels", {repair.network.vessel(overlap.first).name, repair.network.vessel(overlap.second).name}},
         {"pairs", overlap.pairs},
         {"depth_mm", 1e3 * overlap.depth},
         {"reason", reasonName(overlap.reason)}});
  report["rest_overlaps"] = std::move(left);
}

std::string restRepairText(const RestRepair& repair) {
  if (repair.pairsBefore == 0) return {};
  std::string text = fmt::format(
      "overlaps   {} pairs of sweeps before, {} after: moved by up to {:.1f} mm, thinned by up to {:.0f} %\n",
      repair.pairsBefore, repair.pairsAfter, 1e3 * repair.movedMax, 100 * repair.thinnedMax);
  for (const RestOverlap& overlap : repair.left)
    text += fmt::format("           {} and {}: {} pairs, {:.1f} mm deep ({})\n",
                        visible(repair.network.vessel(overlap.first).name),
                        visible(repair.network.vessel(overlap.second).name), overlap.pairs,
                        1e3 * overlap.depth, reasonName(overlap.reason));
  return text;
}

}  // namespace vasa::cli
