#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "atlas/colouring.h"
#include "core/image.h"
#include "plate/label_choice.h"
#include "plate/label_layout.h"
#include "plate/sheet.h"
#include "render/look.h"
#include "scene/frame.h"
#include "surface/sweep_table.h"

namespace vasa::plate {

/// What a page is to have. Lengths in millimetres of paper.
struct PlateStyle {
  vec2 page{210, 297};
  float margin = 10;
  float letters = 2.75f;        ///< em of a label: a little under 8 points
  std::string labels = "main";  ///< LabelWishes::which; empty: none
  bool legend = true, scale = true;
  std::string title, subtitle;  ///< empty: none
  vec3 paper{1};
  /// As wide as they may become; otherwise they narrow where that makes the picture larger.
  bool wideColumns = false;
};

/// [mm] What a picture can take of a page between columns of middling width.
vec2 pictureRoom(const PlateStyle& style);

/// A scene in a pose, as a picture draws it.
struct PlateScene {
  const Scene& scene;
  const FrameMaker& frame;
  const SweepTable& table;
  std::span<const SkinnedMesh> meshes;  ///< those that are drawn
  std::span<const char> vessels;        ///< one a vessel: drawn or not
  std::span<const char> own;            ///< one a vessel: labelled without being asked for, or not
  const Look& look;
};

/// Where a picture's edges cut the body off: from 0 to 1, along the left, right, top and bottom edge.
struct CutEdges {
  std::array<std::vector<float>, 4> along;
  /// What remains of the picture at a place, as shares of its size: less than 1 near a cut.
  /// @param size  of the picture, in any unit
  float remains(vec2 place, vec2 size) const;
};

/// A page before its picture is drawn: where everything goes. Needs no device.
struct PlatePlan {
  Camera camera;
  vec2 pictureAt{0}, pictureSize{0};  ///< [mm] on the page
  std::vector<VesselLabel> labels;
  std::vector<std::vector<std::string>> lines;  ///< of each label
  LabelLayout layout;                           ///< [mm]
  LabelColumns columns;
  std::vector<std::string> unseen;  ///< asked for and not seen
  float millimetresAMetre = 0;      ///< of paper, at the depth of what is looked at
  std::vector<char> seen;           ///< one a vessel: something of it is seen
  CutEdges cut;
};

/// An orthographic camera that looks along `towards` at these places and holds them all, `aspect` being what
/// they take of the picture's plane: width by height.
struct FittedCamera {
  Camera camera;
  float aspect = 1;
};
FittedCamera cameraOnto(std::span<const vec3> places, vec3 towards, vec3 up, std::span<const vec3> drawn);

/// Plans a page for a camera whose picture has this aspect (width by height). Fails as chooseLabels() does,
/// and with usage where the page is too small for its margins.
Result<PlatePlan> planPlate(const PlateScene& scene, const PlateStyle& style, const Typesetter& type,
                            const Camera& camera, float aspect);

/// The page with its picture. @param keys  what colours mean
Sheet plateSheet(const PlatePlan& plan, const PlateStyle& style, const Typesetter& type,
                 std::shared_ptr<const Image> picture, const atlas::ColourLegend& keys);

/// A length of 1, 2 or 5 times a power of ten that takes no more than this of paper, in metres.
float scaleLength(float millimetresAMetre, float mostMillimetres);

/// Lets a picture fade into the paper where its edges cut the body off.
void fadeEdges(Image& picture, const CutEdges& cut, vec3 paper);

}  // namespace vasa::plate
