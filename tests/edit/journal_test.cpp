#include "edit/journal.h"

#include <doctest/doctest.h>

#include "core/atomic_file.h"
#include "support/shared_data.h"

using namespace vasa;

namespace {

std::string faultOf(const std::string& text) {
  const auto edits = parseJournal(text, "f.vedit");
  REQUIRE(!edits.ok());
  CHECK(edits.error().fault == Fault::badInput);
  return edits.error().message;
}

template <class Operation>
Operation only(const std::string& text) {
  const auto edits = parseJournal(text, "f.vedit");
  REQUIRE_MESSAGE(edits.ok(), edits.error().message);
  REQUIRE(edits->size() == 1);
  REQUIRE(std::holds_alternative<Operation>(edits->front().operation));
  return std::get<Operation>(edits->front().operation);
}

}  // namespace

TEST_CASE("a journal's operations, comments, quotes and line ends are read") {
  const auto edits = parseJournal(
      "# lesions\r\n\n  stenosis \"a \\\"b\\\" c\" 0.1 12 70 # half\r\nkind aorta vein", "f.vedit");
  REQUIRE(edits.ok());
  REQUIRE(edits->size() == 2);
  CHECK((*edits)[0].where() == "f.vedit:3");
  CHECK((*edits)[1].where() == "f.vedit:4");
  CHECK(vesselOf((*edits)[0].operation) == "a \"b\" c");
  CHECK(placeOf((*edits)[0].operation) == 0.1);
  CHECK(placeOf((*edits)[1].operation) < 0);
  CHECK(only<RadiusEdit>("radius \"v\" 0 0.5 x2 smooth").smooth);
  CHECK(only<RadiusEdit>("radius v 0 0.5 0.5").factor == 0.5);
  CHECK(placeOf(only<StentEdit>("stent v 0.2 0.4 2")) == doctest::Approx(0.3));
  CHECK(only<StenosisEdit>("stenosis v 0.1 12 70 0.5").eccentricity == 0.5);
  CHECK(only<AneurysmEdit>("aneurysm v 0.1 12 70 front").side == EditSide::front);
  CHECK(only<MoveEdit>("move v 0.5 1 -2 3e0 20").byMm == dvec3(1, -2, 3));
  CHECK(only<GraftEdit>("graft a 0 b 1 2").name.empty());
  const auto graft = only<GraftEdit>("graft a 0 b 1 2 \"via\" via 1 2 3 4 5 6");
  CHECK(graft.name == "via");
  CHECK(graft.via == std::vector<dvec3>{{1, 2, 3}, {4, 5, 6}});
  CHECK(only<BranchEdit>("branch a 0.5 b 1 20 0 0 1").direction == dvec3(0, 0, 1));
  CHECK(only<OccludeEdit>("occlude a 0.5").at == 0.5);
  CHECK(only<CutEdit>("cut a 0.5 1").to == 1);
  CHECK(only<JoinEdit>("join a b").other == "b");
  CHECK(only<RenameEdit>("rename a \"b c\"").name == "b c");
  CHECK(only<KindEdit>("kind a portal").kind == VesselKind::portalVein);
  CHECK(only<DeleteEdit>("delete a tree").tree);
  CHECK(parseJournal("", "f.vedit")->empty());
}

TEST_CASE("an operation written as a line is read as the same") {
  const std::string lines =
      "radius \"v\" 0 0.5 x2 smooth\nstenosis \"v\" 0.1 12 70 0.5\nstenosis \"v\" 0.1 12.25 70\naneurysm \"v\" 0.1 12 70 front\n"
      "move \"v\" 0.5 1 -2 0.001 20\nstent \"v\" 0 1 2\ngraft \"a\" 0 \"b\" 1 2 \"via\" via 1 2 3 4 5 6\ngraft \"a\" 0 \"b\" 1 2\n"
      "branch \"a\" 0.5 \"b \\\"\\\\\" 1 20 0 0 1\nocclude \"a\" 0.5\ncut \"a\" 0.5 1\njoin \"a\" \"b\"\nrename \"a\" \"b c\"\n"
      "kind \"a\" artery\ndelete \"a\" tree\ndelete \"a\"\n";
  const auto edits = parseJournal(lines, "f.vedit");
  REQUIRE_MESSAGE(edits.ok(), edits.error().message);
  std::string again;
  for (const Edit& edit : *edits) again += journalLine(edit.operation) + "\n";
  CHECK(again == lines);
}

