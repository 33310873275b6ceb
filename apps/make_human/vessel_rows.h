#pragma once
#include <map>

#include "make_human/rig.h"
#include "network/builder.h"

namespace vasa::human {

/// How a vessel's end hangs on another: "X@0.4", "X@start", "X@end", "continues X", or nothing.
struct Attachment {
  enum class Kind { none, side, start, end, continues } kind = Kind::none;
  int vessel = -1;
  float fraction = 0;
};

/// A vessel of vessels.csv, on one side of the body.
struct VesselRow {
  std::size_t line = 0;
  NetworkBuilder::Label label;
  Side side = Side::middle;
  std::string from, to;
  std::vector<vec3> waypoints;
  float startRadius = 0, endRadius = 0;  ///< [m]
  float belowSkin = 0;                   ///< [m] how deep its wall must lie at least
  Attachment source, target;
  int next = -1;  ///< the row that continues this one
};

/// The rows of vessels.csv, those of both sides twice, and what hangs on what.
class VesselRows {
 public:
  static Result<VesselRows> read(const std::filesystem::path& path, const Rig& rig);

  const std::vector<VesselRow>& rows() const { return rows_; }
  /// The vessel of this name on a side, or in the middle; -1: none.
  int find(Side side, std::string_view name) const;
  /// An error that names a row's place in the file.
  Error fault(const VesselRow& row, const std::string& what);

 private:
  explicit VesselRows(Table table) : table_(std::move(table)) {}
  void readRows(const Rig& rig);
  void findAttachments(int i);
  Attachment parse(const VesselRow& row, std::string_view text);

  Table table_;
  std::vector<VesselRow> rows_;
  std::map<std::string, int, std::less<>> numbers_;
};

/// "left ", "right " or nothing: what begins the name of a vessel of that side.
std::string_view sidePrefix(Side side);
/// The kind of this name; false if there is none.
bool parseKind(std::string_view text, VesselKind& kind);

}  // namespace vasa::human
