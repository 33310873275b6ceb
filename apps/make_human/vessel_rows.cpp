#include "make_human/vessel_rows.h"

namespace vasa::human {
namespace {

constexpr float kLeastDepth = 0.5f;  // [mm] of a vessel for which the table says nothing

}  // namespace

std::string_view sidePrefix(Side side) {
  return side == Side::left ? "left " : side == Side::right ? "right " : "";
}

bool parseKind(std::string_view text, VesselKind& kind) {
  for (VesselKind known : {VesselKind::artery, VesselKind::vein, VesselKind::portalVein})
    if (text == kindName(known)) return kind = known, true;
  return false;
}

Result<VesselRows> VesselRows::read(const std::filesystem::path& path, const Rig& rig) {
  Result<Table> table = Table::read(path);
  if (!table.ok()) return table.error();
  VesselRows rows(std::move(table).value());
  rows.readRows(rig);
  for (int i = 0; i < int(rows.rows_.size()) && rows.table_.state().ok(); ++i) rows.findAttachments(i);
  if (!rows.table_.state().ok()) return rows.table_.state().error();
  return rows;
}

void VesselRows::readRows(const Rig& rig) {
  for (std::size_t r = 0; r < table_.rowCount(); ++r)
    for (Side side : sidesOf(table_.text(r, "side"))) {
      VesselRow row;
      row.line = r;
      row.side = side;
      row.label.name = std::string(sidePrefix(side)).append(table_.text(r, "name"));
      const std::vector<std::string_view> ids = split(table_.text(r, "ontology"), '/');
      row.label.ontologyId = side == Side::right ? ids.back() : ids.front();
      const std::string_view kind = table_.text(r, "kind");
      if (!parseKind(kind, row.label.kind)) table_.fault(r, "unknown kind " + quoted(kind));
      row.from = table_.text(r, "from");
      row.to = table_.text(r, "to");
      row.waypoints = table_.take(r, rig.places(table_.text(r, "waypoints"), side));
      row.startRadius = table_.millimetres(r, "radius_start_mm");
      row.endRadius = table_.millimetres(r, "radius_end_mm");
      row.belowSkin = 1e-3f * table_.numberOr(r, "depth_mm", kLeastDepth);
      if (!numbers_.emplace(row.label.name, int(rows_.size())).second)
        table_.fault(r, "this vessel is there already");
      rows_.push_back(std::move(row));
    }
}

int VesselRows::find(Side side, std::string_view name) const {
  auto found = numbers_.find(std::string(sidePrefix(side)).append(name));
  if (found == numbers_.end()) found = numbers_.find(name);
  return found == numbers_.end() ? -1 : found->second;
}

Error VesselRows::fault(const VesselRow& row, const std::string& what) {
  table_.fault(row.line, what);
  return table_.state().error();
}

Attachment VesselRows::parse(const VesselRow& row, std::string_view text) {
  Attachment result;
  if (text.empty()) return result;
  constexpr std::string_view kContinues = "continues ";
  const bool continues = text.starts_with(kContinues);
  const std::vector<std::string_view> parts = split(continues ? text.substr(kContinues.size()) : text, '@');
  result.vessel = find(row.side, parts.front());
  if (result.vessel < 0) table_.fault(row.line, "no vessel " + quoted(parts.front()));
  result.kind = continues                 ? Attachment::Kind::continues
                : parts.back() == "start" ? Attachment::Kind::start
                : parts.back() == "end"   ? Attachment::Kind::end
                                          : Attachment::Kind::side;
  if (result.kind == Attachment::Kind::side)
    result.fraction = table_.take(row.line, parseNumber(parts.back()));
  if (result.fraction < 0 || result.fraction > 1) table_.fault(row.line, "a share lies between 0 and 1");
  return result;
}

void VesselRows::findAttachments(int i) {
  VesselRow& row = rows_[std::size_t(i)];
  row.source = parse(row, row.from);
  row.target = parse(row, row.to);
  if (row.source.kind != Attachment::Kind::continues || row.source.vessel < 0) return;
  int& next = rows_[std::size_t(row.source.vessel)].next;
  if (next >= 0) table_.fault(row.line, "another vessel continues this one already");
  next = i;
}

}  // namespace vasa::human
