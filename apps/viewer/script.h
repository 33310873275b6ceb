#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "viewer/input.h"

// Sessions as text: what a person did, one thing a line, so that it can be done again.
//   move X Y            the pointer, in pixels
//   press BUTTON        left, middle or right; then `release BUTTON`
//   scroll STEPS        the wheel
//   key NAME            pressed and released; `hold NAME` and `let NAME` for one of both
//   type TEXT           text, to the end of the line
//   resize W H          the window, in pixels
//   drop FILE           a file on the window; the script goes on if it cannot be opened, and fails at its end
//   frames N            so many pictures pass, each a thirtieth of a second after the one before
//   live SECONDS        so long by the clock, as a person has it: shapes are not waited for
//   settle              until loading, shapes and the still picture are done
//   window FILE.png     writes the window's picture, panels and all
//   picture FILE.png    writes the scene's picture alone, once there is one
//   close
// A FILE may stand in double quotes (viewer/quoted.h). What a script writes lies below the folder of
// ViewOptions::out.
// `#` begins a comment. The session ends with its last line.
namespace vasa::viewer {

struct LetFrames {
  std::uint32_t count = 1;
};
struct GoLive {
  double seconds = 1;
};
struct Settle {};
struct ResizeWindow {
  std::uint32_t width = 0, height = 0;
};
struct SavePicture {
  std::filesystem::path path;
  bool panels = false;
};
using ScriptStep = std::variant<InputEvent, LetFrames, GoLive, Settle, ResizeWindow, SavePicture>;

/// badInput names the line and what is wrong with it. @param name  for messages
Result<std::vector<ScriptStep>> parseScript(const std::string& text, const std::string& name);

/// The line that parseScript() reads as this step; empty where there is none (a key without a name).
std::string scriptLine(const ScriptStep& step);

/// Writes down what happens.
class ScriptRecorder {
 public:
  void add(const InputEvent& event);
  void endFrame() { ++frames_; }
  /// The session so far.
  std::string text() const;

 private:
  void flush();
  std::string text_;
  std::optional<InputEvent> moved_;  // PointerMoved, of several in a frame the last
  std::uint32_t frames_ = 0;
};

}  // namespace vasa::viewer
