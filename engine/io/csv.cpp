#include "io/csv.h"

#include <charconv>
#include <cmath>

#include "core/atomic_file.h"
#include "core/text_file.h"

namespace vasa::csv {

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string cell(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string quoted(std::string_view text) { return std::string("'").append(text).append("'"); }

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t end; (end = text.find(separator)) != text.npos; text.remove_prefix(end + 1))
    parts.push_back(trimmed(text.substr(0, end)));
  parts.push_back(trimmed(text));
  return parts;
}

Result<float> parseNumber(std::string_view text) {
  float value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return badInput(quoted(text) + " is not a number");
  return value;
}

Result<vec3> parseVector(std::string_view text) {
  vec3 v{0};
  int count = 0;
  for (std::string_view part : split(text, ' ')) {
    if (part.empty()) continue;
    const Result<float> number = parseNumber(part);
    if (!number.ok()) return number.error();
    if (count < 3) v[count] = *number;
    ++count;
  }
  if (count != 3) return badInput(quoted(text) + " is not three numbers");
  return v;
}

Result<Table> Table::read(const std::filesystem::path& path) {
  Result<std::vector<std::byte>> bytes = readFile(path);
  if (!bytes.ok()) return bytes.error();
  Table table;
  table.name_ = path.filename().string();
  std::string kept;
  const auto content =
      plainText({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, table.name_, kept);
  if (!content) return content.error();
  int line = 0;
  for (std::string_view text : split(*content, '\n')) {
    ++line;
    if (text.empty() || text.front() == '#') continue;
    const std::vector<std::string_view> cells = split(text, ',');
    if (table.columns_.empty()) {
      for (std::size_t i = 0; i < cells.size(); ++i) table.columns_.emplace(cells[i], i);
      continue;
    }
    if (cells.size() != table.columns_.size())
      return badInput(table.name_ + ":" + std::to_string(line) + ": " + std::to_string(cells.size()) +
                      " cells where the header has " + std::to_string(table.columns_.size()) +
                      "; give each row as many, with nothing between two commas where it has no value");
    table.rows_.push_back({line, {cells.begin(), cells.end()}});
  }
  return table;
}

std::string_view Table::text(std::size_t row, std::string_view column) {
  const auto found = columns_.find(std::string(column));
  if (found != columns_.end()) return rows_[row].cells[found->second];
  fault(row, "the table has no column " + quoted(column) +
                 ": its first line that is no comment names the columns");
  return {};
}

float Table::number(std::size_t row, std::string_view column) {
  return take(row, parseNumber(text(row, column)));
}

float Table::numberOr(std::size_t row, std::string_view column, float fallback) {
  return text(row, column).empty() ? fallback : number(row, column);
}

void Table::fault(std::size_t row, const std::string& what) {
  if (state_.ok()) state_ = badInput(name_ + ":" + std::to_string(rows_[row].line) + ": " + what);
}

}  // namespace vasa::csv
