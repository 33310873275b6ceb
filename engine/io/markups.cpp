#include "io/markups.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/text_file.h"
#include "io/foreign_files.h"
#include "io/import_frame.h"
#include "io/radius_array.h"

namespace vasa {
namespace {

using MarkupsJson = nlohmann::json;
constexpr std::size_t kMostMarkupsBytes = 3'000'000;  // parsed it takes up to 41 times as much
constexpr int kDeepestMarkups = 16;

struct BrokenMarkups {
  std::string what;
};

// Deeply nested lists take most memory for their bytes. Looked for beforehand, as the parser's own call-back
// makes it go through all of a list with each of its items.
bool isNestedTooDeeply(std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quoted && text[i] == '\\')
      ++i;
    else if (text[i] == '"')
      quoted = !quoted;
    else if (!quoted && (text[i] == '[' || text[i] == '{') && ++depth > kDeepestMarkups)
      return true;
    else if (!quoted && (text[i] == ']' || text[i] == '}'))
      --depth;
  }
  return false;
}

const MarkupsJson* member(const MarkupsJson& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found == object.end() ? nullptr : &*found;
}

std::string wordAt(const MarkupsJson& object, const char* key) {
  const MarkupsJson* const value = member(object, key);
  return value && value->is_string() ? value->get<std::string>() : std::string();
}

// The elements of an array, none where it is absent.
const MarkupsJson& listOf(const MarkupsJson& object, const char* key) {
  static const MarkupsJson none = MarkupsJson::array();
  const MarkupsJson* const value = member(object, key);
  return value && value->is_array() ? *value : none;
}

// @param unit  of the file's [m]
double lengthAt(const MarkupsJson& value, double unit, const std::string& place) {
  if (!value.is_number()) throw BrokenMarkups{place + " must be a number"};
  if (!(std::abs(value.get<double>()) * unit <= kLargestImportedCoordinate))
    throw BrokenMarkups{place + " is too large; is it in its coordinateUnits?"};
  return value.get<double>();
}

double coordinateUnit(const MarkupsJson& markup, const std::string& place) {
  const std::string told = wordAt(markup, "coordinateUnits");
  const double unit = told.empty() ? 0.001 : metresOfUnit(told);
  if (unit == 0) throw BrokenMarkups{place + "/coordinateUnits is none of m, cm, mm, in and um"};
  return unit;
}

// LPS: +X left, +Y backwards, +Z up. RAS, which older versions call 0: the other way along the first two.
ImportFrame::Up upOf(const MarkupsJson& markup, const std::string& place) {
  const std::string told = wordAt(markup, "coordinateSystem");
  if (told.empty() || told == "LPS" || told == "1") return ImportFrame::Up::z;
  if (told != "RAS" && told != "0") throw BrokenMarkups{place + "/coordinateSystem is neither LPS nor RAS"};
  return ImportFrame::Up::zBackwards;
}

// The radii of all control points [m], in the measurement's own unit, else in that of the places.
std::vector<double> controlRadii(const MarkupsJson& markup, std::size_t count, double unit,
                                 const std::string& place) {
  std::vector<std::string> names;
  std::vector<const MarkupsJson*> told;
  for (const MarkupsJson& measurement : listOf(markup, "measurements"))
    if (listOf(measurement, "controlPointValues").size() == count)
      names.push_back(wordAt(measurement, "name")), told.push_back(&measurement);
  const auto choice = chooseRadius(names);
  if (!choice)
    throw BrokenMarkups{
        place +
        ": the curve's control points have no radii; make it by Extract Centerline (3D Slicer), which "
        "measures them, or save that module's centerline model as .vtp"};
  const MarkupsJson& chosen = *told[choice->array];
  const double own = choice->unit > 0 ? choice->unit : metresOfUnit(wordAt(chosen, "units"));
  std::vector<double> radii;
  for (const MarkupsJson& value : listOf(chosen, "controlPointValues")) {
    const double radius = choice->factor * lengthAt(value, unit, place + "/measurements: a radius");
    if (const std::string fault = radiusFault(radius, 1, radii.size()); !fault.empty())
      throw BrokenMarkups{place + ": " + fault};
    radii.push_back(radius * (own > 0 ? own : unit));
  }
  return radii;
}

