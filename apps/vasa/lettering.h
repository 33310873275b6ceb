#pragma once
#include <memory>
#include <string_view>

#include "core/image.h"
#include "core/result.h"
#include "math/types.h"

namespace vasa::cli {

/// Text on pictures, in DejaVu Sans, of one size.
class Lettering {
 public:
  enum class Align : std::uint8_t { left, centre, right };

  /// @param size  [pixels] of an em. Fails with io where the font is not there.
  static Result<Lettering> load(float size);
  Lettering(Lettering&&) noexcept;
  ~Lettering();

  /// @param x, y    [pixels] of the text's left end, middle or right end on its base line
  /// @param colour  sRGB
  void write(Image& picture, int x, int y, std::string_view utf8, Align align = Align::left,
             vec3 colour = {0.11f, 0.14f, 0.19f}) const;
  int widthOf(std::string_view utf8) const;

 private:
  struct Face;
  explicit Lettering(std::unique_ptr<Face> face);
  std::unique_ptr<Face> face_;
};

}  // namespace vasa::cli
