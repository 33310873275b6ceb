#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/utf8.h"
#include "io/base64.h"
#include "io/png.h"
#include "plate/sheet.h"

namespace vasa::plate {
namespace {

std::string colourText(vec3 colour) {
  const auto byte = [](float value) { return int(std::lround(255 * glm::clamp(value, 0.0f, 1.0f))); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.x), byte(colour.y), byte(colour.z));
}

// What XML forbids is left out, bytes that are no UTF-8 among it; the five marks are named.
std::string escapedXml(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Utf8Character character = utf8At(text);
    const std::string_view bytes = text.substr(0, std::max<std::size_t>(character.bytes, 1));
    text.remove_prefix(bytes.size());
    if (character.bytes == 0 || character.code == 0xfffe || character.code == 0xffff) continue;
    switch (character.code) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        if (character.code >= 0x20) out += bytes;
    }
  }
  return out;
}

std::string marks(const std::string& kind, const std::string& subject) {
  std::string text;
  if (!kind.empty()) text += fmt::format(R"( class="{}")", escapedXml(kind));
  if (!subject.empty()) text += fmt::format(R"( data-vessel="{}")", escapedXml(subject));
  return text;
}

struct SvgWriter {
  const Typesetter& type;
  std::string text;

  Result<void> operator()(const SheetPicture& picture) {
    const auto png = encodePng(*picture.image, {.compression = 9});
    if (!png) return png.error();
    text += fmt::format(
        R"(<image x="{:.3f}" y="{:.3f}" width="{:.3f}" height="{:.3f}" preserveAspectRatio="none" xlink:href="data:image/png;base64,{}"><title>{}</title></image>)"
        "\n",
        picture.at.x, picture.at.y, picture.size.x, picture.size.y, encodeBase64(*png),
        escapedXml(picture.about));
    return {};
  }
  Result<void> operator()(const SheetLine& line) {
    std::string points;
    for (const vec2& p : line.points)
      points += fmt::format("{}{:.3f},{:.3f}", points.empty() ? "" : " ", p.x, p.y);
    text += fmt::format(R"(<polyline{} points="{}" fill="none" stroke="{}" stroke-width="{:.3f}"/>)"
                        "\n",
                        marks(line.kind, line.subject), points, colourText(line.colour), line.width);
    return {};
  }
  Result<void> operator()(const SheetDisc& disc) {
    text += fmt::format(R"(<circle cx="{:.3f}" cy="{:.3f}" r="{:.3f}" fill="{}"/>)"
                        "\n",
                        disc.centre.x, disc.centre.y, disc.radius, colourText(disc.colour));
    return {};
  }
  Result<void> operator()(const SheetBox& box) {
    text += fmt::format(R"(<rect x="{:.3f}" y="{:.3f}" width="{:.3f}" height="{:.3f}" fill="{}"/>)"
                        "\n",
                        box.low.x, box.low.y, box.high.x - box.low.x, box.high.y - box.low.y,
                        colourText(box.colour));
    return {};
  }
  Result<void> operator()(const SheetText& words) {
    const char* anchor = words.align == Lettering::Align::left     ? "start"
                         : words.align == Lettering::Align::centre ? "middle"
                                                                   : "end";
    text += fmt::format(
        R"(<text{} x="{:.3f}" y="{:.3f}" font-size="{:.3f}"{} text-anchor="{}" textLength="{:.3f}" lengthAdjust="spacingAndGlyphs" fill="{}">{}</text>)"
        "\n",
        marks(words.kind, words.subject), words.at.x, words.at.y, words.size,
        words.bold ? R"( font-weight="bold")" : "", anchor, type.widthOf(words.text, words.size, words.bold),
        colourText(words.colour), escapedXml(words.text));
    return {};
  }
};

}  // namespace

Result<std::string> sheetSvg(const Sheet& sheet, const Typesetter& type) {
  SvgWriter writer{type, fmt::format(
                             R"(<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="{0}mm" height="{1}mm" viewBox="0 0 {0} {1}" font-family="'DejaVu Sans', Verdana, sans-serif">
<title>{2}</title>
<rect width="{0}" height="{1}" fill="{3}"/>
)",
                             sheet.size.x, sheet.size.y, escapedXml(sheet.title), colourText(sheet.paper))};
  for (const SheetItem& item : sheet.items)
    if (auto done = std::visit(writer, item); !done) return done.error();
  return writer.text + "</svg>\n";
}

}  // namespace vasa::plate