void addCurve(Centrelines& lines, const MarkupsJson& markup, const std::string& place, VesselKind kind) {
  const double unit = coordinateUnit(markup, place);
  const ImportFrame frame{unit, upOf(markup, place)};
  const MarkupsJson& points = listOf(markup, "controlPoints");
  if (points.size() < 2) return;
  const std::vector<double> radii = controlRadii(markup, points.size(), unit, place);
  std::vector<vec4> samples;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string at = place + "/controlPoints/" + std::to_string(i);
    const std::string status = wordAt(points[i], "positionStatus");
    if (status == "undefined" || status == "missing") continue;
    const MarkupsJson& position = listOf(points[i], "position");
    if (position.size() != 3) throw BrokenMarkups{at + "/position must be three numbers"};
    dvec3 p;
    for (int k = 0; k < 3; ++k) p[k] = lengthAt(position[std::size_t(k)], unit, at + "/position");
    const vec4 sample(frame.toHouse(p), float(radii[i]));
    if (samples.empty() || vec3(samples.back()) != vec3(sample)) samples.push_back(sample);
  }
  if (samples.size() < 2) return;
  std::vector<std::vector<std::uint32_t>> line(1, std::vector<std::uint32_t>(samples.size()));
  std::iota(line[0].begin(), line[0].end(), 0u);
  if (!mendRadii(line, samples)) throw BrokenMarkups{place + ": all radii are zero"};
  lines.lines.push_back({{}, {}, kind, std::move(samples)});
}

}  // namespace

bool isMarkupsFile(const std::filesystem::path& path) {
  return extensionOf(path) == ".json" && extensionOf(path.stem()) == ".mrk";
}

Result<Centrelines> parseMarkups(std::string_view text, const std::string& name, VesselKind kind) {
  if (text.size() > kMostMarkupsBytes)
    return badInput(
        name + ": holds more than 3 MB; resample the curve with fewer points (3D Slicer: Markups, Resample)");
  try {
    if (isNestedTooDeeply(text)) throw BrokenMarkups{"is nested too deeply"};
    const MarkupsJson json = MarkupsJson::parse(text);
    Centrelines lines;
    std::string others;
    const MarkupsJson& markups = listOf(json, "markups");
    for (std::size_t m = 0; m < markups.size(); ++m)
      if (const std::string type = wordAt(markups[m], "type"); type == "Curve")
        addCurve(lines, markups[m], "/markups/" + std::to_string(m), kind);
      else
        others = type;
    if (lines.lines.empty())
      throw BrokenMarkups{others.empty()
                              ? "holds no curve of two control points or more"
                              : "holds no curve but markups of type " + others.substr(0, 40) +
                                    "; centre lines are those of type Curve (3D Slicer: Extract Centerline)"};
    const std::string stem = std::filesystem::path(name).stem().stem().string();
    for (std::size_t i = 0; i < lines.lines.size(); ++i)
      lines.lines[i].name = lines.lines.size() == 1 ? stem : stem + " " + std::to_string(i + 1);
    return lines;
  } catch (const BrokenMarkups& broken) {
    return badInput(name + ": " + broken.what);
  } catch (const MarkupsJson::exception& error) {
    return badInput(name + ": is not valid JSON: " + error.what());
  }
}

Result<Centrelines> readMarkups(const std::filesystem::path& path, VesselKind kind) {
  const auto text = readText(path, kMostMarkupsBytes + 1);
  if (!text) return text.error();
  return parseMarkups(*text, path.string(), kind);
}

}  // namespace vasa
