#include "core/nearest_names.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "core/letters.h"

namespace vasa {
namespace {

constexpr std::size_t kLongest = 80;  // letters that are compared

std::size_t changesBetween(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = std::exchange(last, row);
  }
  return last[b.size()];
}

bool holdsWords(const std::string& name, const std::string& words) {
  std::istringstream stream(words);
  std::string word;
  bool any = false;
  while (stream >> word) {
    if (name.find(word) == std::string::npos) return false;
    any = true;
  }
  return any;
}

}  // namespace

std::vector<std::string> nearestNames(const std::string& written, std::span<const std::string> names,
                                      std::size_t most) {
  struct Candidate {
    std::size_t changes;
    const std::string* name;
  };
  const std::string wanted = lowerCase(written.substr(0, kLongest));
  std::vector<Candidate> candidates;
  for (const std::string& name : names) {
    const std::string each = lowerCase(name.substr(0, kLongest));
    const std::size_t changes = changesBetween(wanted, each);
    if (changes * 3 <= std::max(wanted.size(), each.size()) || holdsWords(each, wanted))
      candidates.push_back({changes, &name});
  }
  std::ranges::stable_sort(candidates, {}, &Candidate::changes);
  std::vector<std::string> result;
  for (const Candidate& candidate : candidates)
    if (result.size() < most && std::ranges::find(result, *candidate.name) == result.end())
      result.push_back(*candidate.name);
  return result;
}

std::string didYouMean(const std::string& written, std::span<const std::string> names,
                       const std::string& otherwise) {
  const auto near = nearestNames(written, names, 3);
  std::string text;
  for (std::size_t i = 0; i < near.size(); ++i) {
    const bool words = near[i].find(' ') != std::string::npos;  // which would run into the sentence
    text += i == 0 ? "did you mean " : i + 1 == near.size() ? " or " : ", ";
    text += words ? '"' + near[i] + '"' : near[i];
  }
  return near.empty() ? otherwise : text + "?";
}

}  // namespace vasa
