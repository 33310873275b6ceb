#include "growth/growth_rules.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/text_file.h"
#include "growth/rule_text.h"

// A parametric, bracketed L-system (Prusinkiewicz and Lindenmayer 1990) whose every production draws one
// curve and hangs branches on it, S -> F [..] [..], is a table: letters, and for each letter its branches.
// Trees are then addressed without ever being written out: the number of curves in a tree of n generations
// follows from the table,
//   size(S, 0) = 0,  size(S, n) = 1 + Σ size(branch, n - 1),
// and so does the path to the k-th curve.
//
// Murray's law. Let ρ(t) be the curve's radius in first radii. Side branches at t_1 < t_2 < … share the curve
// out in stretches that meet half way between them; branch i takes the flow that its stretch gives away,
//   r_i³ = ρ(m_i)³ − ρ(m_{i+1})³,
// so r³ before a branch is r³ after it plus that of the branch; the branches at the end share ρ(1)³ by their
// weights.
namespace vasa {
namespace {

using shared::GrowthChild;
using shared::GrowthSymbol;
using shared::GrowthSystem;

constexpr std::size_t kMaximumRulesBytes = 1 << 20;

struct Branch {
  GrowthChild child;
  std::string letter;
  float weight = 1;
  std::size_t line = 0;
};

struct Letter {
  GrowthSymbol symbol{};
  std::vector<Branch> branches;
  std::size_t drawn = 0, produced = 0;  // lines; 0: not there
};

struct System {
  std::string name, axiom;
  GrowthSystem values{};
  std::size_t line = 0;
  std::vector<std::pair<std::string, Letter>> letters;

  // Null: there are too many.
  Letter* letter(std::string_view wanted) {
    for (auto& [known, value] : letters)
      if (known == wanted) return &value;
    if (letters.size() == shared::kMostGrowthSymbols) return nullptr;
    return &letters.emplace_back(std::string(wanted), Letter{}).second;
  }
};

std::string inQuotes(std::string_view word) {
  std::string text(1, '\'');
  text.append(word.substr(0, 40)).push_back('\'');
  return text;
}

// One value that a line may set.
struct Setting {
  float* value = nullptr;
  float low = 0, high = 0;
};
using Settings = std::map<std::string_view, Setting>;

class Parser {
 public:
  explicit Parser(const std::string& file) : file_(file) {}

  Result<GrowthRules> run(std::string_view text) {
    for (const RuleLine& line : ruleLines(text))
      if (auto read = readLine(line); !read) return read.error();
    if (systems_.empty())
      return badInput(file_ + ": describes no system; begin one with a line `system NAME`");
    for (System& system : systems_)
      if (auto added = addSystem(system); !added) return added.error();
    return std::move(rules_);
  }

 private:
  Error fault(std::size_t line, const std::string& what) const { return ruleFault(file_, line, what); }

  Error tooManyLetters(std::size_t line) const {
    return fault(
        line, "more than " + std::to_string(shared::kMostGrowthSymbols) + " letters in all; leave out some");
  }

  Result<void> readLine(const RuleLine& line) {
    const std::string_view first = line.words[0];
    if (first == "system") return beginSystem(line);
    if (systems_.empty())
      return fault(line.number,
                   inQuotes(first) + " stands before any system; begin with a line `system NAME`");
    System& system = systems_.back();
    if (first == "axiom") {
      if (line.words.size() != 2) return fault(line.number, "an axiom is one letter, as in `axiom S`");
      system.axiom = line.words[1];
      return {};
    }
    if (first == "root")
      return readSettings(
          line, 1,
          {{"radius", {&system.values.radius, 0.0001f, 0.2f}}, {"share", {&system.values.share, 0.01f, 1}}});
    if (first == "draw") return readLetter(line, system);
    if (line.words.size() > 1 && line.words[1] == "->") return readProduction(line, system);
    return fault(line.number,
                 inQuotes(first) +
                     " begins no line that is known; use system, axiom, root, draw, or LETTER -> F [..]");
  }

  Result<void> beginSystem(const RuleLine& line) {
    if (line.words.size() != 2) return fault(line.number, "a system has one name, as in `system brain`");
    for (const System& system : systems_)
      if (system.name == line.words[1])
        return fault(line.number, "system " + inQuotes(system.name) + " was described in line " +
                                      std::to_string(system.line) + " already; choose another name");
    if (systems_.size() == shared::kMostGrowthSystems)
      return fault(line.number,
                   "at most " + std::to_string(shared::kMostGrowthSystems) + " systems fit; leave out one");
    System system{.name = std::string(line.words[1]), .axiom = {}, .line = line.number, .letters = {}};
    system.values = {.axiom = 0, .radius = 0.01f, .share = 0.6f};
    systems_.push_back(std::move(system));
    return {};
  }

