#include "plate/lettering.h"

#include <ft2build.h>

#include <cmath>
#include FT_FREETYPE_H

#include "viewer/font.h"

namespace vasa::plate {
namespace {

constexpr int kSubpixels = 64;  // FreeType counts in these

int loadFlags(Lettering::Style style) { return style.hinted ? FT_LOAD_DEFAULT : FT_LOAD_NO_HINTING; }

// Beside the plain face, as Debian has them.
std::string fileOf(Lettering::Style style) {
  std::string file = kFontFile;
  if (style.bold) file.insert(file.rfind('.'), "-Bold");
  return file;
}

}  // namespace

std::u32string codePoints(std::string_view text) {
  std::u32string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const int more = lead < 0x80 ? 0 : lead >> 5 == 6 ? 1 : lead >> 4 == 14 ? 2 : lead >> 3 == 30 ? 3 : -1;
    if (more < 0 || i + std::size_t(more) >= text.size()) {
      out += U'?', ++i;
      continue;
    }
    char32_t code = more == 0 ? lead : lead & (0x3f >> more);
    for (int k = 1; k <= more; ++k) code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3f);
    out += code;
    i += std::size_t(more) + 1;
  }
  return out;
}

struct Lettering::Face {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  Face() = default;
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;
  ~Face() {
    if (face) FT_Done_Face(face);
    if (library) FT_Done_FreeType(library);
  }
};

Lettering::Lettering(std::unique_ptr<Face> face, std::string file, Style style)
    : face_(std::move(face)), file_(std::move(file)), style_(style) {}
Lettering::Lettering(Lettering&&) noexcept = default;
Lettering::~Lettering() = default;

Result<Lettering> Lettering::load(float size, Style style) {
  auto face = std::make_unique<Face>();
  std::string file = fileOf(style);
  if (FT_Init_FreeType(&face->library) != 0 ||
      FT_New_Face(face->library, file.c_str(), 0, &face->face) != 0 ||
      FT_Set_Char_Size(face->face, 0, FT_F26Dot6(std::lround(size * kSubpixels)), 72, 72) != 0)
    return ioError(file + ": cannot be read; install Debian's fonts-dejavu-core");
  return Lettering(std::move(face), std::move(file), style);
}

Lettering::Glyph Lettering::glyphOf(char32_t code) const {
  const FT_UInt number = FT_Get_Char_Index(face_->face, code);
  if (FT_Load_Glyph(face_->face, number, loadFlags(style_)) != 0) return {};
  return {number, float(face_->face->glyph->advance.x) / kSubpixels};
}

int Lettering::widthOf(std::string_view utf8) const {
  FT_Pos width = 0;
  for (const char32_t code : codePoints(utf8))
    if (FT_Load_Char(face_->face, code, loadFlags(style_)) == 0) width += face_->face->glyph->advance.x;
  return int(width / kSubpixels);
}

void Lettering::write(Image& picture, int x, int y, std::string_view utf8, Align align, vec3 colour) const {
  FT_Pos pen = FT_Pos(x) * kSubpixels;
  if (align != Align::left) pen -= FT_Pos(widthOf(utf8)) * kSubpixels / (align == Align::centre ? 2 : 1);
  for (const char32_t code : codePoints(utf8)) {
    if (FT_Load_Char(face_->face, code, FT_LOAD_RENDER | loadFlags(style_)) != 0) continue;
    const FT_GlyphSlot glyph = face_->face->glyph;
    const int left = int(pen / kSubpixels) + glyph->bitmap_left, top = y - glyph->bitmap_top;
    for (int row = 0; row < int(glyph->bitmap.rows); ++row)
      for (int column = 0; column < int(glyph->bitmap.width); ++column) {
        const int px = left + column, py = top + row;
        if (px < 0 || py < 0 || px >= int(picture.width) || py >= int(picture.height)) continue;
        const float cover = float(glyph->bitmap.buffer[row * glyph->bitmap.pitch + column]) / 255;
        std::uint8_t* pixel = &picture.rgba[4 * (std::size_t(py) * picture.width + std::size_t(px))];
        for (int c = 0; c < 3; ++c)
          pixel[c] = std::uint8_t(std::lround(glm::mix(float(pixel[c]), 255 * colour[c], cover)));
      }
    pen += glyph->advance.x;
  }
}

}  // namespace vasa::plate
