#include "paper_page.h"

#include <fmt/format.h>

#include "io/base64.h"
#include "io/png.h"
#include "page.h"

namespace vasa::cli {
namespace {

// Bytes and counts as people read them, times to three digits; nothing where there is no number.
std::string count(const Report& value) {
  if (!value.is_number()) return "";
  std::string digits = fmt::format("{:.0f}", value.get<double>()), out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i && (digits.size() - i) % 3 == 0) out += "&thinsp;";
    out += digits[i];
  }
  return out;
}

std::string bytes(const Report& value) {
  if (!value.is_number()) return "";
  const double n = value.get<double>();
  return n < 1e5   ? fmt::format("{:.1f} kB", n / 1e3)
         : n < 1e6 ? fmt::format("{:.0f} kB", n / 1e3)
                   : fmt::format("{:.{}f} MB", n / 1e6,
                                 n < 1e7   ? 2
                                 : n < 1e8 ? 1
                                           : 0);
}

std::string digits(const Report& value) {
  if (!value.is_number()) return "";
  const double n = value.get<double>();
  return fmt::format("{:.{}f}", n, n < 10 ? 2 : n < 100 ? 1 : 0);
}

Report at(const Report& object, const char* key) {
  return object.is_object() && object.contains(key) ? object[key] : Report();
}

struct Cell {
  std::string text;
  const char* kind = "";  // "ours" or "paper"
};

std::string row(std::span<const Cell> cells, const char* tag = "td") {
  std::string out = "<tr>";
  for (const Cell& cell : cells)
    out += fmt::format("<{0} class=\"{1}\">{2}</{0}>", tag, cell.kind, cell.text);
  return out + "</tr>\n";
}

std::string table(const std::string& caption, const std::string& rows, const std::string& note) {
  return fmt::format(
      "<div class=\"scroll\"><table><caption>{}</caption>\n{}</table></div>\n<p class=\"soft\">{}</p>\n",
      caption, rows, note);
}

std::string storage(const Report& rows) {
  std::string out = row(std::vector<Cell>{{""},
                                          {"arteries", "ours"},
                                          {"veins", "ours"},
                                          {"total", "ours"},
                                          {"arteries, paper", "paper"},
                                          {"veins, paper", "paper"},
                                          {"total, paper", "paper"}},
                        "th");
  for (const Report& each : rows) {
    const std::string what = each["what"];
    const auto show = [&](const char* side, const char* key) {
      const Report value = at(each[side], key);
      return what.find("bytes") != std::string::npos ? bytes(value)
             : what.find(" : ") != std::string::npos ? digits(value)
                                                     : count(value);
    };
    std::vector<Cell> cells{{escaped(what)}};
    for (const char* side : {"ours", "paper"})
      for (const char* key : {"artery", "vein", "total"}) cells.push_back({show(side, key), side});
    out += row(cells);
  }
  return out;
}

std::string hierarchies(const Report& rows) {
  std::string out = row(std::vector<Cell>{{"hierarchy"},
                                          {"over"},
                                          {"triangles", "ours"},
                                          {"bytes", "ours"},
                                          {"build, ms", "ours"},
                                          {"refit, ms", "ours"},
                                          {"detection, ms", "ours"},
                                          {"pairs", "ours"},
                                          {"bytes, paper", "paper"}},
                        "th");
  for (const Report& each : rows) {
    const Report& ours = each["ours"];
    out += row(std::vector<Cell>{{escaped(each["hierarchy"].get<std::string>())},
                                 {escaped(each["over"].get<std::string>())},
                                 {count(at(ours, "triangles")), "ours"},
                                 {bytes(at(ours, "bytes")), "ours"},
                                 {digits(at(ours, "build_ms")), "ours"},
                                 {digits(at(ours, "refit_ms")), "ours"},
                                 {digits(at(ours, "detect_ms")), "ours"},
                                 {count(at(ours, "pairs")), "ours"},
                                 {bytes(at(each["paper"], "bytes")), "paper"}});
  }
  return out;
}

std::string frameRates(const Report& rows) {
  const char* names[] = {"render", "collision", "total", "frames/s"};
  std::vector<Cell> head{{"quads"}};
  for (const auto& [side, kind] : {std::pair{"", "ours"}, {", every triangle", "ours"}, {", paper", "paper"}})
    for (const char* name : names) head.push_back({fmt::format("{}{}", name, side), kind});
  std::string out = row(head, "th");
  for (const Report& each : rows) {
    std::vector<Cell> cells{{each["quads"].get<std::string>()}};
    for (const auto& [side, kind] :
         {std::pair{"ours", "ours"}, {"ours_every_triangle", "ours"}, {"paper", "paper"}})
      for (const char* key : {"render_ms", "collision_ms", "total_ms", "fps"})
        cells.push_back({digits(each[side][key]), kind});
    out += row(cells);
  }
  return out;
}

Result<std::string> figureHtml(std::size_t number, const PaperFigure& figure) {
  std::string out = "<figure><div class=\"panels\">\n";
  for (const PaperFigure::Panel& panel : figure.panels) {
    const auto png = encodePng(panel.picture, {.compression = 9});
    if (!png) return png.error();
    out += fmt::format(
        "<div style=\"flex:0 1 {1}px\"><img alt=\"{0}\" width=\"{1}\" height=\"{2}\" src=\"data:image/png;base64,{3}\">{0}</div>\n",
        escaped(panel.caption), panel.picture.width, panel.picture.height, encodeBase64(*png));
  }
  return out + fmt::format("</div><figcaption><b>Figure {}.</b> {}{}</figcaption></figure>\n", number,
                           figure.caption,
                           figure.note.empty() ? "" : fmt::format("<br><small>{}</small>", figure.note));
}

}  // namespace

Result<std::string> paperPage(const Report& report, std::span<const PaperFigure> figures) {
  std::string page = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">"
      "<title>Realistic deformation of 3D human blood vessels, made again</title><style>{}</style></head>\n<body><main>\n"
      "<h1>Realistic deformation of 3D human blood vessels, made again</h1>\n"
      "<p>The tables and figures of Park, Shim, Park, Kang and Kim (<i>Computer Animation and Virtual Worlds</i> 24:317–325, 2013), made "
      "by one run of <code>vasa paper</code>. The paper's numbers, measured on an Intel Core i7-3770K with a GeForce GTX 660, stand beside.</p>\n"
      "<p class=\"soft\">{}, {} threads; {}; motion: {}; pictures of Table III {} pixels{}.</p>\n",
      kPageStyle, escaped(report["device"].get<std::string>()), report["threads"].get<unsigned>(),
      escaped(report["vessels"].get<std::string>()), escaped(report["clip"].get<std::string>()),
      report["size"].get<std::string>(),
      report["quick"].get<bool>() ? "; --quick: few frames and coarser pictures" : "");
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const auto figure = figureHtml(i + 1, figures[i]);
    if (!figure) return figure.error();
    page += *figure;
  }
  page += table("<b>Table I.</b> Storage of mesh and sweeps.", storage(report["table1"]),
                escaped(report["notes"]["table1"].get<std::string>()));
  page += table(
      "<b>Table II.</b> Storage and times of conventional hierarchies over tessellated sweeps, and of trees over sweeps.",
      hierarchies(report["table2"]), escaped(report["notes"]["table2"].get<std::string>()));
  page += table("<b>Table III.</b> Milliseconds and frame rates by the resolution of tessellation.",
                frameRates(report["table3"]), escaped(report["notes"]["table3"].get<std::string>()));
  return page + "</main></body></html>\n";
}

}  // namespace vasa::cli
