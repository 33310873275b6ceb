#include <cctype>
#include <filesystem>
#include <set>
#include <string>

#include "human/made_human.h"
#include "make_human/table.h"
#include "network/network.h"

using namespace vasa;
using namespace vasa::human;

namespace {

/// Names of the built-in human's vessels, and those of both sides without `left` or `right` as well.
std::set<std::string, std::less<>> presentNames() {
  std::set<std::string, std::less<>> names;
  for (const Vessel& vessel : madeHuman().vessels.vessels()) {
    names.insert(vessel.name);
    for (const std::string_view side : {"left ", "right "})
      if (vessel.name.starts_with(side)) names.insert(vessel.name.substr(side.size()));
  }
  return names;
}

}  // namespace

TEST_CASE("most vessels that an atlas names are there") {
  Result<Table> table = Table::read(std::filesystem::path(VASA_HUMAN_TABLES) / "checklist.csv");
  REQUIRE(table.ok());
  const auto present = presentNames();
  std::set<std::string, std::less<>> listed;
  int arteries = 0, arteriesThere = 0, veins = 0, veinsThere = 0;
  std::string missing;
  for (std::size_t row = 0; row < table->rowCount(); ++row) {
    const std::string name(table->text(row, "name"));
    CAPTURE(name);
    CHECK(listed.insert(name).second);
    const bool isArtery = table->text(row, "kind") == "artery", isThere = present.contains(name);
    (isArtery ? arteries : veins) += 1;
    (isArtery ? arteriesThere : veinsThere) += isThere;
    if (!isThere) missing += "; " + name;
  }
  MESSAGE(arteriesThere << " of " << arteries << " arteries, " << veinsThere << " of " << veins
                        << " veins; missing" << missing);
  CHECK(arteries >= 257);
  CHECK(veins >= 165);
  CHECK(arteriesThere >= 290);
  CHECK(veinsThere >= 200);
}

TEST_CASE("at least four fifths of the named vessels have a term of the ontology") {
  int known = 0, named = 0;
  for (const Vessel& vessel : madeHuman().vessels.vessels()) {
    if (std::isdigit(static_cast<unsigned char>(vessel.name.back()))) continue;
    ++named;
    known += !vessel.ontologyId.empty();
    if (!vessel.ontologyId.empty()) CHECK(vessel.ontologyId.starts_with("FMA"));
  }
  MESSAGE(known << " of " << named << " named vessels have an id");
  CHECK(known >= named * 4 / 5);
}
