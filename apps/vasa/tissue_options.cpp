#include "tissue_options.h"

namespace vasa::cli {

Keep TissueOptions::kept() const {
  if (noVolume || keep == "radii") return Keep::radii;
  return keep == "wall" ? Keep::wall : Keep::volume;
}

void addTissueOptions(CLI::App& sub, TissueOptions& options) {
  CLI::Option* keep =
      sub.add_option(
             "--keep", options.keep,
             "What vessels keep: volume, wall (arteries their radii within 10 %, veins do not fill) or radii")
          ->check(CLI::IsMember({"volume", "wall", "radii"}))
          ->capture_default_str();
  sub.add_flag("--no-volume", options.noVolume, "The same as --keep radii")->excludes(keep);
  sub.add_flag("--no-slide", options.noSlide, "Leave every vessel glued to its bed, point by point");
}

}  // namespace vasa::cli
