#include "io/swc.h"

#include <algorithm>
#include <cctype>

#include "core/atomic_file.h"
#include "core/cancellation.h"
#include "core/letters.h"
#include "core/log.h"
#include "core/text_file.h"
#include "io/csv.h"
#include "io/words.h"

namespace vasa {
namespace {

constexpr std::size_t kMaximumSwcBytes = std::size_t(1) << 30;
constexpr const char* kLine =
    "id type x y z radius parent, with blanks or commas between and decimal points (a radius that is not known "
    "is 0); # begins a comment";

constexpr const char* kColumns[] = {"id", "type", "x", "y", "z", "radius", "parent"};
// How others begin the names of columns, in small letters; of one letter, whole.
struct Heading {
  int column;
  std::string_view names;
};
constexpr Heading kHeadings[] = {
    {0, " id n node index sample "}, {1, " type t label structure "}, {2, " x "}, {3, " y "}, {4, " z "},
    {5, " radius r rad "},           {6, " parent p pid par "}};

constexpr bool isMark(char c) { return c == ',' || c == ';'; }

std::string_view nextCell(std::string_view& line, char mark) {
  const std::string_view cell = line.substr(0, line.find(mark));
  line.remove_prefix(std::min(cell.size() + 1, line.size()));
  return csv::trimmed(cell);
}

char markOf(std::string_view line) { return line.find(';') != line.npos ? ';' : ','; }
bool isTable(std::string_view line, char mark) { return std::ranges::count(line, mark) >= 6; }

std::string withPoint(std::string_view number) {
  std::string text(number);
  if (const auto comma = text.find(','); comma == text.rfind(',') && text.find('.') == text.npos)
    std::ranges::replace(text, ',', '.');
  return text;
}

struct SwcHeading {
  std::string name;   // in small letters
  double metres = 0;  // a unit that stands behind it, else 0
};

SwcHeading swcHeading(std::string_view cell) {
  std::string text = lowerCase(cell);
  std::erase(text, '"');
  std::string_view whole = csv::trimmed(text);
  const std::size_t stop = std::min(whole.find_first_of(" \t[(_"), whole.size());
  std::string_view unit = whole.substr(stop);
  unit.remove_prefix(std::min(unit.find_first_not_of(" \t[(_"), unit.size()));
  unit = unit.substr(0, unit.find_first_of(" \t])"));
  const double metres = metresOfUnit(unit);
  return {std::string(metres > 0 ? whole.substr(0, stop) : whole), metres};
}

std::vector<SwcHeading> swcHeadings(std::string_view line) {
  std::vector<SwcHeading> headings;
  if (const char mark = markOf(line); isTable(line, mark)) {
    while (!line.empty()) headings.push_back(swcHeading(nextCell(line, mark)));
    return headings;
  }
  for (auto word = nextWord(line, " \t\r,;"); !word.empty(); word = nextWord(line, " \t\r,;")) {
    if (headings.empty() || (word[0] != '[' && word[0] != '('))
      headings.push_back(swcHeading(word));
    else
      headings.back() = swcHeading(headings.back().name + std::string(word));
  }
  return headings;
}

struct Row {
  SwcSample sample;
  std::int64_t parentId = -1;
  std::size_t line = 0;
};

class SwcReader {
 public:
  SwcReader(const std::string& name, const ImportFrame& frame) : name_(name), frame_(frame) {}

  Result<std::vector<SwcSample>> run(std::string_view text) {
    std::string kept;
    const auto plain = plainText(text, name_, kept);
    if (!plain) return plain.error();
    text = *plain;
    Checkpoints checkpoints;
    for (std::size_t line = 1; !text.empty(); ++line, checkpoints.pass())
      if (auto read = readLine(nextLine(text), line); !read) return read.error();
    if (rows_.empty()) return badInput(name_ + ": the file has no samples; a line of it is: " + kLine);
    if (auto numbered = orderIds(); !numbered) return numbered.error();
    if (auto linked = linkParents(); !linked) return linked.error();
    if (auto checked = checkCircles(); !checked) return checked.error();
    if (auto mended = mendRadii(); !mended) return mended.error();
    std::vector<SwcSample> samples;
    samples.reserve(rows_.size());
    for (const Row& row : rows_) samples.push_back(row.sample);
    return samples;
  }

 private:
  Error fail(std::size_t line, const std::string& what) const {
    return badInput(name_ + ":" + std::to_string(line) + ": " + what);
  }