TEST_CASE("what is wrong in a journal is told with its line and how it is written") {
  CHECK(
      faultOf("\n\nshrink v 0.1") ==
      "f.vedit:3: 'shrink' is no operation; use one of radius, stenosis, aneurysm, move, stent, graft, branch, occlude, "
      "cut, join, rename, kind, delete");
  CHECK(faultOf("occlude \"v 0.1") ==
        "f.vedit:1: a name's closing quote is missing; names stand in double quotes");
  CHECK(faultOf("occlude \"v\tx\" 0.1") ==
        "f.vedit:1: a name holds a control character; names stand in double quotes");
  CHECK(faultOf("stenoss v 0.1 12 70") == "f.vedit:1: 'stenoss' is no operation; did you mean stenosis?");
  CHECK(faultOf("\"occlude\" v 0.1").find("is no operation") != std::string::npos);
  CHECK(faultOf("occlude v") == "f.vedit:1: occlude: s is missing; write occlude V s");
  CHECK(faultOf("occlude \"\" 1") == "f.vedit:1: occlude: V must not be empty; write occlude V s");
  CHECK(faultOf("occlude v 1.5") ==
        "f.vedit:1: occlude: s must be a number from 0 to 1, not '1.5'; write occlude V s");
  // Typographic quotes are none: a word processor makes them.
  for (const char* bare : {"left iliac artery", "\u201cleft iliac artery\u201d", "'left iliac artery'"})
    CHECK(
        faultOf(std::string("occlude ") + bare + " 0.5") ==
        "f.vedit:1: occlude: s must be a number from 0 to 1, not 'iliac'; write occlude V s, names of several "
        "words in double quotes");
  CHECK(faultOf("delete left iliac artery").ends_with("words in double quotes"));
  CHECK(faultOf("occlude v nan").find("not 'nan'") != std::string::npos);
  CHECK(faultOf("occlude v \"0.5\"").find("not \"0.5\"") != std::string::npos);
  CHECK(faultOf("occlude v 0.5 0.6") == "f.vedit:1: occlude: '0.6' is one word too many; write occlude V s");
  CHECK(
      faultOf("stenosis v 0.5 12 100") ==
      "f.vedit:1: stenosis: percent must be a number from 1 to 99, not '100'; write stenosis V s length_mm percent [eccentricity]");
  CHECK(faultOf("radius v 0.5 0.5 x2") ==
        "f.vedit:1: radius: s0 must be less than s1; write radius V s0 s1 xF [smooth]");
  CHECK(faultOf("move v 0.5 0 0 0").find("dx dy dz must not all be 0") != std::string::npos);
  CHECK(faultOf("move v 0.5 0 x 0").find("dy must be a number from -5000 to 5000, not 'x'") !=
        std::string::npos);
  CHECK(
      faultOf("kind v nerve") ==
      "f.vedit:1: kind: kind must be one of artery, vein, other, portal, lymphatic, not 'nerve'; write kind V "
      "artery|vein|other|portal|lymphatic");
  CHECK(faultOf("join a a").find("A and B must be two vessels") != std::string::npos);
  CHECK(faultOf("graft a 0 a 1 2").find("A and B must be two vessels") != std::string::npos);
  CHECK(faultOf("graft a 0 b 1 2 via 1 2").find("a coordinate is missing") != std::string::npos);
  CHECK(faultOf("aneurysm a 0 10 20 inside")
            .find("side must be one of left, right, front, back, up, down, not 'inside'") !=
        std::string::npos);
  CHECK(readJournal("/nowhere/x.vedit").error().fault == Fault::io);
}

TEST_CASE(
    "a journal may begin with a byte order mark and end its lines as any system does; UTF-16 is named") {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.vedit";
  for (const char* text :
       {"\xEF\xBB\xBFkind a vein\noccclude", "kind a vein\rcut a 0 1\r", "kind a vein\r\ncut a 0 1\r\n"}) {
    REQUIRE(writeFileAtomically(path, std::string(text)).ok());
    const auto edits = readJournal(path);
    if (std::string_view(text).ends_with("occclude"))
      CHECK(edits.error().message.find("a.vedit:2: 'occclude' is no operation") != std::string::npos);
    else
      CHECK(edits->size() == 2);
  }
  REQUIRE(writeFileAtomically(path, std::string("k\0i\0n\0d\0", 8)).ok());
  CHECK(readJournal(path).error().message.find("a.vedit: the text is UTF-16") != std::string::npos);
}

TEST_CASE("the grammar names every operation once") {
  const std::string grammar = journalGrammar();
  CHECK(grammar.find("graft A s B s radius_mm [name] [via x y z ...]\n") != std::string::npos);
  CHECK(grammar.find("aneurysm V s length_mm diameter_mm [left|right|front|back|up|down]\n") !=
        std::string::npos);
  CHECK(std::count(grammar.begin(), grammar.end(), '\n') == 13);
}
