#include <algorithm>

#include "plate/sheet.h"

namespace vasa::plate {
namespace {

constexpr float kMeasure = 1000;  // [pixels] of an em at which letters are measured: widths to a thousandth

}  // namespace

Result<Typesetter> Typesetter::load() {
  auto plain = Lettering::load(kMeasure, {.bold = false, .hinted = false});
  if (!plain) return plain.error();
  auto bold = Lettering::load(kMeasure, {.bold = true, .hinted = false});
  if (!bold) return bold.error();
  return Typesetter(std::move(*plain), std::move(*bold));
}

float Typesetter::widthOf(std::string_view utf8, float size, bool bold) const {
  return float(face(bold).widthOf(utf8)) * size / kMeasure;
}

std::vector<std::string> Typesetter::wrap(std::string_view utf8, float size, float width, bool bold) const {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < utf8.size();) {
    const std::size_t end = std::min(utf8.find(' ', at), utf8.size());
    if (end > at) words.emplace_back(utf8.substr(at, end - at));
    at = end + 1;
  }
  const auto fill = [&](float most) {
    std::vector<std::string> lines;
    for (const std::string& word : words) {
      if (!lines.empty() && widthOf(lines.back() + " " + word, size, bold) <= most)
        lines.back() += " " + word;
      else
        lines.push_back(word);
    }
    return lines;
  };
  auto lines = fill(width);
  // As narrow as the same number of lines allows.
  for (int step = 1; step < 12; ++step) {
    auto narrower = fill(width * (1 - 0.05f * float(step)));
    if (narrower.size() > lines.size()) break;
    lines = std::move(narrower);
  }
  return lines;
}

}  // namespace vasa::plate