  Result<void> readSettings(const RuleLine& line, std::size_t first, const Settings& settings) {
    for (std::size_t i = first; i < line.words.size(); i += 2) {
      const auto found = settings.find(line.words[i]);
      if (found == settings.end()) {
        std::string known;
        for (const auto& entry : settings) known.append(known.empty() ? "" : ", ").append(entry.first);
        return fault(line.number, inQuotes(line.words[i]) + " is not known here; use " + known);
      }
      const auto number = i + 1 < line.words.size() ? line.words[i + 1] : std::string_view();
      if (auto set = take(found->second, number, line, line.words[i]); !set) return set;
    }
    return {};
  }

  // @param word  what the line sets
  Result<void> take(const Setting& setting, std::string_view number, const RuleLine& line,
                    std::string_view word) const {
    const auto read = numberIn(number);
    if (!read || *read < setting.low || *read > setting.high)
      return fault(line.number, inQuotes(word) + " wants a number from " + shortNumber(setting.low) + " to " +
                                    shortNumber(setting.high));
    *setting.value = *read;
    return {};
  }

  static std::string shortNumber(float value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
  }

  Result<void> readLetter(const RuleLine& line, System& system) {
    if (line.words.size() < 2)
      return fault(line.number, "say which letter is drawn, as in `draw S taper 0.6`");
    Letter* const found = system.letter(line.words[1]);
    if (!found) return tooManyLetters(line.number);
    Letter& letter = *found;
    if (letter.drawn)
      return fault(line.number, "letter " + inQuotes(line.words[1]) + " was drawn in line " +
                                    std::to_string(letter.drawn) + " already; leave out one of the lines");
    letter.drawn = line.number;
    GrowthSymbol& s = letter.symbol;
    s.taper = 1;
    return readSettings(
        line, 2,
        {{"taper", {&s.taper, 0.05f, 1}}, {"meander", {&s.meander, 0, 3}}, {"fibre", {&s.fibre, 0, 3}}});
  }

  Result<void> readProduction(const RuleLine& line, System& system) {
    Letter* const found = system.letter(line.words[0]);
    if (!found) return tooManyLetters(line.number);
    Letter& letter = *found;
    if (letter.produced)
      return fault(line.number, "letter " + inQuotes(line.words[0]) + " has a production in line " +
                                    std::to_string(letter.produced) + " already; leave out one of them");
    letter.produced = line.number;
    if (line.words.size() < 3 || line.words[2] != "F")
      return fault(line.number,
                   "a production draws one curve first: write " + std::string(line.words[0]) + " -> F [..]");
    for (std::size_t i = 3; i < line.words.size();) {
      if (line.words[i] != "[")
        return fault(line.number, inQuotes(line.words[i]) +
                                      " stands outside of brackets; every branch is [@place LETTER]");
      const auto close = std::find(line.words.begin() + std::ptrdiff_t(i), line.words.end(), "]");
      if (close == line.words.end()) return fault(line.number, "a bracket is not closed; add ]");
      const std::size_t end = std::size_t(close - line.words.begin());
      auto branch = readBranch(line, i + 1, end);
      if (!branch) return branch.error();
      letter.branches.push_back(std::move(*branch));
      i = end + 1;
    }
    return {};
  }

  Result<Branch> readBranch(const RuleLine& line, std::size_t first, std::size_t end) {
    Branch branch;
    branch.line = line.number;
    branch.child = {.symbol = 0, .at = 1, .radius = 0};
    if (first == end) return fault(line.number, "a branch is empty; write [@place LETTER]");
    for (std::size_t i = first; i + 1 < end; ++i) {
      const std::string_view word = line.words[i];
      GrowthChild& c = branch.child;
      const std::map<char, Setting> modules{{'@', {&c.at, 0.02f, 1}}, {'!', {&branch.weight, 0.01f, 100}}};
      const auto module = modules.find(word[0]);
      if (module == modules.end())
        return fault(line.number, inQuotes(word) + " is no module; use @place !weight, then one letter");
      if (auto set = take(module->second, word.substr(1), line, word); !set) return set.error();
    }
    branch.letter = line.words[end - 1];
    return branch;
  }

  // Murray's law: radii of a letter's branches.
  Result<void> shareFlow(const std::string& name, Letter& letter) {
    std::stable_sort(letter.branches.begin(), letter.branches.end(),
                     [](const Branch& a, const Branch& b) { return a.child.at < b.child.at; });
    const float taper = letter.symbol.taper;
    const auto flowAt = [&](float t) {
      const float r = 1 + (taper - 1) * t;
      return r * r * r;
    };
    std::vector<Branch>& all = letter.branches;
    std::size_t sides = 0;
    while (sides < all.size() && all[sides].child.at < 1) ++sides;
    if (!all.empty() && sides > 0 && taper == 1)
      return fault(
          all[0].line,
          "letter " + inQuotes(name) +
              " keeps its thickness and has nothing to give to branches on its side; draw it with a taper below 1");
    if (sides == 0 && !all.empty() && taper < 1)
      return fault(
          all[0].line,
          "letter " + inQuotes(name) +
              " grows thinner but has no branch on its side to take the flow; add one or draw it with taper 1");
    float before = 0, weights = 0;
    for (std::size_t i = 0; i < sides;) {
      std::size_t j = i;
      while (j < sides && all[j].child.at == all[i].child.at) ++j;
      const float after = j < sides ? (all[i].child.at + all[j].child.at) / 2 : 1.0f;
      for (std::size_t k = i; k < j; ++k)
        all[k].child.radius = std::cbrt((flowAt(before) - flowAt(after)) / float(j - i));
      before = after;
      i = j;
    }
    for (std::size_t i = sides; i < all.size(); ++i) weights += all[i].weight;
    for (std::size_t i = sides; i < all.size(); ++i)
      all[i].child.radius = std::cbrt(flowAt(1) * all[i].weight / weights);
    return {};
  }

