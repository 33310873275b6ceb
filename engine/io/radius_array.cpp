#include "io/radius_array.h"

#include <algorithm>
#include <array>

#include "core/name_words.h"
#include "io/import_frame.h"
#include "io/words.h"

namespace vasa {
namespace {

constexpr std::size_t kMostListed = 8;  // arrays in a message
constexpr const char* kVmtk = "MaximumInscribedSphereRadius";

// How likely an array tells radii, 0 the likeliest.
constexpr int kNotAtAll = 100;
struct Meaning {
  int rank = kNotAtAll;
  RadiusChoice choice;
};
// Halves of what is measured across, in the languages that write Latin letters.
constexpr std::array<std::string_view, 8> kRadius{"radius", "radii",  "rayon",      "rayons",
                                                  "radio",  "raggio", "halbmesser", "misr"};
constexpr std::array<std::string_view, 6> kDiameter{"diameter", "diameters",   "diametre",
                                                    "diametro", "durchmesser", "diam"};
// What has a radius too, or bends.
constexpr std::array<std::string_view, 3> kOther{"curv", "bend", "torsion"};
// How sure radii are.
constexpr std::array<std::string_view, 6> kSpread{"std", "dev", "sd", "sigma", "error", "variance"};

Meaning meaningOf(std::string_view name) {
  if (name == kVmtk) return {0, {}};
  std::vector<std::string> words = nameWords(name);
  RadiusChoice choice;
  // The last word may be a unit where others stand before it; m and in only in brackets, as they mean other
  // things (mean, inner).
  if (const double unit = words.size() > 1 ? metresOfUnit(words.back()) : 0; unit > 0) {
    const bool bracketed = name.find_first_of("([") != name.npos;
    if (bracketed || (words.back() != "m" && words.back() != "in")) choice.unit = unit, words.pop_back();
  }
  if (words.empty()) return {};
  const std::string& last = words.back();
  const auto ends = [&](std::string_view word) { return last.ends_with(word); };
  const bool diameter = std::ranges::any_of(kDiameter, ends);
  if (!diameter && !std::ranges::any_of(kRadius, ends) && (words.size() > 1 || last != "r")) return {};
  if (diameter) choice.factor = 0.5;
  bool least = false;
  for (const std::string& word : words) {
    const auto has = [&](std::string_view part) { return word.find(part) != word.npos; };
    if (std::ranges::any_of(kOther, has)) return {};
    if (std::ranges::any_of(kSpread, [&](std::string_view spread) { return word.starts_with(spread); }))
      return {};
    least |= word.starts_with("min");
  }
  const auto same = [&](std::string_view word) { return last == word; };
  const bool alone = words.size() == 1 && (last == "r" || std::ranges::any_of(kRadius, same) ||
                                           std::ranges::any_of(kDiameter, same));
  return {1 + 2 * (alone ? 0 : least ? 2 : 1) + diameter, choice};
}

std::string listed(std::span<const std::string> names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostListed); ++i)
    text += (i > 0 ? ", " : "") + names[i].substr(0, 40);
  return names.size() > kMostListed ? text + " ..." : text;
}

}  // namespace

std::optional<RadiusChoice> chooseRadius(std::span<const std::string> names) {
  Meaning best;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const Meaning meaning = meaningOf(names[i]); meaning.rank < best.rank)
      best = meaning, best.choice.array = i;
  if (best.rank == kNotAtAll) return std::nullopt;
  return best.choice;
}

std::string radiusRemark(const std::string& array, const RadiusChoice& choice, bool ofLines) {
  if (!ofLines && (array == kVmtk || array == "Radius" || array == "radius")) return {};
  return "radii are those of the array " + array.substr(0, 40) + (choice.factor < 1 ? ", halved" : "") +
         (choice.unit > 0 ? ", in the unit of its name" : "") + (ofLines ? ", one a line" : "");
}

std::string radiusFault(double radius, double metresPerUnit, std::size_t point) {
  const std::string which = "radius " + numberText(radius) + " of point " + std::to_string(point);
  if (!(radius >= 0))
    return which +
           " must be positive; mend it, or write 0 and it takes that of the nearest point of its line";
  if (radius * metresPerUnit > kLargestImportedCoordinate)
    return which + " is more than 1000 km; give the file's unit with vasa convert --unit";
  return {};
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
