#include "growth/growth_rules.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "support/growth.h"

using namespace vasa;

namespace {

std::string messageOf(std::string_view text) {
  const auto rules = parseGrowthRules(text, "g.lsys");
  REQUIRE_FALSE(rules.ok());
  CHECK(rules.error().fault == Fault::badInput);
  return rules.error().message;
}

const std::string kHead = "system a\naxiom S\n";

// Σ r³ of a letter's branches in r³ of the letter, and what the letter keeps at its end.
std::pair<float, float> flows(const GrowthRules& rules, std::uint32_t letter) {
  const auto& symbol = rules.tables.symbol[letter];
  float sum = 0;
  bool split = false;
  for (std::uint32_t c = 0; c < symbol.childCount; ++c) {
    const auto& child = rules.tables.child[symbol.firstChild + c];
    sum += child.radius * child.radius * child.radius;
    split = split || child.at == 1;
  }
  return {sum, split ? 0.0f : symbol.taper * symbol.taper * symbol.taper};
}

}  // namespace

TEST_CASE("a system worked by hand") {
  const auto rules = parseGrowthRules(
      "system fork  # two legs\naxiom S\nroot radius 0.02 share 0.25\ndraw S taper 1 meander 0.5 fibre 2\n"
      "S -> F [@1 S] [@1 S]\n",
      "g");
  REQUIRE(rules.ok());
  const auto& system = rules->tables.system[0];
  CHECK(rules->systems == std::vector<std::string>{"fork"});
  CHECK(system.radius == 0.02f);
  CHECK(system.share == 0.25f);
  CHECK(rules->tables.symbol[0].meander == 0.5f);
  CHECK(rules->tables.symbol[0].fibre == 2);
  CHECK(rules->treeSize(0, 1) == 1);
  CHECK(rules->treeSize(0, 2) == 3);
  CHECK(rules->treeSize(0, 4) == 15);
  CHECK(rules->tables.child[0].radius == doctest::Approx(0.7937f).epsilon(1e-4));  // Murray's symmetric fork
}

TEST_CASE("Murray's law holds at every branching of every letter: what the program ships, too") {
  const auto shipped = readGrowthRules(std::filesystem::path(VASA_GROWTH_DIR) / "capillaries.lsys");
  REQUIRE_MESSAGE(shipped.ok(), (shipped.ok() ? "" : shipped.error().message));
  const auto ours = parseGrowthRules(test::growthText(), "g");
  REQUIRE(ours.ok());
  for (const GrowthRules* rules : {&*shipped, &*ours})
    for (std::uint32_t letter = 0; letter < rules->symbols.size(); ++letter) {
      CAPTURE(rules->symbols[letter]);
      const auto [branches, kept] = flows(*rules, letter);
      if (rules->tables.symbol[letter].childCount > 0)
        CHECK(branches + kept == doctest::Approx(1).epsilon(1e-5));
    }
}

TEST_CASE("side branches take what the taper gives away around them") {
  const auto rules = parseGrowthRules(kHead + "draw S taper 0.5\nS -> F [@0.25 S] [@0.75 S]\n", "g");
  REQUIRE(rules.ok());
  const float middle = 0.75f;  // radius half way, where the two stretches meet
  CHECK(rules->tables.child[0].radius == doctest::Approx(std::cbrt(1 - std::pow(middle, 3.0f))));
  CHECK(rules->tables.child[1].radius == doctest::Approx(std::cbrt(std::pow(middle, 3.0f) - 0.125f)));
}

TEST_CASE("faults are told with file, line, cause and remedy") {
  CHECK(messageOf("") == "g.lsys: describes no system; begin one with a line `system NAME`");
  CHECK(messageOf("axiom S\n").starts_with("g.lsys:1: 'axiom' stands before any system"));
  CHECK(messageOf("system a\n").find("has no axiom; add a line") != std::string::npos);
  CHECK(messageOf(kHead).find("the axiom 'S' is never drawn") != std::string::npos);
  CHECK(messageOf(kHead + "draw S taper ten\n") == "g.lsys:3: 'taper' wants a number from 0.05 to 1");
  CHECK(messageOf(kHead + "draw S taper 1 taper\n").starts_with("g.lsys:3: 'taper' wants a number"));
  CHECK(messageOf(kHead + "draw S width 1\n")
            .starts_with("g.lsys:3: 'width' is not known here; use fibre, meander, taper"));
  CHECK(messageOf(kHead + "\n\nsprout 3\n").starts_with("g.lsys:5: 'sprout' begins no line that is known"));
  CHECK(messageOf(kHead + "draw S\ndraw S\n").find("was drawn in line 3 already") != std::string::npos);
  CHECK(messageOf(kHead + "draw S taper 0.5\nS -> F [@0.5 T]\n")
            .starts_with("g.lsys:4: letter 'T' is never drawn"));
  CHECK(messageOf(kHead + "draw S\nS -> [@1 S]\n").find("draws one curve first") != std::string::npos);
  CHECK(messageOf(kHead + "draw S\nS -> F [@1 S\n").find("not closed") != std::string::npos);
  CHECK(messageOf(kHead + "draw S\nS -> F []\n").find("is empty") != std::string::npos);
  CHECK(messageOf(kHead + "draw S\nS -> F S\n").find("outside of brackets") != std::string::npos);
  CHECK(messageOf(kHead + "draw S\nS -> F [@2 S]\n").find("'@2' wants a number from 0.02 to 1") !=
        std::string::npos);
  CHECK(messageOf(kHead + "draw S\nS -> F [=1 S]\n").find("is no module") != std::string::npos);
  CHECK(messageOf(kHead + "draw S taper 0.5\nS -> F [@1 S]\n")
            .find("grows thinner but has no branch on its side") != std::string::npos);
  CHECK(messageOf(kHead + "draw S taper 1\nS -> F [@0.5 S]\n").find("keeps its thickness") !=
        std::string::npos);
  CHECK(messageOf(kHead + "draw S\nsystem a\n").find("was described in line 1 already") != std::string::npos);
}

TEST_CASE("trees and tables have a limit, which is told") {
  std::string many = kHead + "draw S taper 0.5\nS -> F";
  for (int i = 0; i < 95; ++i) many += " [@0.5 S]";
  CHECK(messageOf(many + "\n").find("has more than 8192 curves") != std::string::npos);
  std::string systems;
  for (int i = 0; i < 17; ++i) systems += "system s" + std::to_string(i) + "\naxiom S\ndraw S\n";
  CHECK(messageOf(systems).find("at most 16 systems fit") != std::string::npos);
  std::string letters = kHead;
  for (int i = 0; i < 60; ++i) letters += "draw S" + std::to_string(i) + "\n";
  CHECK(messageOf(letters + "draw S\n").find("more than 48 letters") != std::string::npos);
}

TEST_CASE("cut, doubled and scrambled files are read or refused, never more") {
  const std::string text = test::growthText();
  std::mt19937 engine(7);
  for (std::size_t length = 0; length < text.size(); length += 7)
    (void)parseGrowthRules(std::string_view(text).substr(0, length), "g");
  for (int i = 0; i < 3000; ++i) {
    std::string broken = text;
    for (int k = 0; k < 4; ++k) broken[engine() % broken.size()] = char(engine() % 256);
    const auto rules = parseGrowthRules(broken, "g");
    if (rules.ok()) CHECK(rules->treeSize(0, 3) > 0);
  }
}
