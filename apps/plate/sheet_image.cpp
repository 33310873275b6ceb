#include <algorithm>
#include <cmath>
#include <map>

#include "plate/sheet.h"

namespace vasa::plate {
namespace {

constexpr float kInch = 25.4f;  // [mm]

// How much of a pixel a shape covers, from the distance of the pixel's middle to the shape's edge.
float cover(float inside) { return std::clamp(inside + 0.5f, 0.0f, 1.0f); }

class Painter {
 public:
  Painter(const Sheet& sheet, uvec2 size, float scale) : scale_(scale) {
    image_.width = size.x;
    image_.height = size.y;
    image_.rgba.assign(std::size_t(image_.width) * image_.height * 4, 255);
    for (std::uint32_t y = 0; y < image_.height; ++y)
      for (std::uint32_t x = 0; x < image_.width; ++x) mix(int(x), int(y), sheet.paper, 1);
  }

  Result<void> paint(const SheetItem& item) {
    return std::visit([this](const auto& what) { return draw(what); }, item);
  }
  Image take() { return std::move(image_); }

 private:
  void mix(int x, int y, vec3 colour, float share) {
    if (x < 0 || y < 0 || x >= int(image_.width) || y >= int(image_.height) || share <= 0) return;
    std::uint8_t* pixel = &image_.rgba[4 * (std::size_t(y) * image_.width + std::size_t(x))];
    for (int c = 0; c < 3; ++c)
      pixel[c] = std::uint8_t(std::lround(glm::mix(float(pixel[c]), 255 * colour[c], share)));
  }

  // Calls of(middle of a pixel) for those of a box and takes what it covers.
  template <class CoverOf>
  void cover(vec2 low, vec2 high, vec3 colour, const CoverOf& of) {
    for (int y = int(std::floor(low.y)) - 1; y <= int(std::ceil(high.y)); ++y)
      for (int x = int(std::floor(low.x)) - 1; x <= int(std::ceil(high.x)); ++x)
        mix(x, y, colour, of(vec2(float(x) + 0.5f, float(y) + 0.5f)));
  }

  Result<void> draw(const SheetPicture& picture) {
    const Image& from = *picture.image;
    // A picture that was drawn for this resolution keeps its pixels, wherever roundings end.
    const auto extent = [](float millimetres, std::uint32_t own, float scale) {
      const int wanted = int(std::lround(millimetres * scale));
      return std::abs(wanted - int(own)) <= 1 ? int(own) : wanted;
    };
    const int left = int(std::lround(picture.at.x * scale_)), top = int(std::lround(picture.at.y * scale_));
    const int right = left + extent(picture.size.x, from.width, scale_);
    const int bottom = top + extent(picture.size.y, from.height, scale_);
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) {
        const auto fx = std::min<std::size_t>(
            std::size_t(x - left) * from.width / std::size_t(std::max(1, right - left)), from.width - 1);
        const auto fy = std::min<std::size_t>(
            std::size_t(y - top) * from.height / std::size_t(std::max(1, bottom - top)), from.height - 1);
        const std::uint8_t* pixel = &from.rgba[4 * (fy * from.width + fx)];
        mix(x, y, vec3(pixel[0], pixel[1], pixel[2]) / 255.0f, 1);
      }
    return {};
  }

  Result<void> draw(const SheetLine& line) {
    const float half = std::max(0.5f, 0.5f * line.width * scale_);  // no thinner than a pixel
    vec2 low(1e9f), high(-1e9f);
    for (const vec2& p : line.points)
      low = glm::min(low, p * scale_ - half), high = glm::max(high, p * scale_ + half);
    cover(low, high, line.colour, [&](vec2 at) {
      float nearest = 1e9f;
      for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
        const vec2 a = line.points[i] * scale_, way = line.points[i + 1] * scale_ - a;
        const float square = glm::dot(way, way);
        const float t = square > 0 ? std::clamp(glm::dot(at - a, way) / square, 0.0f, 1.0f) : 0;
        nearest = std::min(nearest, glm::distance(at, a + t * way));
      }
      return plate::cover(half - nearest);
    });
    return {};
  }

  Result<void> draw(const SheetDisc& disc) {
    const vec2 centre = disc.centre * scale_;
    const float radius = disc.radius * scale_;
    cover(centre - radius, centre + radius, disc.colour,
          [&](vec2 at) { return plate::cover(radius - glm::distance(at, centre)); });
    return {};
  }

  Result<void> draw(const SheetBox& box) {
    const vec2 low = box.low * scale_, high = box.high * scale_;
    cover(low, high, box.colour, [&](vec2 at) {
      return plate::cover(std::min(at.x - low.x, high.x - at.x)) *
             plate::cover(std::min(at.y - low.y, high.y - at.y));
    });
    return {};
  }

  Result<void> draw(const SheetText& text) {
    const auto key = std::pair(text.size, text.bold);
    if (!faces_.contains(key)) {
      auto face = Lettering::load(text.size * scale_, {.bold = text.bold, .hinted = false});
      if (!face) return face.error();
      faces_.emplace(key, std::move(*face));
    }
    faces_.at(key).write(image_, int(std::lround(text.at.x * scale_)), int(std::lround(text.at.y * scale_)),
                         text.text, text.align, text.colour);
    return {};
  }

  float scale_;  // pixels a millimetre
  Image image_;
  std::map<std::pair<float, bool>, Lettering> faces_;
};

}  // namespace

namespace {

Result<Image> painted(const Sheet& sheet, uvec2 size, float scale) {
  Painter painter(sheet, size, scale);
  for (const SheetItem& item : sheet.items)
    if (auto done = painter.paint(item); !done) return done.error();
  return painter.take();
}

}  // namespace

Result<Image> sheetImage(const Sheet& sheet, float dotsPerInch) {
  const float scale = dotsPerInch / kInch;
  return painted(sheet, uvec2(glm::max(glm::round(sheet.size * scale), vec2(1))), scale);
}

Result<Image> sheetImage(const Sheet& sheet, uvec2 pixels) {
  return painted(sheet, pixels, float(pixels.x) / sheet.size.x);
}

}  // namespace vasa::plate
