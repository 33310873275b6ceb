#include "make_human/vessels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "make_human/through.h"
#include "network/builder.h"

// A row's curve passes through its waypoints and the points of the vessels it leaves and joins. Rows linked
// by `continues` are one smooth curve, cut where the names change. Curves are made on demand, hosts first.
namespace vasa::human {
namespace {

constexpr float kSpanLength = 0.020f;

/// "X@0.4", "X@start", "X@end", "continues X", or nothing.
struct Attachment {
  enum class Kind { none, side, start, end, continues } kind = Kind::none;
  int vessel = -1;
  float fraction = 0;
};

struct Row {
  std::size_t line = 0;
  NetworkBuilder::Label label;
  std::string from, to;
  Side side = Side::middle;
  std::vector<vec3> waypoints;
  float startRadius = 0, endRadius = 0;
  Attachment source, target;
  int next = -1;             ///< the row that continues this one
  bool begun = false;        ///< its curve is being made
  std::vector<vec3> points;  ///< de Boor points, once made
};

class VesselMaker {
 public:
  VesselMaker(Table table, const Rig& rig) : table_(std::move(table)), rig_(rig) {}

  Result<Network> run(float bodyHeight) {
    readRows();
    for (int i = 0; i < int(rows_.size()) && table_.state().ok(); ++i) findAttachments(i);
    for (int i = 0; i < int(rows_.size()) && table_.state().ok(); ++i) make(i);
    if (!table_.state().ok()) return table_.state().error();
    return join(bodyHeight);
  }

 private:
  void readRows() {
    for (std::size_t r = 0; r < table_.rowCount(); ++r)
      for (Side side : sidesOf(table_.text(r, "side"))) {
        Row row;
        row.line = r;
        row.side = side;
        const std::string_view prefix = side == Side::left ? "left " : side == Side::right ? "right " : "";
        row.label.name = std::string(prefix).append(table_.text(r, "name"));
        row.label.ontologyId = table_.text(r, "ontology");
        const std::string_view kind = table_.text(r, "kind");
        row.label.kind = kind == "artery" ? VesselKind::artery
                         : kind == "vein" ? VesselKind::vein
                                          : VesselKind::portalVein;
        if (kind != kindName(row.label.kind)) table_.fault(r, "unknown kind " + quoted(kind));
        row.from = table_.text(r, "from");
        row.to = table_.text(r, "to");
        row.waypoints = table_.take(r, rig_.places(table_.text(r, "waypoints"), side));
        row.startRadius = table_.millimetres(r, "radius_start_mm");
        row.endRadius = table_.millimetres(r, "radius_end_mm");
        if (!numbers_.emplace(row.label.name, int(rows_.size())).second)
          table_.fault(r, "this vessel is there already");
        rows_.push_back(std::move(row));
      }
  }

  /// The vessel of this name on the row's own side, or in the middle.
  int vesselNamed(const Row& row, std::string_view name) {
    const std::string_view prefix = row.side == Side::left    ? "left "
                                    : row.side == Side::right ? "right "
                                                              : "";
    auto found = numbers_.find(std::string(prefix).append(name));
    if (found == numbers_.end()) found = numbers_.find(std::string(name));
    if (found != numbers_.end()) return found->second;
    table_.fault(row.line, "no vessel " + quoted(name));
    return -1;
  }

  Attachment parse(const Row& row, std::string_view text) {
    Attachment result;
    if (text.empty()) return result;
    constexpr std::string_view kContinues = "continues ";
    if (text.starts_with(kContinues)) {
      result.kind = Attachment::Kind::continues;
      result.vessel = vesselNamed(row, text.substr(kContinues.size()));
      return result;
    }
    const std::vector<std::string_view> parts = split(text, '@');
    result.vessel = vesselNamed(row, parts.front());
    result.kind = parts.back() == "start" ? Attachment::Kind::start
                  : parts.back() == "end" ? Attachment::Kind::end
                                          : Attachment::Kind::side;
    if (result.kind == Attachment::Kind::side)
      result.fraction = table_.take(row.line, parseNumber(parts.back()));
    if (result.fraction < 0 || result.fraction > 1) table_.fault(row.line, "a share lies between 0 and 1");
    return result;
  }

  void findAttachments(int i) {
    Row& row = rows_[std::size_t(i)];
    row.source = parse(row, row.from);
    row.target = parse(row, row.to);
    if (row.source.kind != Attachment::Kind::continues || row.source.vessel < 0) return;
    int& next = rows_[std::size_t(row.source.vessel)].next;
    if (next >= 0) table_.fault(row.line, "another vessel continues this one already");
    next = i;
  }

