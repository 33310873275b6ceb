#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plate/plate.h"
#include "plate/plate_measures.h"

// A planned page with its picture, as what lies on it.
namespace vasa::plate {
namespace {

constexpr float kTitle = 2.3f, kSubtitle = 1.27f;  // ems of theirs, in a label's
constexpr float kScaleMost = 0.2f;                 // of the page's width

vec3 inkOn(vec3 paper) {
  return glm::dot(paper, vec3(0.3f, 0.6f, 0.1f)) > 0.5f ? vec3(0.11f, 0.13f, 0.16f)
                                                        : vec3(0.90f, 0.92f, 0.94f);
}

std::string lengthText(float metres) {
  if (metres >= 1) return fmt::format("{:g} m", metres);
  if (metres >= 0.01f) return fmt::format("{:g} cm", std::round(metres * 1e4f) / 100);
  return fmt::format("{:g} mm", std::round(metres * 1e5f) / 100);
}

void drawLabels(Sheet& sheet, const PlatePlan& plan, const PlateStyle& style) {
  const vec3 ink = inkOn(style.paper);
  const float lineHeight = kLine * style.letters;
  std::vector<SheetItem> halos, leaders, dots, texts;
  for (const PlacedLabel& placed : plan.layout.placed) {
    const VesselLabel& label = plan.labels[placed.label];
    const float out = placed.right ? 1.0f : -1.0f;
    const std::vector<vec2> line{placed.port + vec2(out * kStub, 0), placed.port, placed.anchor};
    // A rim of paper keeps a line visible over what it crosses.
    halos.push_back(SheetLine{{placed.port, placed.anchor}, 0.55f, style.paper, "halo", {}});
    leaders.push_back(SheetLine{line, 0.18f, ink, "leader", label.text});
    dots.push_back(SheetDisc{placed.anchor, 0.62f, style.paper});
    dots.push_back(SheetDisc{placed.anchor, 0.42f, ink});
    const auto& lines = plan.lines[placed.label];
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const float middle = placed.port.y + (float(k) - 0.5f * float(lines.size() - 1)) * lineHeight;
      texts.push_back(
          SheetText{.at = {placed.port.x + out * (kStub + kTextGap), middle + 0.36f * style.letters},
                    .align = placed.right ? Lettering::Align::left : Lettering::Align::right,
                    .size = style.letters,
                    .colour = ink,
                    .text = lines[k],
                    .kind = "label",
                    .subject = label.text});
    }
  }
  for (auto* layer : {&halos, &leaders, &dots, &texts})
    sheet.items.insert(sheet.items.end(), layer->begin(), layer->end());
}

// Keys from the left, each a swatch and a text; of a scale a bar with marks.
void drawKeys(Sheet& sheet, const atlas::ColourLegend& keys, const PlateStyle& style, const Typesetter& type,
              float left, float base) {
  const vec3 ink = inkOn(style.paper);
  const float size = style.letters;
  const auto write = [&](float x, float y, const std::string& text, Lettering::Align align) {
    sheet.items.push_back(
        SheetText{.at = {x, y}, .align = align, .size = size, .colour = ink, .text = text, .kind = "key"});
  };
  if (keys.ramp.empty()) {
    for (const atlas::ColourKey& key : keys.keys) {
      sheet.items.push_back(
          SheetBox{{left, base - 0.72f * size}, {left + 2 * size, base + 0.02f * size}, key.colour});
      write(left + 2.6f * size, base, key.text, Lettering::Align::left);
      left += 2.6f * size + type.widthOf(key.text, size) + 2 * size;
    }
    return;
  }
  constexpr float kBar = 44;
  constexpr std::uint32_t kPieces = 256;
  write(left, base, keys.title, Lettering::Align::left);
  left += type.widthOf(keys.title, size) + size + 0.5f * type.widthOf(keys.keys.front().text, size);
  auto bar = std::make_shared<Image>(Image{kPieces, 1, std::vector<std::uint8_t>(4 * kPieces, 255)});
  for (std::uint32_t piece = 0; piece < kPieces; ++piece) {
    const vec3 colour = keys.at((float(piece) + 0.5f) / kPieces);
    for (int c = 0; c < 3; ++c)
      bar->rgba[4 * piece + std::uint32_t(c)] = std::uint8_t(std::lround(255 * colour[c]));
  }
  sheet.items.push_back(
      SheetPicture{{left, base - 0.72f * size}, {kBar, 0.74f * size}, bar, "Scale: " + keys.title});
  for (std::size_t k = 0; k < keys.keys.size(); ++k)
    write(left + kBar * float(k) / float(keys.keys.size() - 1), base + 1.15f * size, keys.keys[k].text,
          Lettering::Align::centre);
}

void drawScale(Sheet& sheet, const PlatePlan& plan, const PlateStyle& style, float right, float base) {
  const vec3 ink = inkOn(style.paper);
  const float length =
      scaleLength(plan.millimetresAMetre, std::clamp(kScaleMost * style.page.x, 10.0f, 60.0f));
  const float width = length * plan.millimetresAMetre, left = right - width, y = base - 0.1f * style.letters;
  for (const std::vector<vec2>& points : {std::vector<vec2>{{left, y}, {right, y}},
                                          {{left, y - 1}, {left, y + 1}},
                                          {{right, y - 1}, {right, y + 1}}})
    sheet.items.push_back(SheetLine{points, 0.3f, ink, "scale", {}});
  std::string text = lengthText(length);
  if (plan.camera.orthographicHeight <= 0) text += " at the focus";
  sheet.items.push_back(SheetText{.at = {right, y - 2},
                                  .align = Lettering::Align::right,
                                  .size = style.letters,
                                  .colour = ink,
                                  .text = text,
                                  .kind = "scale"});
}

}  // namespace

