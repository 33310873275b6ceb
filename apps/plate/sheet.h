#pragma once
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/image.h"
#include "core/result.h"
#include "math/types.h"
#include "plate/lettering.h"

namespace vasa::plate {

// A page as a list of what lies on it, from the bottom up. Millimetres from the page's upper left corner, y
// down; colours are sRGB in [0, 1].

struct SheetPicture {
  vec2 at{0}, size{0};
  std::shared_ptr<const Image> image;  ///< whole: its alpha does not count
  std::string about;                   ///< in words, for those who do not see it
};
struct SheetLine {
  std::vector<vec2> points;  ///< at least 2
  float width = 0.2f;
  vec3 colour{0};
  std::string kind;     ///< what it is: "leader", "halo", "scale" ...
  std::string subject;  ///< the vessel that it points at; empty: none
};
struct SheetDisc {
  vec2 centre{0};
  float radius = 0.5f;
  vec3 colour{0};
};
struct SheetBox {
  vec2 low{0}, high{0};
  vec3 colour{0};
};
struct SheetText {
  vec2 at{0};  ///< left end, middle or right end on the base line
  Lettering::Align align = Lettering::Align::left;
  float size = 3;  ///< of an em
  bool bold = false;
  vec3 colour{0};
  std::string text;     ///< UTF-8, one line
  std::string kind;     ///< what it is: "label", "title" ...
  std::string subject;  ///< the vessel that it names; empty: none
};
using SheetItem = std::variant<SheetPicture, SheetLine, SheetDisc, SheetBox, SheetText>;

struct Sheet {
  vec2 size{210, 297};
  vec3 paper{1};
  std::string title;
  std::vector<SheetItem> items;
};

/// Widths and pictures of letters, in the two faces that sheets are set in.
class Typesetter {
 public:
  static Result<Typesetter> load();
  /// @param size  of an em; the width is in its unit
  float widthOf(std::string_view utf8, float size, bool bold = false) const;
  /// Breaks at blanks so that no line is wider than `width` where that can be; as few lines as that takes,
  /// and of like length.
  std::vector<std::string> wrap(std::string_view utf8, float size, float width, bool bold = false) const;
  const Lettering& face(bool bold) const { return bold ? bold_ : plain_; }

 private:
  Typesetter(Lettering plain, Lettering bold) : plain_(std::move(plain)), bold_(std::move(bold)) {}
  Lettering plain_, bold_;  // of kMeasure pixels
};

/// The sheet in pixels. Fails with io where the font is not there.
Result<Image> sheetImage(const Sheet& sheet, float dotsPerInch);
/// The same at the resolution that gives it so many columns, and exactly this size.
Result<Image> sheetImage(const Sheet& sheet, uvec2 pixels);

/// The sheet as SVG: pictures as PNG within it, lines and texts as such. Texts are held to the width that
/// they have here, whichever fonts the reader has.
Result<std::string> sheetSvg(const Sheet& sheet, const Typesetter& type);

/// The sheet as one page of PDF 1.5: pictures deflated, lines and texts as such, both faces within it.
Result<std::vector<std::byte>> sheetPdf(const Sheet& sheet, const Typesetter& type);

}  // namespace vasa::plate
