#include <algorithm>
#include <cmath>

#include "make_human/shape.h"

// The sections of the table become equal steps by a monotone-ish cubic (Catmull-Rom with chord parameters),
// so that the outline is smooth along the limb.
namespace vasa::human {
namespace {

constexpr float kSectionStep = 0.003f;

struct Station {
  vec3 centre{0};
  Part::Section section;
  float cap = 0;
};

Part::Section combine(const Part::Section& a, float wa, const Part::Section& b, float wb) {
  return {wa * a.u + wb * b.u,         wa * a.v + wb * b.v,       wa * a.width + wb * b.width,
          wa * a.front + wb * b.front, wa * a.back + wb * b.back, wa * a.square + wb * b.square};
}

/// Cubic Hermite between stations i and i+1 at height h, slopes from the neighbours.
Part::Section interpolate(const std::vector<Station>& stations, const std::vector<float>& heights,
                          std::size_t i, float h) {
  const auto slope = [&](std::size_t k) {
    const std::size_t a = k > 0 ? k - 1 : k, b = std::min(k + 1, heights.size() - 1);
    const float step = heights[b] - heights[a];
    return combine(stations[b].section, 1 / step, stations[a].section, -1 / step);
  };
  const float step = heights[i + 1] - heights[i], t = (h - heights[i]) / step;
  const float t2 = t * t, t3 = t2 * t;
  const Part::Section ends =
      combine(stations[i].section, 2 * t3 - 3 * t2 + 1, stations[i + 1].section, 3 * t2 - 2 * t3);
  const Part::Section slopes = combine(slope(i), step * (t3 - 2 * t2 + t), slope(i + 1), step * (t3 - t2));
  Part::Section result = combine(ends, 1, slopes, 1);
  const auto keep = [](float& value, float a, float b) { value = std::max(value, 0.7f * std::min(a, b)); };
  keep(result.width, stations[i].section.width, stations[i + 1].section.width);
  keep(result.front, stations[i].section.front, stations[i + 1].section.front);
  keep(result.back, stations[i].section.back, stations[i + 1].section.back);
  result.square = std::clamp(result.square, 1.6f, 6.0f);
  return result;
}

Result<void> loft(Part& part, std::vector<Station>& stations, vec3 front) {
  part.origin = stations.front().centre;
  const vec3 span = stations.back().centre - part.origin;
  part.length = glm::length(span);
  part.axis = part.length > 0 ? span / part.length : vec3(0, 1, 0);
  if (std::abs(glm::dot(part.axis, front)) > 0.95f)
    return badInput("part '" + part.name + "': its front points along its axis");
  part.front = glm::normalize(front - glm::dot(front, part.axis) * part.axis);
  part.side = glm::cross(part.axis, part.front);
  part.capStart = stations.front().cap;
  part.capEnd = stations.back().cap;
  std::vector<float> heights;
  for (Station& station : stations) {
    const vec3 q = station.centre - part.origin;
    heights.push_back(glm::dot(q, part.axis));
    station.section.u = glm::dot(q, part.side);
    station.section.v = glm::dot(q, part.front);
    if (heights.size() > 1 && heights.back() <= heights[heights.size() - 2])
      return badInput("part '" + part.name + "': its sections do not follow one another along its axis");
  }
  if (stations.size() == 1) {
    part.sections = {stations[0].section};
  } else {
    const int steps = std::max(int(std::ceil(part.length / kSectionStep)), int(stations.size()));
    std::size_t i = 0;
    for (int k = 0; k <= steps; ++k) {
      const float h = part.length * float(k) / float(steps);
      while (i + 2 < heights.size() && h > heights[i + 1]) ++i;
      part.sections.push_back(interpolate(stations, heights, i, h));
    }
  }
  return {};
}

void findBounds(Part& part) {
  for (std::size_t i = 0; i < part.sections.size(); ++i) {
    const Part::Section& s = part.sections[i];
    const float h =
        part.sections.size() > 1 ? part.length * float(i) / float(part.sections.size() - 1) : 0.0f;
    const vec3 centre = part.origin + h * part.axis + s.u * part.side + s.v * part.front;
    for (int corner = 0; corner < 8; ++corner)
      part.bounds.add(centre + (corner & 1 ? s.width : -s.width) * part.side +
                      (corner & 2 ? s.front : -s.back) * part.front +
                      (corner & 4 ? part.capEnd : -part.capStart) * part.axis);
  }
}

std::vector<int> jointPath(Table& table, std::size_t row, const Rig& rig, Side side) {
  std::vector<int> path;
  for (std::string_view name : split(table.text(row, "path"), ' ')) {
    if (name.empty()) continue;
    const int joint = rig.find(side == Side::right ? mirroredName(name) : std::string(name));
    if (joint < 0)
      table.fault(row, "no joint " + quoted(name));
    else
      path.push_back(joint);
  }
  if (path.empty()) table.fault(row, "no joint moves this part");
  return path;
}

vec3 frontOf(Table& table, std::size_t row, Side side) {
  const std::string_view text = table.text(row, "front");
  if (text == "front") return {0, 0, 1};
  if (text == "up") return {0, 1, 0};
  const vec3 given = table.take(row, parseVector(text));
  return side == Side::right ? mirrored(given) : given;
}

std::vector<Station> stationsOf(Table& table, std::string_view part, const Rig& rig, Side side) {
  std::vector<Station> stations;
  for (std::size_t r = 0; r < table.rowCount(); ++r) {
    if (table.text(r, "part") != part) continue;
    Station station;
    station.centre = table.take(r, rig.place(table.text(r, "place"), side));
    station.section.width = table.millimetres(r, "half_width_mm");
    station.section.front = table.millimetres(r, "half_front_mm");
    station.section.back = table.millimetres(r, "half_back_mm");
    station.section.square = table.numberOr(r, "square", 2);
    const Part::Section& s = station.section;
    station.cap = 1e-3f * table.numberOr(r, "cap_mm", 1e3f * std::min(s.width, 0.5f * (s.front + s.back)));
    if (s.width <= 0 || s.front <= 0 || s.back <= 0 || station.cap <= 0)
      table.fault(r, "sizes must be positive");
    stations.push_back(station);
  }
  return stations;
}

}  // namespace

Result<Shape> readShape(const std::filesystem::path& partsPath, const std::filesystem::path& sectionsPath,
                        std::string_view mesh, const Rig& rig) {
  Result<Table> parts = Table::read(partsPath);
  if (!parts.ok()) return parts.error();
  Result<Table> sections = Table::read(sectionsPath);
  if (!sections.ok()) return sections.error();
  Shape shape;
  for (std::size_t r = 0; r < parts->rowCount(); ++r) {
    if (parts->text(r, "mesh") != mesh) continue;
    for (Side side : sidesOf(parts->text(r, "side"))) {
      Part part;
      part.name = parts->text(r, "part");
      part.carve = parts->text(r, "operation") == "carve";
      part.blend = parts->millimetres(r, "blend_mm");
      part.cell = parts->millimetres(r, "cell_mm");
      part.path = jointPath(*parts, r, rig, side);
      std::vector<Station> stations = stationsOf(*sections, part.name, rig, side);
      if (!parts->state().ok()) return parts->state().error();
      if (!sections->state().ok()) return sections->state().error();
      if (stations.empty()) return badInput("part '" + part.name + "' has no sections");
      const vec3 front = frontOf(*parts, r, side);
      if (const Result<void> lofted = loft(part, stations, front); !lofted.ok()) return lofted.error();
      findBounds(part);
      shape.parts.push_back(std::move(part));
    }
  }
  return shape;
}

}  // namespace vasa::human
