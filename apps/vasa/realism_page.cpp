#include "realism_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "page.h"

namespace vasa::cli {
namespace {

constexpr double kWidth = 360, kHeight = 200, kLeft = 44, kBottom = 26, kTop = 12;

std::string scoreRow(const char* name, const Report& score) {
  return fmt::format("<tr><td>{}<td>{}<td>{} of {}<td>{} of {}<td>{} of {}</tr>\n", name,
                     score["usable"].get<int>(), score["right_sign"].get<int>(), score["signed"].get<int>(),
                     score["within_1_sd"].get<int>(), score["banded"].get<int>(),
                     score["within_2_sd"].get<int>(), score["banded"].get<int>());
}

// A figure with its band: mean ± SD, or the range that was seen.
std::string published(const ProtocolRow& row) {
  std::string text = fmt::format("{:g}", row.mean);
  if (row.deviation)
    text += fmt::format(" ± {:g}", *row.deviation);
  else if (row.low && row.high)
    text += fmt::format(" ({:g} to {:g})", *row.low, *row.high);
  return text;
}

std::string verdict(const ProtocolResult& result) {
  if (!result.refusal.empty()) return escaped(result.refusal);
  std::string text;
  if (result.deviations)
    text = result.within(1)   ? "within 1 SD"
           : result.within(2) ? "within 2 SD"
                              : fmt::format("{:+.1f} SD", *result.deviations);
  if (result.rightSign && !*result.rightSign) text += text.empty() ? "wrong direction" : ", wrong direction";
  return text.empty() ? "right direction" : text;
}

std::string rowOf(const ProtocolRow& row, const ProtocolResult& result) {
  const std::string part =
      row.lastShare - row.firstShare < 1
          ? fmt::format(", {:.0f} to {:.0f} %", 100 * row.firstShare, 100 * row.lastShare)
          : "";
  return fmt::format(
      "<tr><td>{}{}<td style=\"text-align:left;white-space:normal\">{} → {}{}<td style=\"text-align:left\">{} → {}<td>{}<td class=paper>{}<td class=ours>{}<td style=\"text-align:left;white-space:normal\">{}<td style=\"text-align:left;white-space:normal\">{}</tr>\n",
      escaped(row.id), row.blind ? " *" : "", escaped(row.from), escaped(row.to), part,
      escaped(row.firstPose), escaped(row.lastPose), escaped(metricName(row.metric)), published(row),
      result.refusal.empty() ? fmt::format("{:.2f}", result.ours) : "", verdict(result), escaped(row.source));
}

std::string plot(const ProtocolSweep& sweep, const SweepCurve& curve) {
  if (!curve.refusal.empty())
    return fmt::format("<div>{}<br><small>{}</small></div>\n", escaped(sweep.name), escaped(curve.refusal));
  const float low = std::min(std::ranges::min(curve.values), 0.0f);
  float high = std::max(std::ranges::max(curve.values), 0.0f);
  if (high - low < 1) high = low + 1;
  const auto x = [&](float degrees) {
    return kLeft + (kWidth - kLeft - 10) * double(degrees) / double(sweep.degrees);
  };
  const auto y = [&](float value) {
    return kTop + (kHeight - kTop - kBottom) * double(high - value) / double(high - low);
  };
  std::string line;
  for (std::size_t i = 0; i < curve.values.size(); ++i)
    line += fmt::format("{}{:.1f},{:.1f}", i ? " " : "", x(curve.degrees[i]), y(curve.values[i]));
  std::string svg = fmt::format(
      "<div style=\"flex:0 1 {0}px\"><svg viewBox=\"0 0 {0} {1}\" width=\"100%\" font-size=\"11\" fill=\"#5c6675\">",
      kWidth, kHeight);
  for (const float value : {low, 0.0f, high})
    svg += fmt::format(
        "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#dfe3e8\"/><text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:.1f}</text>",
        kLeft, kWidth - 10, y(value), kLeft - 6, y(value) + 4, value);
  for (const float degrees : {0.0f, sweep.degrees / 2, sweep.degrees})
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{:.0f}°</text>", x(degrees),
                       kHeight - 8, degrees);
  return svg +
         fmt::format(
             "<polyline points=\"{}\" fill=\"none\" stroke=\"#a3262a\" stroke-width=\"2\"/></svg>{} <small>[{}]</small></div>\n",
             line, escaped(sweep.name), unitOf(sweep.metric));
}

}  // namespace

std::string realismPage(const Protocol& protocol, const RealismStudy& study, const Report& report) {
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\"><title>Vessels in motion, "
      "beside living people</title><style>{}</style></head><body><main>\n<h1>Vessels in motion, beside living people</h1>\n"
      "<p class=soft>{} and {}, posed as each study says, with vessels kept apart. What is on the left was taken on the right, too: ours is the mean.</p>\n",
      kPageStyle, escaped(report["body"].get<std::string>()), escaped(report["vessels"].get<std::string>()));
  page +=
      "<div class=scroll><table><caption><b>Score.</b> Blind figures (*) were not looked at while the model was tuned.</caption>\n"
      "<tr><th>figures<th>usable<th>right direction<th>within 1 SD<th>within 2 SD</tr>\n";
  page += scoreRow("tuned", report["score"]) + scoreRow("blind", report["blind"]);
  page +=
      "</table></div>\n<div class=scroll><table><caption><b>Figures.</b></caption>\n<tr><th>id<th>stretch<th>pose<th>metric<th class=paper>published<th class=ours>ours<th>verdict<th>source</tr>\n";
  for (std::size_t i = 0; i < protocol.rows.size(); ++i) page += rowOf(protocol.rows[i], study.results[i]);
  page += "</table></div>\n<figure><div class=panels>\n";
  for (std::size_t i = 0; i < protocol.sweeps.size(); ++i) page += plot(protocol.sweeps[i], study.curves[i]);
  return page + "</div><figcaption>Change over a joint's angle.</figcaption></figure></main></body></html>\n";
}

}  // namespace vasa::cli