float scaleLength(float millimetresAMetre, float mostMillimetres) {
  const float most = mostMillimetres / millimetresAMetre;
  const float ten = std::pow(10.0f, std::floor(std::log10(most)));
  for (const float times : {5.0f, 2.0f})
    if (times * ten <= most) return times * ten;
  return ten;
}

Sheet plateSheet(const PlatePlan& plan, const PlateStyle& style, const Typesetter& type,
                 std::shared_ptr<const Image> picture, const atlas::ColourLegend& keys) {
  Sheet sheet{.size = style.page, .paper = style.paper, .title = style.title, .items = {}};
  const vec3 ink = inkOn(style.paper), grey = glm::mix(ink, style.paper, 0.35f);
  sheet.items.push_back(SheetPicture{plan.pictureAt, plan.pictureSize, std::move(picture), style.title});
  drawLabels(sheet, plan, style);
  float y = style.margin;
  if (!style.title.empty()) {
    y += kTitleStep * style.letters;
    // One that is wider than the page gets smaller letters.
    float size = kTitle * style.letters;
    const float room = style.page.x - 2 * style.margin;
    size *= room / std::max(type.widthOf(style.title, size, true), room);
    sheet.items.push_back(SheetText{.at = {style.margin, y},
                                    .size = size,
                                    .bold = true,
                                    .colour = ink,
                                    .text = style.title,
                                    .kind = "title"});
  }
  if (!style.subtitle.empty())
    sheet.items.push_back(SheetText{.at = {style.margin, y + kTitleStep * style.letters},
                                    .size = kSubtitle * style.letters,
                                    .colour = grey,
                                    .text = style.subtitle,
                                    .kind = "subtitle"});
  const float base = style.page.y - style.margin - 4;
  if (style.legend) drawKeys(sheet, keys, style, type, style.margin, base);
  if (style.scale) drawScale(sheet, plan, style, style.page.x - style.margin, base);
  return sheet;
}

}  // namespace vasa::plate
