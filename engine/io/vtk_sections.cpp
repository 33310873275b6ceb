#include "io/vtk_sections.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <utility>

#include "core/cancellation.h"
#include "core/letters.h"
#include "io/vtp_data.h"
#include "io/words.h"

// Legacy VTK (the format's versions 2 to 5): four lines of head, then sections that begin with a word. Binary
// numbers are big-endian. Since version 5 cells are two arrays, offsets and connectivity, before it a count
// before each cell.
namespace vasa::vtk {
namespace {

std::optional<vtp::Scalar> scalarOf(std::string_view word) {
  static const std::map<std::string_view, vtp::Scalar> kTypes{{"char", vtp::Scalar::int8},
                                                              {"signed_char", vtp::Scalar::int8},
                                                              {"unsigned_char", vtp::Scalar::uint8},
                                                              {"short", vtp::Scalar::int16},
                                                              {"unsigned_short", vtp::Scalar::uint16},
                                                              {"int", vtp::Scalar::int32},
                                                              {"unsigned_int", vtp::Scalar::uint32},
                                                              {"long", vtp::Scalar::int64},
                                                              {"unsigned_long", vtp::Scalar::uint64},
                                                              {"vtktypeint64", vtp::Scalar::int64},
                                                              {"vtktypeint32", vtp::Scalar::int32},
                                                              {"vtkidtype", vtp::Scalar::int64},
                                                              {"float", vtp::Scalar::float32},
                                                              {"double", vtp::Scalar::float64}};
  const auto found = kTypes.find(word);
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

std::string upper(std::string_view word) {
  std::string text(word);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  return text;
}

class SectionReader {
 public:
  explicit SectionReader(std::string_view text) : rest_(text) {}

  Sections run() {
    if (!line().starts_with("# vtk DataFile"))
      breaks("line 1", "is neither XML nor a legacy VTK file, which begins with \"# vtk DataFile Version\"");
    line();
    const std::string kind = upper(word());
    if (kind != "ASCII" && kind != "BINARY") breaks("line 3", "must be ASCII or BINARY");
    binary_ = kind == "BINARY";
    if (upper(word()) != "DATASET") breaks("line 4", "must be DATASET POLYDATA");
    const std::string set = upper(word());
    isGrid_ = set == "UNSTRUCTURED_GRID";
    if (set != "POLYDATA" && !isGrid_)
      breaks(
          "line 4",
          "holds " + set +
              ", not POLYDATA; extract its surface or lines (ParaView: Extract Surface) and save them as .vtp");
    for (std::string_view next = word(); !next.empty(); next = word()) section(upper(next));
    if (isGrid_) divideCells(out_, std::exchange(grid_, {}), types_);
    return std::move(out_);
  }

 private:
  static bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  std::string_view word() {
    checkpoints_.pass();
    while (!rest_.empty() && isSpace(rest_[0])) rest_.remove_prefix(1);
    std::size_t size = 0;
    while (size < rest_.size() && !isSpace(rest_[size])) ++size;
    const std::string_view found = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return found;
  }
  std::string_view line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view found = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return found;
  }
  std::size_t count(const std::string& place) {
    std::int64_t value = 0;
    if (const std::string_view text = word();
        !parseInteger(text, value) || value < 0 || std::size_t(value) > rest_.size())
      breaks(place, "promises more than the file holds, or no whole number: '" +
                        std::string(text.substr(0, 40)) + "'");
    return std::size_t(value);
  }
  vtp::Scalar type(const std::string& place) {
    const std::string name = lowerCase(word());
    const auto scalar = scalarOf(name);
    if (!scalar)
      breaks(place,
             "is of the type '" + name.substr(0, 40) + "', which is not read; save it as float or int");
    return *scalar;
  }

  std::vector<double> numbers(std::size_t amount, vtp::Scalar scalar, const std::string& place) {
    std::vector<double> values;
    if (!binary_) {
      if (amount > rest_.size()) breaks(place, "is cut short");
      values.resize(amount);
      for (double& value : values)
        if (const std::string_view text = word(); !parseNumber(text, value))
          breaks(place, "has no finite number where it has '" + std::string(text.substr(0, 40)) +
                            "'; mend it (0 is a radius that is not known)");
      return values;
    }
    if (const std::size_t end = rest_.find('\n'); end != rest_.npos)
      rest_.remove_prefix(end + 1);  // of the section's own line
    const std::size_t size = vtp::sizeOf(scalar);
    if (amount > rest_.size() / size) breaks(place, "is cut short");
    values.resize(amount);
    for (std::size_t i = 0; i < amount; ++i)
      values[i] = vtp::numberAt(reinterpret_cast<const std::byte*>(rest_.data()) + i * size, scalar, true);
    rest_.remove_prefix(amount * size);
    return values;
  }

  void section(const std::string& name) {
    if (name == "POINTS") return readPoints();
    if (name == "LINES" || name == "POLYGONS" || name == "TRIANGLE_STRIPS" || name == "VERTICES")
      return readCells(name);
    if (name == "CELLS" && isGrid_) return readCells(name);
    if (name == "CELL_TYPES" && isGrid_) {
      types_ = numbers(count(name), vtp::Scalar::int32, name);
      return;
    }
    if (name == "POINT_DATA" || name == "CELL_DATA") {
      data_ = name == "POINT_DATA" ? &out_.pointData : &out_.cellData;
      rows_ = count(name);
      return;
    }
    if (name == "FIELD") return readFields();
    if (name == "METADATA") {  // up to an empty line
      line();
      for (std::string_view text = line(); !rest_.empty() && text.find_first_not_of(" \t\r") != text.npos;)
        text = line();
      return;
    }
    if (name == "SCALARS" || name == "NORMALS" || name == "VECTORS" || name == "TENSORS" ||
        name == "TEXTURE_COORDINATES" || name == "COLOR_SCALARS" || name == "LOOKUP_TABLE")
      return readAttribute(name);
    breaks(name.substr(0, 40), "is no section that a legacy VTK file has; write the file again");
  }

  void readPoints() {
    const std::size_t amount = count("POINTS");
    const std::vector<double> xyz = numbers(3 * amount, type("POINTS"), "POINTS");
    for (std::size_t i = 0; i < amount; ++i)
      out_.points.emplace_back(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
  }

  void readCells(const std::string& name) {
    const std::size_t amount = count(name), size = count(name);
    const std::string_view before = rest_;
    Cells& cells = name == "CELLS" ? grid_ : out_.cells[name];
    if (upper(word()) == "OFFSETS") {
      const std::vector<double> offsets = numbers(amount, type(name), name);
      if (upper(word()) != "CONNECTIVITY") breaks(name, "needs CONNECTIVITY after OFFSETS");
      const std::vector<double> points = numbers(size, type(name), name);
      for (std::size_t i = 1; i < offsets.size(); ++i)
        addCell(cells, points, offsets[i - 1], offsets[i], name);
      return;
    }
    rest_ = before;
    const std::vector<double> all = numbers(size, vtp::Scalar::int32, name);
    double at = 0;
    for (std::size_t i = 0; i < amount; ++i) {
      if (!(at < double(all.size()))) breaks(name, "is cut short");
      const double corners = all[std::size_t(at)];
      addCell(cells, all, at + 1, at + 1 + corners, name);
      at += 1 + corners;
    }
  }
  void addCell(Cells& cells, const std::vector<double>& points, double from, double to,
               const std::string& name) {
    if (!(from >= 0 && to >= from && to <= double(points.size())))
      breaks(name, "cell " + std::to_string(cells.size()) + " does not lie in the file's list");
    for (auto k = std::size_t(from); k < std::size_t(to); ++k) {
      if (!(points[k] >= 0 && points[k] < double(out_.points.size())))
        breaks(name, "cell " + std::to_string(cells.size()) + " has a point outside the " +
                         std::to_string(out_.points.size()) + " that there are");
      cells.points.push_back(std::uint32_t(points[k]));
    }
    cells.ends.push_back(std::uint32_t(cells.points.size()));
  }

  // Blanks and the like are written as %20.
  std::string arrayName() {
    const std::string_view written = word();
    std::string name;
    for (std::size_t i = 0; i < written.size(); ++i) {
      unsigned code = 0;
      const char* const digits = written.data() + i + 1;
      if (written[i] == '%' && i + 2 < written.size() &&
          std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2)
        name += char(code), i += 2;
      else
        name += written[i];
    }
    return name;
  }

  void readFields() {
    word();
    const std::size_t arrays = count("FIELD");
    for (std::size_t i = 0; i < arrays; ++i) {
      const std::string name = arrayName();
      if (upper(name) == "METADATA") {
        section("METADATA");
        --i;
        continue;
      }
      const std::size_t components = count(name), rows = count(name);
      if (components > 0 && rows > rest_.size() / components) breaks(name, "is cut short");
      const std::string told = lowerCase(word());
      if (told == "string") {  // a line each
        if (binary_) breaks(name, "is of strings, which are not read; save as ASCII, or leave the array out");
        for (std::size_t row = 0; row <= components * rows; ++row) line();
        continue;
      }
      const auto scalar = scalarOf(told);
      if (!scalar) breaks(name, "is of the type '" + told.substr(0, 40) + "', which is not read");
      std::vector<double> values = numbers(components * rows, *scalar, name);
      if (components == 1) keep(name, std::move(values));
    }
  }

  void keep(const std::string& name, std::vector<double> values) {
    auto* const data = data_ ? data_ : ofField(values.size());
    if (!data) return;
    const auto [own, isNew] = places_[data].emplace(name, data->size());
    if (isNew) data->push_back({name, {}});
    (*data)[own->second].values = std::move(values);
  }
  // Some programs write what belongs to points or cells as data of the whole: its length tells whose it is.
  std::vector<Array>* ofField(std::size_t rows) {
    std::size_t cells = grid_.size();
    for (const auto& [name, own] : out_.cells) cells += own.size();
    return rows == out_.points.size() ? &out_.pointData : rows == cells ? &out_.cellData : nullptr;
  }

  void readAttribute(const std::string& kind) {
    const std::string name = arrayName();
    if (kind == "LOOKUP_TABLE") {
      const std::size_t colours = count(name);
      numbers(4 * colours, binary_ ? vtp::Scalar::uint8 : vtp::Scalar::float32, name);
      return;
    }
    std::size_t components = kind == "TENSORS" ? 9 : kind == "NORMALS" || kind == "VECTORS" ? 3 : 1;
    if (kind == "COLOR_SCALARS" || kind == "TEXTURE_COORDINATES") components = count(name);
    const auto scalar =
        kind == "COLOR_SCALARS" ? (binary_ ? vtp::Scalar::uint8 : vtp::Scalar::float32) : type(name);
    if (kind == "SCALARS") {
      std::string_view told = line();
      if (const std::string_view more = nextWord(told); !more.empty())
        if (std::int64_t value = 0; parseInteger(more, value) && value >= 1 && value <= 4)
          components = std::size_t(value);
      const std::string_view before = rest_;
      if (upper(word()) == "LOOKUP_TABLE")
        word();
      else
        rest_ = before;
    }
    std::vector<double> values = numbers(components * rows_, scalar, name);
    if (components == 1) keep(name, std::move(values));
  }

  std::string_view rest_;
  bool binary_ = false, isGrid_ = false;
  std::vector<Array>* data_ = nullptr;
  std::map<const std::vector<Array>*, std::map<std::string, std::size_t>> places_;  // of arrays by name
  std::size_t rows_ = 0;
  Cells grid_;                 // of an unstructured grid
  std::vector<double> types_;  // of its cells
  Checkpoints checkpoints_;
  Sections out_;
};

}  // namespace

Sections sectionsOf(std::string_view text) { return SectionReader(text).run(); }

}  // namespace vasa::vtk