  Result<void> addSystem(System& system) {
    const std::uint32_t firstSymbol = std::uint32_t(rules_.symbols.size());
    const auto numberOf = [&](std::string_view name) {
      for (std::size_t i = 0; i < system.letters.size(); ++i)
        if (system.letters[i].first == name) return std::ptrdiff_t(i);
      return std::ptrdiff_t(-1);
    };
    if (system.axiom.empty())
      return fault(system.line,
                   "system " + inQuotes(system.name) + " has no axiom; add a line `axiom LETTER`");
    if (numberOf(system.axiom) < 0)
      return fault(system.line, "the axiom " + inQuotes(system.axiom) + " is never drawn; add a line `draw " +
                                    system.axiom + "`");
    if (firstSymbol + system.letters.size() > shared::kMostGrowthSymbols) return tooManyLetters(system.line);
    for (auto& [name, letter] : system.letters) {
      if (!letter.drawn)
        return fault(letter.produced, "letter " + inQuotes(name) +
                                          " has a production but is never drawn; add a line `draw " + name +
                                          "`");
      if (auto shared = shareFlow(name, letter); !shared) return shared;
      letter.symbol.firstChild = childCount_;
      letter.symbol.childCount = std::uint32_t(letter.branches.size());
      if (childCount_ + letter.branches.size() > shared::kMostGrowthChildren)
        return fault(system.line, "more than " + std::to_string(shared::kMostGrowthChildren) +
                                      " branches in all; leave out some");
      for (Branch& branch : letter.branches) {
        const auto number = numberOf(branch.letter);
        if (number < 0)
          return fault(branch.line, "letter " + inQuotes(branch.letter) +
                                        " is never drawn; add a line `draw " + branch.letter.substr(0, 40) +
                                        "`");
        branch.child.symbol = firstSymbol + std::uint32_t(number);
        rules_.tables.child[childCount_++] = branch.child;
      }
      rules_.tables.symbol[rules_.symbols.size()] = letter.symbol;
      rules_.symbols.push_back(name);
    }
    system.values.axiom = firstSymbol + std::uint32_t(numberOf(system.axiom));
    rules_.tables.system[rules_.systems.size()] = system.values;
    rules_.systems.push_back(system.name);
    countTrees(firstSymbol);
    if (rules_.tables.symbol[system.values.axiom].treeSize[3] == 0)
      return fault(system.line, "a tree of three generations of system " + inQuotes(system.name) +
                                    " has more than " + std::to_string(shared::kRingCurves) +
                                    " curves; take out branches");
    return {};
  }

  // Sizes over the ring's stand as 0: such trees do not grow.
  void countTrees(std::uint32_t firstSymbol) {
    shared::GrowthTables& tables = rules_.tables;
    for (std::uint32_t level = 1; level <= shared::kMostGrowthLevels; ++level)
      for (std::uint32_t s = firstSymbol; s < rules_.symbols.size(); ++s) {
        shared::GrowthSymbol& own = tables.symbol[s];
        std::uint32_t size = 1, sparse = level == 2 ? 1 + shared::sparseOf(own.childCount) : 1;
        bool fits = true;
        for (std::uint32_t c = 0; c < own.childCount; ++c) {
          const shared::GrowthSymbol& branch = tables.symbol[tables.child[own.firstChild + c].symbol];
          fits = fits && (branch.treeSize[level - 1] > 0 || level == 1);
          size += branch.treeSize[level - 1];
          if (level > 2) sparse += branch.sparseSize[level - 1];
        }
        fits = fits && size <= shared::kRingCurves;
        own.treeSize[level] = fits ? size : 0;
        own.sparseSize[level] = fits ? sparse : 0;
      }
  }

  const std::string& file_;
  std::vector<System> systems_;
  GrowthRules rules_;
  std::uint32_t childCount_ = 0;
};

}  // namespace

Result<GrowthRules> parseGrowthRules(std::string_view text, const std::string& name) {
  return Parser(name).run(text);
}

Result<GrowthRules> readGrowthRules(const std::filesystem::path& path) {
  const auto text = readText(path, kMaximumRulesBytes);
  if (!text) return text.error();
  return parseGrowthRules(*text, path.string());
}

}  // namespace vasa
