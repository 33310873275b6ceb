#include <doctest/doctest.h>
#include <tinyxml2.h>

#include <set>
#include <sstream>

#include "cli/program.h"
#include "io/png.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

struct Point {
  double x = 0, y = 0;
};

std::vector<Point> pointsOf(const char* text) {
  std::vector<Point> points;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const auto comma = word.find(',');
    points.push_back({std::stod(word.substr(0, comma)), std::stod(word.substr(comma + 1))});
  }
  return points;
}

double turn(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }
bool cross(Point a, Point b, Point c, Point d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

// A plate of the size of a playing card.
std::vector<std::string> small(const std::string& plate, const std::string& file,
                               std::initializer_list<std::string> more = {}) {
  std::vector<std::string> arguments{"plate", plate, "-o", file, "--page", "110x150", "--dpi", "40"};
  arguments.insert(arguments.end(), more);
  return arguments;
}

}  // namespace

TEST_CASE("a plate as SVG names what it labels, and its lines do not cross") {
  TemporaryFolder folder;
  const std::string file = (folder.path() / "arm.svg").string();
  const auto outcome = runProgram(small("arm", file, {"--json"}));
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  const auto report = outcome.json();
  CHECK(report["labels"].size() >= 6);
  CHECK(report["page_mm"] == nlohmann::json({110, 150}));

  tinyxml2::XMLDocument document;
  REQUIRE(document.Parse(contentOf(file).c_str()) == tinyxml2::XML_SUCCESS);
  const auto* svg = document.FirstChildElement("svg");
  REQUIRE(svg);
  CHECK(std::string(svg->Attribute("viewBox")) == "0 0 110 150");
  CHECK(std::string(svg->FirstChildElement("title")->GetText()) == "Vessels of the arm");
  CHECK(svg->FirstChildElement("image"));

  std::vector<std::pair<std::string, std::vector<Point>>> leaders;
  for (auto* line = svg->FirstChildElement("polyline"); line; line = line->NextSiblingElement("polyline"))
    if (line->Attribute("class", "leader"))
      leaders.emplace_back(line->Attribute("data-vessel"), pointsOf(line->Attribute("points")));
  CHECK(leaders.size() == report["labels"].size());
  for (std::size_t i = 0; i < leaders.size(); ++i)
    for (std::size_t j = i + 1; j < leaders.size(); ++j)
      for (std::size_t a = 0; a + 1 < leaders[i].second.size(); ++a)
        for (std::size_t b = 0; b + 1 < leaders[j].second.size(); ++b)
          CHECK_FALSE(cross(leaders[i].second[a], leaders[i].second[a + 1], leaders[j].second[b],
                            leaders[j].second[b + 1]));

  std::map<std::string, std::string> texts;
  int keys = 0;
  for (auto* text = svg->FirstChildElement("text"); text; text = text->NextSiblingElement("text")) {
    const std::string kind = text->Attribute("class");
    keys += kind == "key";
    const double x = text->DoubleAttribute("x"), length = text->DoubleAttribute("textLength");
    const bool ends = std::string(text->Attribute("text-anchor")) == "end";
    CHECK((ends ? x - length : x) >= 0);
    CHECK((ends ? x : x + length) <= 110);
    if (kind != "label") continue;
    std::string& whole = texts[text->Attribute("data-vessel")];
    if (!whole.empty()) whole += ' ';
    whole += text->GetText();
  }
  for (const auto& [vessel, points] : leaders) CHECK(texts[vessel] == vessel);
  CHECK(texts.contains("Brachial artery"));
  CHECK(keys == 2);  // arteries and veins
}

TEST_CASE("a plate as PNG has its size and is the same every time; a PDF is one") {
  TemporaryFolder folder;
  const std::string first = (folder.path() / "a.png").string(), second = (folder.path() / "b.png").string(),
                    pdf = (folder.path() / "c.pdf").string();
  REQUIRE(runProgram(small("hand", first, {"--threads", "1"})).exit == 0);
  REQUIRE(runProgram(small("hand", second, {"--threads", "2"})).exit == 0);
  CHECK(contentOf(first) == contentOf(second));
  const auto picture = readPng(first);
  REQUIRE(picture.ok());
  CHECK(picture->width == 173);
  CHECK(picture->height == 236);
  CHECK(picture->rgba[0] == 255);
  REQUIRE(runProgram(small("hand", pdf)).exit == 0);
  CHECK(contentOf(pdf).starts_with("%PDF-1.5"));
}

