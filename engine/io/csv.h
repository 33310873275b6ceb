#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/result.h"
#include "math/types.h"

namespace vasa::csv {

std::string_view trimmed(std::string_view text);
std::string quoted(std::string_view text);  ///< in single quotes, for messages
/// A text as a cell of a table that is written for others (RFC 4180): in double quotes, those within doubled.
std::string cell(std::string_view text);
/// The parts of a text between separators, trimmed; empty parts are kept.
std::vector<std::string_view> split(std::string_view text, char separator);

/// A readable table: comma-separated, one header line, `#` starts a comment line, no quoting.
/// The first fault met while its cells are read (a missing column, a cell that is no number, what the caller
/// reports) is kept with file and line; read all rows, then ask state().
class Table {
 public:
  static Result<Table> read(const std::filesystem::path& path);

  std::size_t rowCount() const { return rows_.size(); }
  std::string_view text(std::size_t row, std::string_view column);
  float number(std::size_t row, std::string_view column);
  float numberOr(std::size_t row, std::string_view column, float fallback);
  /// A length given in millimetres, in metres.
  float millimetres(std::size_t row, std::string_view column) { return 1e-3f * number(row, column); }

  void fault(std::size_t row, const std::string& what);
  /// Takes over the error of a result; the value, or a default one.
  template <class T>
  T take(std::size_t row, Result<T> result) {
    if (result.ok()) return std::move(result).value();
    fault(row, result.error().message);
    return T{};
  }
  const Result<void>& state() const { return state_; }

 private:
  struct Row {
    int line;
    std::vector<std::string> cells;
  };
  std::string name_;
  std::unordered_map<std::string, std::size_t> columns_;
  std::vector<Row> rows_;
  Result<void> state_;
};

/// A finite decimal number and nothing else.
Result<float> parseNumber(std::string_view text);
/// Three numbers separated by blanks.
Result<vec3> parseVector(std::string_view text);

}  // namespace vasa::csv
