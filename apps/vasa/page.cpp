#include "page.h"

namespace vasa::cli {

const char* const kPageStyle = R"(
:root { --ink: #1c2430; --soft: #5c6675; --line: #dfe3e8; --ours: #f3f7fb; --accent: #a3262a; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: var(--ink); font: 16px/1.5 system-ui, "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1180px; margin: 0 auto; padding: 40px 24px 64px; }
h1 { font-size: 30px; line-height: 1.2; margin: 0 0 8px; }
h2 { font-size: 19px; margin: 48px 0 4px; }
p { margin: 6px 0 12px; max-width: 880px; }
.soft, figcaption small { color: var(--soft); }
figure { margin: 48px 0 0; }
.panels { display: flex; flex-wrap: wrap; gap: 12px; align-items: flex-end; justify-content: center; }
.panels > div { min-width: 140px; text-align: center; font-size: 14px; color: var(--soft); }
.panels img { width: 100%; height: auto; display: block; margin: 0 auto; }
figcaption { margin-top: 10px; max-width: 880px; }
figcaption b, caption b { color: var(--accent); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 14px; font-variant-numeric: tabular-nums; margin-top: 8px; width: 100%; }
caption { text-align: left; padding: 48px 0 6px; font-size: 16px; }
th, td { padding: 5px 10px; border-bottom: 1px solid var(--line); text-align: right; white-space: nowrap; }
th { font-weight: 600; vertical-align: bottom; }
td:first-child, th:first-child { text-align: left; white-space: normal; }
td.paper, th.paper { color: var(--soft); }
td.ours, th.ours { background: var(--ours); }
.band { display: inline-block; width: 12px; height: 12px; vertical-align: -1px; margin: 0 5px 0 12px; }
@media print { main { max-width: none; padding: 0; } figure, table { break-inside: avoid; } }
)";

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

}  // namespace vasa::cli
