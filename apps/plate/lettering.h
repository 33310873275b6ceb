#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "core/image.h"
#include "core/result.h"
#include "math/types.h"

namespace vasa::plate {

/// Text on pictures, in DejaVu Sans, of one size.
class Lettering {
 public:
  enum class Align : std::uint8_t { left, centre, right };
  struct Style {
    bool bold = false;
    /// Stems on whole pixels, for small letters on a screen. Without, letters keep their proportions: a text
    /// is as wide as at any other size.
    bool hinted = true;
  };

  /// @param size  [pixels] of an em. Fails with io where the font is not there.
  static Result<Lettering> load(float size, Style style);
  static Result<Lettering> load(float size) { return load(size, {}); }
  Lettering(Lettering&&) noexcept;
  ~Lettering();

  /// @param x, y    [pixels] of the text's left end, middle or right end on its base line
  /// @param colour  sRGB
  void write(Image& picture, int x, int y, std::string_view utf8, Align align = Align::left,
             vec3 colour = {0.11f, 0.14f, 0.19f}) const;
  int widthOf(std::string_view utf8) const;

  /// The font's number of a letter, 0 where it has none, and how far on the next one stands [pixels].
  struct Glyph {
    std::uint32_t number = 0;
    float advance = 0;
  };
  Glyph glyphOf(char32_t code) const;
  const std::string& file() const { return file_; }

 private:
  struct Face;
  Lettering(std::unique_ptr<Face> face, std::string file, Style style);
  std::unique_ptr<Face> face_;
  std::string file_;
  Style style_;
};

/// The code points of valid UTF-8; a broken byte is a question mark.
std::u32string codePoints(std::string_view utf8);

}  // namespace vasa::plate
