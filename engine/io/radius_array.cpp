#include "io/radius_array.h"

#include <algorithm>

#include "io/words.h"

namespace vasa {
namespace {

constexpr std::size_t kMostListed = 8;  // arrays in a message
constexpr const char* kVmtk = "MaximumInscribedSphereRadius";

// How likely an array tells radii, 0 the likeliest; the last ones tell diameters.
constexpr int kNotAtAll = 5, kDiameters = 3;
int rankOf(std::string_view name) {
  if (name == kVmtk) return 0;
  const std::string lower = lowerCase(name);
  if (lower == "radius" || lower == "radii" || lower == "r") return 1;
  if (lower.ends_with("radius") || lower.ends_with("radii")) return 2;
  if (lower == "diameter" || lower == "diameters") return 3;
  if (lower.ends_with("diameter") || lower.ends_with("diameters")) return 4;
  return kNotAtAll;
}

std::string listed(std::span<const std::string> names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostListed); ++i)
    text += (i > 0 ? ", " : "") + names[i].substr(0, 40);
  return names.size() > kMostListed ? text + " ..." : text;
}

}  // namespace

std::optional<RadiusChoice> chooseRadius(std::span<const std::string> names) {
  const auto best = std::ranges::min_element(names, {}, [](const std::string& name) { return rankOf(name); });
  if (best == names.end() || rankOf(*best) == kNotAtAll) return std::nullopt;
  return RadiusChoice{std::size_t(best - names.begin()), rankOf(*best) >= kDiameters ? 0.5 : 1};
}

std::string radiusRemark(const std::string& array, const RadiusChoice& choice, bool ofLines) {
  if (!ofLines && (array == kVmtk || array == "Radius" || array == "radius")) return {};
  return "radii are those of the array " + array.substr(0, 40) + (choice.factor < 1 ? ", halved" : "") +
         (ofLines ? ", one a line" : "");
}

std::string missingRadius(std::span<const std::string> ofPoints, std::span<const std::string> ofLines) {
  std::string there = listed(ofPoints);
  if (!ofLines.empty()) there += (there.empty() ? "" : "; of lines: ") + listed(ofLines);
  return "has no array of radii" + (there.empty() ? std::string() : " (it has " + there + ")") +
         ": name one " + kVmtk +
         " or Radius, in the unit of the points (vmtkcenterlines writes the former; ParaView's Calculator makes "
         "one)";
}

std::vector<double> radiiOfPoints(std::size_t points, std::span<const std::vector<std::uint32_t>> lines,
                                  std::span<const double> ofLine) {
  std::vector<double> sum(points, 0);
  std::vector<std::uint32_t> count(points, 0);
  for (std::size_t line = 0; line < lines.size(); ++line)
    for (const std::uint32_t point : lines[line]) sum[point] += ofLine[line], ++count[point];
  for (std::size_t p = 0; p < points; ++p)
    if (count[p] > 1) sum[p] /= count[p];
  return sum;
}

std::optional<std::size_t> mendRadii(std::span<const std::vector<std::uint32_t>> lines,
                                     std::span<vec4> points) {
  std::vector<bool> onLine(points.size());
  for (const auto& line : lines)
    for (const std::uint32_t point : line) onLine[point] = true;
  std::vector<std::uint32_t> front;
  double sum = 0;
  std::size_t bare = 0;
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    if (!onLine[p]) continue;
    if (points[p].w > 0)
      front.push_back(p), sum += points[p].w;
    else
      ++bare;
  }
  if (front.empty()) return std::nullopt;
  if (bare == 0) return 0;
  const float mean = float(sum / double(front.size()));
  // Neighbours along lines, those of a point one after the other.
  std::vector<std::uint32_t> first(points.size() + 1, 0);
  for (const auto& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i) ++first[line[i - 1] + 1], ++first[line[i] + 1];
  for (std::size_t p = 1; p < first.size(); ++p) first[p] += first[p - 1];
  std::vector<std::uint32_t> neighbours(first.back()), next(first.begin(), first.end() - 1);
  for (const auto& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i)
      neighbours[next[line[i - 1]]++] = line[i], neighbours[next[line[i]]++] = line[i - 1];
  for (std::size_t i = 0; i < front.size(); ++i)
    for (std::uint32_t n = first[front[i]]; n < first[front[i] + 1]; ++n)
      if (vec4& other = points[neighbours[n]]; !(other.w > 0))
        other.w = points[front[i]].w, front.push_back(neighbours[n]);
  for (std::uint32_t p = 0; p < points.size(); ++p)
    if (onLine[p] && !(points[p].w > 0)) points[p].w = mean;
  return bare;
}

}  // namespace vasa