  // A line of words before the first sample: the names of columns, or a title.
  static bool isHeading(std::string_view text) {
    const std::vector<std::string> words = wordsOfHeading(text);
    double number = 0;
    const auto numbers =
        std::ranges::count_if(words, [&](const std::string& word) { return parseNumber(word, number); });
    return !words.empty() && std::isalpha(static_cast<unsigned char>(words[0][0])) != 0 && numbers < 5;
  }
  // A unit behind a name ("x [cm]", "radius_mm") is none of it.
  static std::vector<std::string> wordsOfHeading(std::string_view text) {
    std::vector<std::string> words;
    for (const SwcHeading& heading : swcHeadings(text)) words.push_back(heading.name);
    return words;
  }
  // Columns are read by their order: names that tell of another one are refused. Of a comment, which may be
  // any words, diameters alone.
  Result<void> checkHeading(std::string_view text, std::size_t line, bool comment) const {
    const std::vector<std::string> words = wordsOfHeading(text);
    std::vector<int> columns;
    for (const std::string& word : words) {
      const auto found = std::ranges::find_if(kHeadings, [&](const Heading& heading) {
        return heading.names.find(' ' + word + ' ') != heading.names.npos;
      });
      columns.push_back(found == std::end(kHeadings) ? -1 : found->column);
    }
    const auto known = std::ranges::count_if(columns, [](int column) { return column >= 0; });
    const auto place = [&](int column) { return std::ranges::find(columns, column) - columns.begin(); };
    if (known < (comment ? 5 : 3)) return {};  // a title
    for (int column = 0; column < 7 && !comment; ++column)
      if (const auto at = place(column); at != column && at < std::ssize(columns))
        return fail(line, std::string("the ") + kColumns[column] + " is in column " + std::to_string(at + 1) +
                              "; order the columns: " + kLine);
    if (std::ranges::any_of(words, [](const std::string& word) { return word.starts_with("diam"); }))
      return fail(line, std::string("gives diameters; write radii: ") + kLine);
    double unit = 0;
    for (const SwcHeading& heading : swcHeadings(text)) {
      if (unit > 0 && heading.metres > 0 && heading.metres != unit)
        return fail(line, "its columns are in different units; write all lengths in one");
      if (heading.metres > 0) unit = heading.metres;
    }
    return {};
  }

  Result<void> readLine(std::string_view text, std::size_t line) {
    if (const std::size_t mark = text.find('#'); mark != text.npos) {
      if (rows_.empty())
        if (auto checked = checkHeading(text.substr(mark + 1), line, true); !checked) return checked;
      text = text.substr(0, mark);
    }
    // Tables of spreadsheets divide columns by semicolons, or else by commas; other commas are decimal ones,
    // which are refused unless semicolons stand between the columns.
    const char mark = markOf(text);
    const bool table = isTable(text, mark);
    if (text.find_first_not_of(" \t\r,;") == text.npos) return {};
    if (rows_.empty() && isHeading(text)) return checkHeading(text, line, false);
    double value[7];
    for (int column = 0; column < 7; ++column) {
      const std::string_view word = table ? nextCell(text, mark) : nextWord(text);
      if (word.empty())
        return fail(line, std::string("the ") + kColumns[column] + " is missing; a line is: " + kLine);
      if (column == 5 && sameLetters(word, "nan"))
        value[column] = 0;  // not known
      else if (!parseNumber(table && mark == ';' ? withPoint(word) : std::string(word), value[column]))
        return fail(line, std::string("the ") + kColumns[column] + " must be a finite number, found '" +
                              std::string(word.substr(0, 40)) + "'; a line is: " + kLine);
    }
    for (const int column : {0, 1, 6})
      if (value[column] != std::floor(value[column]) || std::abs(value[column]) > 1e15)
        return fail(line, std::string("the ") + kColumns[column] + " must be a whole number, found " +
                              numberText(value[column]));
    const dvec3 place(value[2], value[3], value[4]);
    if (std::max(glm::length(place), std::abs(value[5])) * frame_.metresPerUnit > kLargestImportedCoordinate)
      return fail(line, "lies farther than 1000 km away; give the file's unit with vasa convert --unit");
    if (value[5] < 0)
      return fail(line, "radius " + numberText(value[5]) + " must be positive; mend or remove the sample");
    Row row{{std::int64_t(value[0]), std::int64_t(value[1]), frame_.toHouse(place),
             float(value[5] * frame_.metresPerUnit)},
            std::int64_t(value[6]),
            line};
    rows_.push_back(row);
    return {};
  }

  // Sorted and not hashed: ids can be chosen so that they all meet in one place of a hash table.
  Result<void> orderIds() {
    byId_.resize(rows_.size());
    for (std::uint32_t i = 0; i < byId_.size(); ++i) byId_[i] = i;
    std::ranges::sort(byId_, {}, [this](std::uint32_t i) { return std::pair(rows_[i].sample.id, i); });
    // Of the samples that have an earlier one's id, the first in the file.
    std::uint32_t first = SwcSample::kRoot, before = 0;
    for (std::size_t k = 1; k < byId_.size(); ++k)
      if (rows_[byId_[k]].sample.id == rows_[byId_[k - 1]].sample.id && byId_[k] < first)
        first = byId_[k], before = byId_[k - 1];
    if (first == SwcSample::kRoot) return {};
    return fail(rows_[first].line, "id " + std::to_string(rows_[first].sample.id) + " is that of line " +
                                       std::to_string(rows_[before].line) +
                                       " already; number the samples anew");
  }

