#pragma once
#include <algorithm>

#include "camera_choice.h"
#include "convert/source.h"
#include "core/image.h"
#include "frame_output.h"
#include "gpu/device.h"
#include "report.h"
#include "scene/growth.h"
#include "surface/sweep_table.h"

// vasa paper: the source paper's tables and figures, each made by a function of its own out of one study.
namespace vasa::cli {

/// What all of them look at. Immutable once made.
struct PaperStudy {
  Scene scene;
  const Clip* clip = nullptr;         ///< nullptr: the body stays at rest
  std::vector<SourceElement> meshes;  ///< what the network stands for: given, or meshesOf() it
  bool meshesGiven = false;
  SweepTable table;
  SceneGrowth growth;
  CameraMan camera;
  PictureSize size;  ///< of Table III's pictures; those of the figures grow with its height
  bool quick = false;
  std::uint32_t seed = 1;

  /// Pixels for so many at a height of 720.
  std::uint32_t pixels(std::uint32_t at720) const { return std::max(8u, at720 * size.height / 720); }
};

/// The network as the polygonal model that the paper starts from: an element a vessel, at each section a ring
/// of eight vertices, and two triangles between neighbours.
std::vector<SourceElement> meshesOf(const Network& network);

/// Rows of the paper's tables: each has `ours` and `paper`, null where the paper has none.
Report storageTable(const PaperStudy& study);
/// Conventional hierarchies against the paper's sphere tree and ours. Runs on one thread.
Result<Report> hierarchyTable(const PaperStudy& study);
Result<Report> frameRateTable(const PaperStudy& study, gpu::Device& device);

/// A figure in the paper's arrangement.
struct PaperFigure {
  struct Panel {
    std::string caption;
    Image picture;
  };
  std::string caption;
  std::vector<Panel> panels;
  Report facts;      ///< numbers that belong to it; may be null
  std::string note;  ///< how it is made, where that is not plain; may be empty
};

using FigureMaker = Result<PaperFigure> (*)(const PaperStudy& study, gpu::Device& device);
Result<PaperFigure> wholeBodyFigure(const PaperStudy& study, gpu::Device& device);   ///< 1
Result<PaperFigure> conversionFigure(const PaperStudy& study, gpu::Device& device);  ///< 2
Result<PaperFigure> brainFigure(const PaperStudy& study, gpu::Device& device);       ///< 3
Result<PaperFigure> junctionFigure(const PaperStudy& study, gpu::Device& device);    ///< 4
Result<PaperFigure> capillaryFigure(const PaperStudy& study, gpu::Device& device);   ///< 5
Result<PaperFigure> hierarchyFigure(const PaperStudy& study, gpu::Device& device);   ///< 6
Result<PaperFigure> clipFigure(const PaperStudy& study, gpu::Device& device);        ///< 7

}  // namespace vasa::cli