  vec3 pointOf(const Attachment& attachment) {
    make(attachment.vessel);
    const Row& host = rows_[std::size_t(attachment.vessel)];
    if (host.points.empty()) return vec3(0);
    if (attachment.kind == Attachment::Kind::start) return host.points.front();
    if (attachment.kind == Attachment::Kind::end) return host.points.back();
    std::vector<vec4> points;
    for (vec3 p : host.points) points.emplace_back(p, 1);
    return vec3(evaluate(points, attachment.fraction * float(spanCount(points))));
  }

  /// Makes the whole line of rows that continue one another around row i.
  void make(int i) {
    if (!table_.state().ok() || !rows_[std::size_t(i)].points.empty()) return;
    while (rows_[std::size_t(i)].source.kind == Attachment::Kind::continues)
      i = rows_[std::size_t(i)].source.vessel;
    if (rows_[std::size_t(i)].begun)
      return table_.fault(rows_[std::size_t(i)].line, "this vessel hangs on itself");
    std::vector<vec3> waypoints;
    std::vector<std::size_t> ends;
    if (rows_[std::size_t(i)].source.kind != Attachment::Kind::none) {
      rows_[std::size_t(i)].begun = true;
      waypoints.push_back(pointOf(rows_[std::size_t(i)].source));
    }
    for (int k = i; k >= 0; k = rows_[std::size_t(k)].next) {
      Row& row = rows_[std::size_t(k)];
      row.begun = true;
      waypoints.insert(waypoints.end(), row.waypoints.begin(), row.waypoints.end());
      if (row.target.kind != Attachment::Kind::none) waypoints.push_back(pointOf(row.target));
      if (waypoints.size() < 2) return table_.fault(row.line, "a vessel needs two points");
      ends.push_back(waypoints.size() - 1);
    }
    const ThroughPoints curve(waypoints);
    float start = 0;
    for (std::size_t part = 0; part < ends.size(); ++part, i = rows_[std::size_t(i)].next) {
      const float end = curve.lengthAt(ends[part]);
      fit(rows_[std::size_t(i)], curve, start, end);
      start = end;
    }
  }

  static void fit(Row& row, const ThroughPoints& curve, float start, float end) {
    const int spans = std::max({2, int(std::ceil((end - start) / kSpanLength)), int(row.waypoints.size())});
    std::vector<vec3> knots;
    for (int k = 0; k <= spans; ++k)
      knots.push_back(curve.position(start + (end - start) * float(k) / float(spans)));
    row.points = interpolateAtKnots(knots, curve.tangent(start), curve.tangent(end));
  }

  Result<Network> join(float bodyHeight) {
    NetworkBuilder builder;
    for (const Row& row : rows_) {
      std::vector<vec4> points;
      for (std::size_t k = 0; k < row.points.size(); ++k) {
        const float t = float(k) / float(row.points.size() - 1);
        points.emplace_back(row.points[k], row.startRadius + t * (row.endRadius - row.startRadius));
      }
      builder.addVessel(row.label, std::move(points));
    }
    // Ends that share a place, by the end they all refer to.
    std::map<std::pair<int, bool>, std::vector<VesselEnd>> shared;
    const auto attach = [&](VesselEnd end, const Attachment& at) {
      if (at.kind == Attachment::Kind::none) return;
      const VesselId host{std::uint32_t(at.vessel)};
      if (at.kind == Attachment::Kind::side)
        builder.joinToSide(end, {host, at.fraction * float(builder.pointsOf(host).size() - 3)});
      else
        shared[{at.vessel, at.kind != Attachment::Kind::start}].push_back(end);
    };
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      attach({VesselId{std::uint32_t(i)}, false}, rows_[i].source);
      attach({VesselId{std::uint32_t(i)}, true}, rows_[i].target);
    }
    for (auto& [place, ends] : shared) {
      ends.insert(ends.begin(), {VesselId{std::uint32_t(place.first)}, place.second});
      builder.joinEnds(ends);
    }
    return builder.build(bodyHeight);
  }

  Table table_;
  const Rig& rig_;
  std::vector<Row> rows_;
  std::map<std::string, int> numbers_;
};

}  // namespace

Result<Network> makeVessels(const std::filesystem::path& vessels, const Rig& rig, float bodyHeight) {
  Result<Table> table = Table::read(vessels);
  if (!table.ok()) return table.error();
  return VesselMaker(std::move(table).value(), rig).run(bodyHeight);
}

}  // namespace vasa::human
