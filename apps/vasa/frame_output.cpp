#include "frame_output.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "render/renderer.h"

namespace vasa::cli {
namespace {

template <class Number = std::uint32_t>
std::optional<Number> number(std::string_view text) {
  Number value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

struct Pair {
  std::string_view left, right;
};

std::optional<Pair> splitAt(std::string_view text, char separator) {
  const auto at = text.find(separator);
  if (at == std::string_view::npos) return std::nullopt;
  return Pair{text.substr(0, at), text.substr(at + 1)};
}

Error usage(std::string message) { return {Fault::usage, std::move(message)}; }

// "AxB" with both in their ranges.
std::optional<std::pair<std::uint32_t, std::uint32_t>> product(const std::string& text, FrameRange a,
                                                               FrameRange b) {
  const auto pair = splitAt(text, 'x');
  if (!pair) return std::nullopt;
  const auto left = number(pair->left), right = number(pair->right);
  if (!left || !right || *left < a.first || *left > a.last || *right < b.first || *right > b.last)
    return std::nullopt;
  return std::pair(*left, *right);
}

}  // namespace

Result<Clip> timingOf(const Clip* clip, double fps) {
  if (!clip && fps > 0)
    return Error{Fault::usage, "--fps: without a clip there is one pose, rest; add --clip NAME"};
  if (!clip) return Clip{};
  return Clip{.start = clip->start,
              .end = clip->end,
              .framesPerSecond = fps > 0 ? float(fps) : clip->framesPerSecond};
}

Result<FrameRange> parseFrameRange(const std::string& text, std::uint32_t count) {
  FrameRange range{0, count - 1};
  if (text.empty()) return range;
  const auto pair = splitAt(text, ':').value_or(Pair{text, text});
  const auto first = pair.left.empty() ? range.first : number(pair.left);
  const auto last = pair.right.empty() ? range.last : number(pair.right);
  if (!first || !last || *first > *last || *last >= count)
    return usage(fmt::format("--frames {}: give FIRST:LAST within 0:{}, both included{}", text, count - 1,
                             count == 1 ? "; without a motion (--clip) there is one frame" : ""));
  return FrameRange{*first, *last};
}

Result<Shard> parseShard(const std::string& text) {
  if (text.empty()) return Shard{};
  if (const auto pair = splitAt(text, '/')) {
    const auto index = number(pair->left), total = number(pair->right);
    if (index && total && *index < *total) return Shard{*index, *total};
  }
  return usage("--shard " + text + ": give i/n with 0 <= i < n, for example 0/4");
}

Result<PictureSize> parseSize(const std::string& text) {
  constexpr FrameRange kPixels{1, kMostPixelsAcross};
  if (const auto size = product(text, kPixels, kPixels)) return PictureSize{size->first, size->second};
  return usage(fmt::format("--size {}: give WIDTHxHEIGHT in pixels, for example 1280x720 (at most {} each)",
                           text, kMostPixelsAcross));
}

Result<Quads> parseQuads(const std::string& text) {
  if (text == "auto") return Quads{.pixelError = kAutoPixelError};
  if (text.starts_with("auto:"))
    if (const auto pixels = number<float>(std::string_view(text).substr(5));
        pixels && *pixels >= 0.001f && *pixels <= 10)
      return Quads{.pixelError = *pixels};
  if (const auto quads = product(text, {3, 16}, {2, 20})) return Quads{quads->first, quads->second};
  return usage(
      "--quads " + text +
      ": give MxN with M from 3 to 16 around and N from 2 to 20 along, for example 8x5, or auto, or auto:PIXELS with an error from 0.001 to 10");
}

Result<FramePattern> FramePattern::parse(const std::string& text, bool several) {
  FramePattern pattern;
  const auto open = text.find('{');
  if (open == std::string::npos) {
    if (several) {
      const std::string extension = std::filesystem::path(text).extension().string();
      return usage("-o " + text +
                   ": several frames would overwrite one file; put the number into the name, for example '" +
                   text.substr(0, text.size() - extension.size()) + "_{frame:04}" + extension + "'");
    }
    pattern.before_ = text;
    return pattern;
  }
  const auto close = text.find('}', open);
  const std::string_view field =
      std::string_view(text).substr(open, close == std::string::npos ? close : close + 1 - open);
  std::optional<std::uint32_t> digits = 0;
  if (field.starts_with("{frame:0") && field.ends_with('}'))
    digits = number(field.substr(8, field.size() - 9));
  else if (field != "{frame}")
    digits.reset();
  if (!digits || *digits > 9 || text.find_first_of("{}", close + 1) != std::string::npos)
    return usage("-o " + text + ": the only place holder is {frame}, or {frame:04} for leading zeros, once");
  pattern.before_ = text.substr(0, open);
  pattern.after_ = text.substr(close + 1);
  pattern.digits_ = int(*digits);
  pattern.numbered_ = true;
  return pattern;
}

std::filesystem::path FramePattern::of(std::uint32_t frame) const {
  return numbered_ ? fmt::format("{}{:0{}}{}", before_, frame, digits_, after_) : before_;
}

}  // namespace vasa::cli