TEST_CASE("names choose labels; one that is not seen is told, one that is unknown refused") {
  TemporaryFolder folder;
  const std::string file = (folder.path() / "leg.svg").string();
  const auto chosen = runProgram(
      small("leg", file, {"--side", "left", "--labels", "great saphenous vein,basilar artery", "--json"}));
  REQUIRE_MESSAGE(chosen.exit == 0, chosen.err);
  REQUIRE(chosen.json()["labels"].size() == 1);
  CHECK(chosen.json()["labels"][0]["text"] == "Great saphenous vein");
  CHECK(chosen.json()["unseen"] == nlohmann::json({"basilar artery"}));
  CHECK(chosen.err.find("'basilar artery' is not seen in this picture") != std::string::npos);
  CHECK(contentOf(file).find("Left, anterior view") != std::string::npos);
  REQUIRE(runProgram(small("leg", file, {"--view", "back", "--labels", "none"})).exit == 0);
  CHECK(contentOf(file).find("Right, posterior view") != std::string::npos);
  const auto unknown = runProgram(small("leg", file, {"--labels", "no such vessel"}));
  CHECK(unknown.exit == 3);
  CHECK(unknown.err.find("no vessel is named 'no such vessel'") != std::string::npos);
}

TEST_CASE("the plate of the brain holds the ring of arteries at its base, and nothing of the face") {
  TemporaryFolder folder;
  const std::string file = (folder.path() / "brain.svg").string();
  const auto outcome = runProgram(
      {"plate", "brain", "-o", file, "--dpi", "40", "--hide", "veins", "--labels", "all-visible", "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  const auto report = outcome.json();
  std::set<std::string> labels;
  for (const auto& label : report["labels"]) labels.insert(label["text"].get<std::string>());
  for (const char* name :
       {"Posterior communicating artery", "Anterior communicating artery", "Basilar artery",
        "Posterior cerebral artery", "Internal carotid artery", "Lenticulostriate artery"})
    CHECK_MESSAGE(labels.contains(name), name);
  for (const char* name : {"Facial artery", "Inferior alveolar artery", "External carotid artery"})
    CHECK_MESSAGE(!labels.contains(name), name);
  CHECK(contentOf(file).find("Inferior view") != std::string::npos);
}

TEST_CASE("a plate's colours and what they mean") {
  TemporaryFolder folder;
  const std::string file = (folder.path() / "thorax.svg").string();
  for (const auto& [colour, key] : {std::pair("blood", ">Blood poor in oxygen</text>"),
                                    {"region", ">Thorax</text>"},
                                    {"radius", ">16 mm</text>"}}) {
    const auto outcome = runProgram(small("thorax", file, {"--colour", colour, "--labels", "none"}));
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    CHECK(contentOf(file).find(key) != std::string::npos);
  }
}

TEST_CASE("what a plate cannot be is told before anything is loaded") {
  TemporaryFolder folder;
  const std::string file = (folder.path() / "a.png").string();
  const std::vector<std::vector<std::string>> wrong{
      {"plate"},
      {"plate", "front"},
      {"plate", "front", "-o", "a.jpg"},
      {"plate", "front", "-o", file, "--page", "A0"},
      {"plate", "front", "-o", file, "--page", "50x100"},
      {"plate", "front", "-o", file, "--page", "1000x1000", "--dpi", "600"},
      {"plate", "front", "-o", file, "--side", "up"},
      {"plate", "front", "-o", file, "--colour", "mood"},
      {"plate", "tail", "-o", file}};
  for (const auto& arguments : wrong) CHECK(runProgram(arguments).exit == 2);
  CHECK(listOf(folder.path()).empty());
}

TEST_CASE("render puts labels beside a still, and not into a film") {
  TemporaryFolder folder;
  const std::string file = (folder.path() / "a.png").string();
  const auto still = runProgram({"render", "--size", "480x270", "--labels", "aorta,femoral artery", "--title",
                                 "Two", "-o", file, "--json"});
  REQUIRE_MESSAGE(still.exit == 0, still.err);
  CHECK(still.json()["width"] == 480);
  const auto picture = readPng(file);
  REQUIRE(picture.ok());
  CHECK(picture->width == 480);
  CHECK(picture->height == 270);
  const auto film = runProgram({"render", "--clip", "walk", "--frames", "0:1", "--size", "96x96", "--labels",
                                "main", "-o", (folder.path() / "{frame}.png").string()});
  CHECK(film.exit == 2);
  CHECK(film.err.find("--labels draws stills") != std::string::npos);
}
