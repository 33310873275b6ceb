#include "plate/profile_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "plate/chart_paper.h"
#include "plate/lettering.h"

namespace vasa::plate {
namespace {

constexpr float kLetters = 15;  // [pixels]
constexpr int kWidth = 900, kHeight = 656, kLeft = 84, kRight = 28, kTop = 82, kBetween = 46, kBelow = 66;
constexpr vec3 kCurveLine{0.70f, 0.13f, 0.13f}, kFilled{0.97f, 0.87f, 0.86f}, kGrid{0.88f, 0.89f, 0.91f};

// 1, 2 or 5 times a power of ten, so that a range has four to ten of them.
float tickOf(float range) {
  const float power = std::pow(10.0f, std::floor(std::log10(range / 4)));
  const float share = range / 4 / power;
  return power * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
}

struct Curve {
  std::string name;
  std::vector<float> values;
};

// Linear between stations.
float valueAt(std::span<const ProfileStation> stations, std::span<const float> values, float along) {
  const auto next = std::ranges::upper_bound(stations, along, {}, &ProfileStation::along);
  if (next == stations.end()) return values.back();
  if (next == stations.begin()) return values.front();
  const std::size_t k = std::size_t(next - stations.begin());
  const float share = (along - stations[k - 1].along) / (stations[k].along - stations[k - 1].along);
  return glm::mix(values[k - 1], values[k], share);
}

void drawCurve(Image& picture, const Lettering& letters, std::span<const ProfileStation> stations,
               const Curve& curve, int top, int bottom) {
  const float length = stations.back().along;
  const float highest = std::max(*std::ranges::max_element(curve.values), 1e-6f), tick = tickOf(highest);
  const float most = tick * std::ceil(1.02f * highest / tick);
  const int right = kWidth - kRight;
  const auto y = [&](float value) { return bottom - int(std::lround(float(bottom - top) * value / most)); };
  for (float mark = 0; mark <= 1.001f * most; mark += tick) {
    fill(picture, kLeft, y(mark), right, y(mark) + 1, kGrid);
    letters.write(picture, kLeft - 10, y(mark) + 5, fmt::format("{:.4g}", double(mark)),
                  Lettering::Align::right);
  }
  int before = -1;
  for (int x = kLeft; x < right; ++x) {
    const float along = length * float(x - kLeft) / float(right - 1 - kLeft);
    const int here = y(valueAt(stations, curve.values, along));
    fill(picture, x, here, x + 1, bottom, kFilled);
    const int from = before < 0 ? here : before;
    fill(picture, x, std::min(from, here) - 1, x + 1, std::max(from, here) + 1, kCurveLine);
    before = here;
  }
  letters.write(picture, kLeft, top - 12, curve.name);
}

}  // namespace

Result<Image> drawProfile(const std::string& title, std::span<const ProfileStation> stations) {
  const auto letters = Lettering::load(kLetters), large = Lettering::load(1.3f * kLetters);
  if (!letters) return letters.error();
  if (!large) return large.error();
  Image picture = blank(kWidth, kHeight);
  large->write(picture, kLeft, 32, title);
  Curve radius{"radius [mm]", {}}, area{"area of the lumen [mm²]", {}};
  for (const ProfileStation& station : stations) {
    radius.values.push_back(1e3f * station.radius);
    area.values.push_back(1e6f * station.area());
  }
  const int each = (kHeight - kTop - kBetween - kBelow) / 2, bottom = kHeight - kBelow;
  drawCurve(picture, *letters, stations, radius, kTop, kTop + each);
  drawCurve(picture, *letters, stations, area, bottom - each, bottom);
  const float length = std::max(1e3f * stations.back().along, 1e-3f), tick = tickOf(length);
  for (float mark = 0; mark <= 1.001f * length; mark += tick)
    letters->write(picture, kLeft + int(std::lround(float(kWidth - kRight - 1 - kLeft) * mark / length)),
                   bottom + 21, fmt::format("{:.4g}", double(mark)), Lettering::Align::centre);
  letters->write(picture, (kLeft + kWidth - kRight) / 2, bottom + 46, "along the way [mm]",
                 Lettering::Align::centre);
  return picture;
}

std::string profileCsv(std::span<const ProfileStation> stations) {
  std::string text = "along_mm,share,x_mm,y_mm,z_mm,radius_mm,area_mm2,curvature_per_mm\n";
  for (const ProfileStation& station : stations)
    text += fmt::format(
        "{:.3f},{:.5f},{:.3f},{:.3f},{:.3f},{:.4f},{:.4f},{:.6f}\n", 1e3 * double(station.along),
        double(station.along) / std::max(double(stations.back().along), 1e-12),
        1e3 * double(station.centre.x), 1e3 * double(station.centre.y), 1e3 * double(station.centre.z),
        1e3 * double(station.radius), 1e6 * double(station.area()), 1e-3 * double(station.curvature));
  return text;
}

}  // namespace vasa::plate
