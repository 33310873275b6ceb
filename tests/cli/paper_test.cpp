#include <doctest/doctest.h>

#include "cli/program.h"
#include "support/shared_data.h"

using namespace vasa::test;

namespace {

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

void checkTableOne(const nlohmann::json& rows) {
  const auto rowOf = [&](const std::string& what) {
    for (const auto& row : rows)
      if (row["what"].get<std::string>().starts_with(what)) return row;
    FAIL("no row " << what);
    return rows;
  };
  const auto sweeps = rowOf("sweeps")["ours"];
  CHECK(sweeps["artery"].get<int>() + sweeps["vein"].get<int>() <= sweeps["total"].get<int>());
  // A ring of eight a section, two triangles between neighbours.
  CHECK(rowOf("mesh: triangles")["ours"]["total"] == 16 * sweeps["total"].get<int>());
  CHECK(rowOf("mesh: vertices")["paper"]["total"] == 32892);
  const double mesh = rowOf("mesh: bytes")["ours"]["total"],
               file = rowOf("sweeps: bytes of the file")["ours"]["total"];
  CHECK(mesh / file == doctest::Approx(rowOf("mesh : file")["ours"]["total"].get<double>()));
  CHECK(mesh > 5 * file);
}

void checkTableTwo(const nlohmann::json& rows) {
  REQUIRE(rows.size() == 12);
  const auto& exact = rows.back()["ours"];
  const auto& paper = rows[10]["ours"];
  CHECK(paper["pairs"] >= exact["pairs"]);
  CHECK(paper["bytes"] < 72000);
  CHECK(exact["pairs"] > 0);
  for (std::size_t i = 0; i < 10; ++i) {
    const auto& boxes = rows[i]["ours"];
    for (const char* key : {"triangles", "bytes", "build_ms", "refit_ms", "detect_ms"}) CHECK(boxes[key] > 0);
    CHECK(boxes["bytes"] > 10 * paper["bytes"].get<int>());
    // Flat quads in round tubes meet less often; the mesh's, as long as a sweep, cut across bends.
    if (i >= 2) CHECK(boxes["pairs"] <= exact["pairs"]);
    CHECK(boxes["pairs"].get<int>() > exact["pairs"].get<int>() / 5);
    CHECK(rows[i]["paper"].is_null() == (i % 2 == 0));
  }
  // Both kinds of box find the same.
  for (std::size_t i = 0; i < 10; i += 2) CHECK(rows[i]["ours"]["pairs"] == rows[i + 1]["ours"]["pairs"]);
}

void checkTableThree(const nlohmann::json& rows) {
  REQUIRE(rows.size() == 4);
  for (const auto& row : rows) {
    for (const char* side : {"ours", "ours_every_triangle"}) {
      const auto& ours = row[side];
      for (const char* key : {"render_ms", "collision_ms", "total_ms", "fps", "triangles"})
        CHECK(ours[key] > 0);
      CHECK(ours["total_ms"] >= ours["render_ms"]);
    }
    CHECK(row["ours"]["triangles_drawn"] < row["ours_every_triangle"]["triangles_drawn"]);
    CHECK(row["paper"]["fps"] > 0);
  }
  CHECK(rows[3]["quads"] == "8x10");
  CHECK(rows[3]["paper"]["render_ms"] == 32);
}

}  // namespace

TEST_CASE("paper makes the tables and figures of the built-in human, each beside the paper's numbers") {
  const TemporaryFolder folder;
  const auto to = (folder.path() / "page").string();
  const auto outcome = runProgram({"paper", "-o", to, "--quick", "--size", "128x72", "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK(listOf(to) == std::vector<std::string>{"index.html", "report.json"});
  const auto report = nlohmann::json::parse(contentOf(folder.path() / "page" / "report.json"));
  CHECK(report == outcome.json());
  checkTableOne(report["table1"]);
  checkTableTwo(report["table2"]);
  checkTableThree(report["table3"]);
  REQUIRE(report["figures"].size() == 7);
  const int panels[] = {2, 3, 3, 3, 4, 5, 3};
  for (std::size_t i = 0; i < 7; ++i) CHECK(report["figures"][i]["panels"].size() == std::size_t(panels[i]));
  CHECK(report["figures"][2]["facts"]["capillaries"][2] > report["figures"][2]["facts"]["capillaries"][0]);

  const std::string page = contentOf(folder.path() / "page" / "index.html");
  CHECK(countOf(page, "<img ") == 23);
  CHECK(countOf(page, "src=\"data:image/png;base64,iVBORw0KGgo") == 23);
  CHECK(countOf(page, "src=") == 23);  // nothing from elsewhere
  CHECK(page.find("href=") == page.npos);
  CHECK(countOf(page, "<table>") == 3);
  CHECK(page.ends_with("</html>\n"));
}

TEST_CASE("paper says what is wrong, and leaves nothing behind where it is stopped") {
  const TemporaryFolder folder;
  const auto to = (folder.path() / "page").string();
  CHECK(runProgram({"paper", "-o", "/dev/null/page", "--quick"}).exit == 6);
  CHECK(runProgram({"paper", "-o", to, "--clip", "no such"}).exit == 3);
  CHECK(runProgram({"paper", "-o", to, "--mesh", "nowhere.glb"}).exit == 6);
  ProgramOptions options;
  options.signalAfterMs = 2500;
  CHECK(runProgram({"paper", "-o", to}, options).exit == 130);
  if (std::filesystem::exists(to)) CHECK(listOf(to).empty());
}
