#include "make_human/rig.h"

namespace vasa::human {
namespace {

bool onLeft(std::string_view name) { return mirroredName(name) != name; }

struct PendingRow {
  RigPoint point;
  std::string parent, towards;
};

std::vector<PendingRow> readRows(Table& table) {
  std::vector<PendingRow> rows;
  for (std::size_t r = 0; r < table.rowCount(); ++r) {
    PendingRow row;
    row.point.name = table.text(r, "name");
    row.point.landmark = table.text(r, "kind") == "point";
    row.point.position = {table.millimetres(r, "x_mm"), table.millimetres(r, "y_mm"),
                          table.millimetres(r, "z_mm")};
    row.parent = table.text(r, "parent");
    if (!row.point.landmark) {
      row.towards = table.text(r, "towards");
      row.point.bendTowards = table.take(r, parseVector(table.text(r, "bend_towards")));
      row.point.skinBlend = table.millimetres(r, "skin_blend_mm");
    }
    rows.push_back(row);
  }
  return rows;
}

void addMirrored(std::vector<PendingRow>& rows) {
  const std::vector<PendingRow> left = rows;
  for (PendingRow row : left) {
    if (!onLeft(row.point.name)) continue;
    row.point.name = mirroredName(row.point.name);
    row.point.right = true;
    row.point.position = mirrored(row.point.position);
    row.point.bendTowards = mirrored(row.point.bendTowards);
    row.parent = mirroredName(row.parent);
    row.towards = mirroredName(row.towards);
    rows.push_back(row);
  }
}

}  // namespace

std::string mirroredName(std::string_view name) {
  const bool isShort = name.size() > 1 && name[0] == 'L' && name[1] >= 'A' && name[1] <= 'Z';
  std::string result(isShort ? "R" : name.starts_with("Left") ? "Right" : "");
  return result.append(name.substr(isShort ? 1 : result.empty() ? 0 : 4));
}

std::vector<Side> sidesOf(std::string_view cell) {
  if (cell == "LR") return {Side::left, Side::right};
  if (cell == "L") return {Side::left};
  if (cell == "R") return {Side::right};
  return {Side::middle};
}

Result<Rig> Rig::read(const std::filesystem::path& path) {
  Result<Table> table = Table::read(path);
  if (!table.ok()) return table.error();
  std::vector<PendingRow> rows = readRows(*table);
  if (!table->state().ok()) return table->state().error();
  addMirrored(rows);
  Rig rig;
  for (PendingRow& row : rows) {
    const int self = int(rig.points.size());
    row.point.parent = rig.find(row.parent);
    if (row.point.parent < 0 && !row.parent.empty())
      return badInput("joints.csv: '" + row.point.name + "' comes before its parent '" + row.parent + "'");
    row.point.joint =
        row.point.landmark ? rig.points[std::size_t(row.point.parent)].joint : int(rig.joints.size());
    if (!row.point.landmark) rig.joints.push_back(self);
    rig.points.push_back(row.point);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].point.landmark) continue;
    rig.points[i].towards = rig.find(rows[i].towards);
    if (rig.points[i].towards < 0)
      return badInput("joints.csv: '" + rows[i].point.name + "' leads towards an unknown point '" +
                      rows[i].towards + "'");
  }
  return rig;
}

int Rig::find(std::string_view name) const {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].name == name) return int(i);
  return -1;
}

vec3 Rig::linkDirection(int point) const {
  const RigPoint& joint = points[std::size_t(point)];
  return glm::normalize(points[std::size_t(joint.towards)].position - joint.position);
}

Result<vec3> Rig::place(std::string_view text, Side side) const {
  const std::vector<std::string_view> parts = split(text, ':');
  const std::vector<std::string_view> ends = split(parts[0], '>');
  const auto named = [&](std::string_view name) {
    return find(side == Side::right ? mirroredName(name) : std::string(name));
  };
  const int from = named(ends[0]);
  if (from < 0) return badInput("place " + quoted(text) + ": no such joint");
  const int to = ends.size() > 1 ? named(ends[1]) : points[std::size_t(from)].towards;
  vec3 result = points[std::size_t(from)].position;
  if (parts.size() > 1) {
    const Result<float> fraction = parseNumber(parts[1]);
    if (!fraction.ok()) return fraction.error();
    if (to < 0) return badInput("place " + quoted(text) + ": the link has no end");
    result += *fraction * (points[std::size_t(to)].position - result);
  }
  if (parts.size() > 2) {
    if (parts[2].size() < 2 || parts[2].front() != '(' || parts[2].back() != ')')
      return badInput("place " + quoted(text) + ": write the offset as (dx dy dz)");
    const Result<vec3> offset = parseVector(parts[2].substr(1, parts[2].size() - 2));
    if (!offset.ok()) return offset.error();
    result += 1e-3f * (side == Side::right ? mirrored(*offset) : *offset);
  }
  return result;
}

Result<std::vector<vec3>> Rig::places(std::string_view text, Side side) const {
  std::vector<vec3> result;
  for (std::string_view part : split(text, ';')) {
    if (part.empty()) continue;
    const Result<vec3> point = place(part, side);
    if (!point.ok()) return point.error();
    result.push_back(*point);
  }
  return result;
}

}  // namespace vasa::human