  Result<void> linkParents() {
    for (Row& row : rows_) {
      if (row.parentId < 0 || row.parentId == row.sample.id) continue;  // a root, also of those who name it
      if (row.parentId == 0 && rows_[byId_.front()].sample.id > 0) continue;  // some call that a root
      const auto found = std::ranges::lower_bound(byId_, row.parentId, {},
                                                  [this](std::uint32_t i) { return rows_[i].sample.id; });
      if (found == byId_.end() || rows_[*found].sample.id != row.parentId)
        return fail(row.line,
                    "parent " + std::to_string(row.parentId) + " does not exist; give -1 to a root");
      row.sample.parent = *found;
    }
    return {};
  }

  // Walks towards the root from every sample that no walk has passed yet.
  Result<void> checkCircles() {
    std::vector<std::uint32_t> walk(rows_.size(), 0);
    for (std::uint32_t i = 0; i < rows_.size(); ++i) {
      std::uint32_t at = i;
      while (at != SwcSample::kRoot && walk[at] == 0) walk[at] = i + 1, at = rows_[at].sample.parent;
      if (at != SwcSample::kRoot && walk[at] == i + 1)
        return fail(rows_[at].line, "its parents lead back to itself; give -1 to one of them");
    }
    return {};
  }

  Result<void> mendRadii() {
    std::vector<std::uint32_t> bare;
    for (std::uint32_t i = 0; i < rows_.size(); ++i)
      if (!(rows_[i].sample.radius > 0)) bare.push_back(i);
    if (bare.empty()) return {};
    if (bare.size() == rows_.size())
      return fail(rows_.front().line,
                  "no sample of the file has a radius above 0; give the vessels' radii in column 6");
    logWarning(name_ + ": " + std::to_string(bare.size()) + " samples without a radius (first: line " +
               std::to_string(rows_[bare.front()].line) + ") take a neighbour's");
    // Known radii spread from parents to children, then the other way, then whatever is left takes the mean.
    spread(bare, [this](std::uint32_t i) { return rows_[i].sample.parent; });
    std::vector<std::uint32_t> child(rows_.size(), SwcSample::kRoot);
    for (auto i = std::uint32_t(rows_.size()); i-- > 0;)
      if (const std::uint32_t parent = rows_[i].sample.parent; parent != SwcSample::kRoot) child[parent] = i;
    spread(bare, [&child](std::uint32_t i) { return child[i]; });
    double sum = 0;
    std::size_t known = 0;
    for (const Row& row : rows_)
      if (row.sample.radius > 0) sum += row.sample.radius, ++known;
    for (const std::uint32_t i : bare)
      if (!(rows_[i].sample.radius > 0)) rows_[i].sample.radius = float(sum / double(known));
    return {};
  }

  template <class Next>
  void spread(const std::vector<std::uint32_t>& bare, Next next) {
    std::vector<std::uint32_t> trail;
    for (const std::uint32_t first : bare) {
      trail.clear();
      std::uint32_t at = first;
      while (at != SwcSample::kRoot && rows_[at].sample.radius == 0) trail.push_back(at), at = next(at);
      // A trail that ends without a radius is marked, so that it is walked once only.
      const float radius = at == SwcSample::kRoot ? -1 : rows_[at].sample.radius;
      for (const std::uint32_t i : trail) rows_[i].sample.radius = radius;
    }
    for (const std::uint32_t i : bare) rows_[i].sample.radius = std::max(rows_[i].sample.radius, 0.0f);
  }

  std::string name_;
  ImportFrame frame_;
  std::vector<Row> rows_;
  std::vector<std::uint32_t> byId_;
};

}  // namespace

double swcUnit(std::string_view head) {
  while (!head.empty()) {
    std::string_view line = nextLine(head);
    if (const auto mark = line.find('#'); mark != line.npos) line.remove_prefix(mark + 1);
    const std::vector<SwcHeading> headings = swcHeadings(line);
    if (const auto x = std::ranges::find(headings, "x", &SwcHeading::name);
        x != headings.end() && x->metres > 0)
      return x->metres;
  }
  return 0;
}

Result<std::vector<SwcSample>> parseSwc(std::string_view text, const std::string& name,
                                        const ImportFrame& frame) {
  return SwcReader(name, frame).run(text);
}

Result<std::vector<SwcSample>> readSwc(const std::filesystem::path& path, const ImportFrame& frame) {
  const auto bytes = readFile(path, kMaximumSwcBytes);
  if (!bytes) return bytes.error();
  return parseSwc({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string(), frame);
}

std::string encodeSwc(std::span<const SwcSample> samples, const ImportFrame& frame) {
  std::string text = "# id type x y z radius parent\n";
  for (const SwcSample& sample : samples) {
    const dvec3 place = frame.toFile(sample.position);
    text += std::to_string(sample.id) + ' ' + std::to_string(sample.type);
    for (const double value : {place.x, place.y, place.z, double(sample.radius) / frame.metresPerUnit})
      text += ' ' + numberText(value + 0.0);
    text +=
        ' ' +
        (sample.parent == SwcSample::kRoot ? std::string("-1") : std::to_string(samples[sample.parent].id)) +
        '\n';
  }
  return text;
}

}  // namespace vasa
