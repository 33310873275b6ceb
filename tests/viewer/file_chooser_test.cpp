#include "viewer/file_chooser.h"

#include <doctest/doctest.h>

#include <fstream>

#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::viewer;

namespace {

struct Shelf {
  test::TemporaryFolder folder;
  FileChooser files;

  Shelf() {
    std::filesystem::create_directories(path("scans/old"));
    for (const char* name : {"arm.json", "Arteries.vasa", "notes.txt", ".hidden.json", "scans/leg.GLB"})
      std::ofstream(path(name)) << "12345";
  }
  std::filesystem::path path(const std::string& name) const { return folder.path() / name; }
  void open() { files.start(FilePurpose::open, folder.path(), "", {".json", ".vasa", ".glb"}); }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const FileRow& row : files.rows()) all.push_back(row.name);
    return all;
  }
  std::optional<std::filesystem::path> type(const std::string& text) {
    files.typed = text;
    files.typing();
    return files.enter();
  }
};

}  // namespace

TEST_CASE("a folder's lines: the way up, folders, then the files that can be opened") {
  Shelf shelf;
  shelf.open();
  CHECK(shelf.names() == std::vector<std::string>{"..", "scans", "arm.json", "Arteries.vasa"});
  CHECK(shelf.files.rows()[2].bytes == 5);
  shelf.files.showAllFiles(true);
  CHECK(shelf.names() == std::vector<std::string>{"..", "scans", "arm.json", "Arteries.vasa", "notes.txt"});
  CHECK(rowsOfFolder(shelf.path("none"), {}).error().fault == Fault::io);
}

TEST_CASE("lines are stepped through and entered; a typed name or path goes where it says") {
  Shelf shelf;
  shelf.open();
  CHECK_FALSE(shelf.files.enter());  // nothing is marked or typed
  shelf.files.step(1);
  shelf.files.step(1);
  CHECK_FALSE(shelf.files.enter());
  CHECK(shelf.files.folder() == shelf.path("scans"));
  CHECK(shelf.names() == std::vector<std::string>{"..", "old", "leg.GLB"});
  shelf.files.step(-1);
  CHECK(shelf.files.enter() == shelf.path("scans/leg.GLB"));
  CHECK_FALSE(shelf.files.isOpen());

  shelf.open();
  CHECK_FALSE(shelf.type("scans/"));
  CHECK(shelf.files.folder() == shelf.path("scans"));
  CHECK(shelf.files.typed.empty());
  CHECK_FALSE(shelf.type(".."));
  CHECK(shelf.files.folder() == shelf.folder.path());
  CHECK_FALSE(shelf.type("nowhere.json"));
  CHECK(shelf.files.message().find("there is no such file") != std::string::npos);
  CHECK(shelf.type(shelf.path("scans/leg.GLB").string()) == shelf.path("scans/leg.GLB"));

  shelf.open();
  CHECK(shelf.type("ART") == shelf.path("Arteries.vasa"));  // the first that begins so
}

TEST_CASE("Tab completes as far as lines agree") {
  Shelf shelf;
  shelf.open();
  const std::pair<std::string, std::string> cases[] = {{"a", "a"},  // arm, Arteries
                                                       {"art", "Arteries.vasa"},
                                                       {"sc", "scans/"},
                                                       {"x", "x"}};
  for (const auto& [typed, completed] : cases) {
    shelf.files.typed = typed;
    CHECK(shelf.files.completed() == completed);
  }
}

TEST_CASE("what is saved gets an extension; what is there is replaced at the second asking") {
  Shelf shelf;
  shelf.files.start(FilePurpose::saveScene, shelf.folder.path(), "new", {".json"});
  CHECK(shelf.files.typed == "new");
  CHECK(shelf.files.enter() == shelf.path("new.json"));

  shelf.files.start(FilePurpose::saveScene, shelf.folder.path(), "arm.json", {".json"});
  CHECK_FALSE(shelf.files.enter());
  CHECK(shelf.files.message().find("there already") != std::string::npos);
  CHECK(shelf.files.isOpen());
  CHECK_FALSE(shelf.type("scans/none/x"));
  CHECK(shelf.files.message().find("no such folder") != std::string::npos);
  CHECK_FALSE(shelf.type("arm"));  // asked anew
  CHECK(shelf.files.enter() == shelf.path("arm.json"));
  shelf.files.start(FilePurpose::saveScene, shelf.folder.path(), "v1.2", {".json"});
  CHECK(shelf.files.enter() == shelf.path("v1.2.json"));
  shelf.files.start(FilePurpose::exportFile, shelf.folder.path(), "walk.mp4", {".glb", ".mp4"});
  CHECK(shelf.files.enter() == shelf.path("walk.mp4"));
}

TEST_CASE("several files are opened together: by Ctrl, by Shift, by Shift and arrow keys") {
  Shelf shelf;
  std::ofstream(shelf.path("body.glb")) << "1";
  shelf.open();  // .. scans arm.json Arteries.vasa body.glb
  shelf.files.mark(2);
  shelf.files.toggle(4);
  CHECK(shelf.files.count() == 2);
  CHECK(shelf.files.isTaken(2));
  shelf.files.toggle(3);
  shelf.files.toggle(4);  // out again
  CHECK(shelf.files.count() == 2);
  auto file = shelf.files.enter();
  REQUIRE(file);
  auto all = shelf.files.withOthers(*file);
  std::ranges::sort(all);
  CHECK(all == std::vector{shelf.path("Arteries.vasa"), shelf.path("arm.json")});
  CHECK_FALSE(shelf.files.isOpen());

  shelf.open();
  shelf.files.mark(4);
  shelf.files.extend(2);
  CHECK(shelf.files.count() == 3);
  shelf.files.mark(3);  // one alone again
  CHECK(shelf.files.count() == 1);
  shelf.files.extendStep(1);
  file = shelf.files.enter();
  REQUIRE(file);
  CHECK(shelf.files.withOthers(*file) == std::vector{shelf.path("body.glb"), shelf.path("Arteries.vasa")});

  shelf.open();
  shelf.files.mark(2);
  shelf.files.toggle(1);  // a folder is gone into, and not taken in
  CHECK(shelf.files.count() == 1);
  CHECK_FALSE(shelf.files.enter());
  CHECK(shelf.files.folder() == shelf.path("scans"));
}
