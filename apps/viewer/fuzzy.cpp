#include "viewer/fuzzy.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <limits>

// The best way to lay a word's letters into a name, found by going through both (as Smith and Waterman 1981
// align sequences, with every letter of the word used): best[i] is the score of the letters so far with the
// last one at the name's letter i.
namespace vasa::viewer {
namespace {

constexpr float kLetter = 1, kInRow = 1.5f, kWordBegins = 2, kNameBegins = 0.5f;
constexpr float kGap = 0.15f, kMostGap = 1.5f;  // for each letter between two, and at most
constexpr float kLonger = 0.01f;                // for each letter of the name
constexpr float kAnswers = 0.7f;                // of the best score
constexpr float kNever = -std::numeric_limits<float>::infinity();

std::string plain(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = char(std::tolower(static_cast<unsigned char>(text[i])));
    if (c == 'e' && !result.empty() && (result.back() == 'a' || result.back() == 'o')) result.pop_back();
    result += c;
  }
  return result;
}

bool isLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || (c & 0x80); }

float begins(const std::string& name, std::size_t i) {
  if (i == 0) return kWordBegins + kNameBegins;
  return isLetter(name[i]) && !isLetter(name[i - 1]) ? kWordBegins : 0;
}

float scoreOfWord(std::string_view word, const std::string& name) {
  std::vector<float> before, best;
  for (std::size_t l = 0; l < word.size(); ++l) {
    best.assign(name.size(), kNever);
    for (std::size_t i = l; i < name.size(); ++i) {
      if (name[i] != word[l]) continue;
      const float own = kLetter + begins(name, i);
      if (l == 0) {
        best[i] = own;
        continue;
      }
      for (std::size_t k = l - 1; k < i; ++k) {
        if (before[k] == kNever) continue;
        const float gap = float(i - k - 1);
        best[i] = std::max(best[i], before[k] + own + (gap == 0 ? kInRow : -std::min(kGap * gap, kMostGap)));
      }
    }
    before.swap(best);
  }
  return before.empty() ? kNever : *std::ranges::max_element(before);
}

}  // namespace

std::optional<float> fuzzyScore(std::string_view typed, std::string_view name) {
  const std::string wanted = plain(typed), there = plain(name);
  if (there.empty()) return std::nullopt;
  if (wanted.find_first_not_of(' ') == std::string::npos) return 0;
  float sum = -kLonger * float(there.size());
  for (std::size_t at = 0; at < wanted.size();) {
    const std::size_t end = std::min(wanted.find(' ', at), wanted.size());
    if (end > at) {
      const float score = scoreOfWord(std::string_view(wanted).substr(at, end - at), there);
      if (score == kNever) return std::nullopt;
      sum += score;
    }
    at = end + 1;
  }
  return sum;
}

std::vector<std::uint32_t> fuzzySearch(std::string_view typed, std::span<const std::string_view> names) {
  std::vector<std::pair<float, std::uint32_t>> found;
  for (std::uint32_t n = 0; n < names.size(); ++n)
    if (const auto score = fuzzyScore(typed, names[n])) found.emplace_back(*score, n);
  std::ranges::stable_sort(found, std::greater<>(), &std::pair<float, std::uint32_t>::first);
  // What scatters a word's letters over the whole name is no answer where another has them in a row.
  std::vector<std::uint32_t> order;
  for (const auto& [score, n] : found)
    if (found.front().first <= 0 || score > kAnswers * found.front().first) order.push_back(n);
  return order;
}

}  // namespace vasa::viewer
