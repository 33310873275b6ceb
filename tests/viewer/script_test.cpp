#include "viewer/script.h"

#include <doctest/doctest.h>

#include "support/shared_data.h"
#include "viewer/recording.h"

using namespace vasa;
using namespace vasa::viewer;

namespace {

std::vector<ScriptStep> parsed(const std::string& text) {
  auto steps = parseScript(text, "test.txt");
  REQUIRE_MESSAGE(steps, (steps ? "" : steps.error().message));
  return *steps;
}

std::string again(const std::string& text) {
  std::string lines;
  for (const ScriptStep& step : parsed(text)) lines += scriptLine(step) + "\n";
  return lines;
}

}  // namespace

TEST_CASE("a script is written as it was read") {
  const std::string text =
      "move 10.5 20\npress left\nrelease left\nscroll -2\nhold control\nlet control\nhold f12\nhold a\ntype é\nresize 800 600\n"
      "frames 3\nlive 2.5\nsettle\nwindow a b.png\npicture c.png\ndrop /x y.glb\nclose\n";
  CHECK(again(text) == text);
}

TEST_CASE("no name and no text of a recorded session becomes a line of its own") {
  for (const std::string& name :
       {std::string("a\nwindow /b.png"), std::string("\"quoted\""), std::string(" a "),
        std::string("back\\slash\r\n"), std::string("\x01\x7f"), std::string("plain \\ \xff.glb")}) {
    CAPTURE(name);
    const std::string line = scriptLine(InputEvent(FileDropped{name}));
    CHECK(line.find('\n') == std::string::npos);
    const auto steps = parsed(line + "\n");
    REQUIRE(steps.size() == 1);
    CHECK(std::get<FileDropped>(std::get<InputEvent>(steps[0])).path == name);
  }
  CHECK(scriptLine(InputEvent(TextTyped{'\n'})).empty());
  CHECK(scriptLine(InputEvent(TextTyped{0x9b})).empty());
  for (const char* wrong : {"drop \"open\n", "drop \"a\\n\"\n", "drop \"a\" b\"\n", "drop \"\\x1\"\n"})
    CHECK_FALSE(parseScript(wrong, "s.txt"));
}

TEST_CASE("what a script writes lies below one folder") {
  const test::TemporaryFolder folder;
  const auto out = folder.path() / "out";
  std::filesystem::create_directories(out / "inner");
  std::filesystem::create_directory_symlink(folder.path(), out / "way");
  std::filesystem::create_symlink(folder.path() / "elsewhere.png", out / "link.png");
  for (const std::string& name : {std::string("a.png"), std::string("inner/a.png"),
                                  std::string("inner/../b.png"), (out / "c.png").string()}) {
    CAPTURE(name);
    CHECK(placeBelow(out, name));
  }
  for (const std::string& name :
       {std::string("../a.png"), std::string("/tmp/a.png"), std::string("inner/../../a.png"),
        std::string("way/a.png"), std::string("link.png"), std::string("."),
        (folder.path() / "outer.png").string()}) {
    CAPTURE(name);
    const auto refused = placeBelow(out, name);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().fault == Fault::badInput);
    CHECK(refused.error().message.find("--out") != std::string::npos);
  }
}

TEST_CASE("comments, empty lines and short forms") {
  CHECK(parsed("# nothing\n\n   \n").empty());
  CHECK(again("key space\n") == "hold space\nlet space\n");
  CHECK(again("type  a\n") == "type  \ntype a\n");
}

TEST_CASE("what is wrong is told with its line") {
  const auto message = [](const std::string& text) {
    const auto steps = parseScript(text, "s.txt");
    REQUIRE_FALSE(steps);
    CHECK(steps.error().fault == Fault::badInput);
    return steps.error().message;
  };
  CHECK(message("frames 1\njump 3\n") == "s.txt:2: 'jump' is nothing a script can do; see vasa view --help");
  CHECK(message("move 3\n").find("move wants x and y") != std::string::npos);
  CHECK(message("press top\n").find("'top' is no button") != std::string::npos);
  CHECK(message("key f13\n").find("no key's name") != std::string::npos);
  CHECK(message("resize 0 4\n").find("width and height") != std::string::npos);
  CHECK(message("frames 2 3\n").find("'3' is too much") != std::string::npos);
  CHECK(message("window\n").find("wants a file") != std::string::npos);
  for (const char* verb : {"window", "picture"})
    CHECK(message(verb + std::string(" a.jpg\n")).find("end the name in .png") != std::string::npos);
}

TEST_CASE("a recorded session can be replayed: of moves in one frame the last, frames between") {
  ScriptRecorder recorder;
  recorder.endFrame();
  recorder.endFrame();
  recorder.add(PointerMoved{{1, 2}});
  recorder.add(PointerMoved{{3, 4}});
  recorder.add(ButtonChanged{Button::left, true});
  recorder.endFrame();
  recorder.add(ButtonChanged{Button::left, false});
  recorder.endFrame();
  CHECK(recorder.text() ==
        "# vasa view session\nframes 2\nmove 3 4\npress left\nframes 1\nrelease left\nframes 1\n");
  CHECK(parseScript(recorder.text(), "recorded"));
}
