#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/result.h"
#include "network/network.h"

// The .vedit file: what is to be changed in a network, one operation a line. `#` begins a comment; names
// stand in double quotes (\" and \\ inside); a place on a vessel is a share of its arc length, from 0 at its
// start to 1. All lengths are millimetres, as people say them, and stay the numbers that were written until
// they are applied.
namespace vasa {

struct RadiusEdit {
  std::string vessel;
  double from = 0, to = 1, factor = 1;
  bool smooth = false;  ///< the factor is reached in the middle of the stretch only; otherwise all along it
};
struct StenosisEdit {
  std::string vessel;
  double at = 0, lengthMm = 0, percent = 0;  ///< of the diameter that the vessel has there
  double eccentricity = 0;                   ///< 1: the wall on the outside of the bend stays where it is
};
enum class EditSide : std::uint8_t { none, left, right, front, back, up, down };
struct AneurysmEdit {
  std::string vessel;
  double at = 0, lengthMm = 0, diameterMm = 0;
  EditSide side = EditSide::none;  ///< of the body, to which it bulges; none: all around
};
struct MoveEdit {
  std::string vessel;
  double at = 0;
  dvec3 byMm{0};
  double falloffMm = 0;  ///< along the vessel, to either side; 0: three times the way
};
struct StentEdit {
  std::string vessel;
  double from = 0, to = 1, radiusMm = 0;  ///< no narrower than this
};
struct GraftEdit {
  std::string vessel;
  double at = 0;
  std::string other;
  double otherAt = 0, radiusMm = 0;
  std::string name;        ///< empty: "graft from A to B"
  std::vector<dvec3> via;  ///< [mm] places that it passes, in order
};
struct BranchEdit {
  std::string vessel;
  double at = 0;
  std::string name;
  double radiusMm = 0, lengthMm = 0;
  dvec3 direction{0};  ///< of any length but zero
};
struct OccludeEdit {
  std::string vessel;
  double at = 0;
};
struct CutEdit {
  std::string vessel;
  double from = 0, to = 1;  ///< what lies between is taken away
};
struct JoinEdit {
  std::string vessel, other;
};
struct RenameEdit {
  std::string vessel, name;
};
struct KindEdit {
  std::string vessel;
  VesselKind kind = VesselKind::other;
};
struct DeleteEdit {
  std::string vessel;
  bool tree = false;  ///< with all that hangs on it
};

using EditOperation =
    std::variant<RadiusEdit, StenosisEdit, AneurysmEdit, MoveEdit, StentEdit, GraftEdit, BranchEdit,
                 OccludeEdit, CutEdit, JoinEdit, RenameEdit, KindEdit, DeleteEdit>;

/// A line of a journal.
struct Edit {
  EditOperation operation;
  std::string source;      ///< the journal's name, for messages
  std::uint32_t line = 0;  ///< from 1

  /// "journal.vedit:7"
  std::string where() const { return source + ":" + std::to_string(line); }
};

std::string_view operationName(const EditOperation& operation);  ///< its first word
const std::string& vesselOf(const EditOperation& operation);     ///< the vessel that it names first
/// Where on it, from 0 to 1: the middle of a stretch; negative for operations on a whole vessel.
double placeOf(const EditOperation& operation);

/// How an operation is written, e.g. "stenosis V s length_mm percent [eccentricity]", a line each.
std::string journalGrammar();

/// Reads a journal. badInput names the line, what is wrong there, and how the operation is written.
/// @param name  of the file, for messages
Result<std::vector<Edit>> parseJournal(std::string_view text, const std::string& name);
Result<std::vector<Edit>> readJournal(const std::filesystem::path& path);

/// An operation as a line without its end; parseJournal() reads the same out of it.
std::string journalLine(const EditOperation& operation);

}  // namespace vasa
