#pragma once
#include <vector>

#include "viewer/layout.h"

struct ImDrawData;
struct ImDrawList;

namespace vasa::viewer {

/// Which of Dear ImGui's windows have to be drawn over a canvas that still shows the ones before. On a CPU
/// the panels cost more than what moves in them: 5 ms of a picture's 33 at 1280x720, where next to nothing of
/// them changes.
class UiChanges {
 public:
  /// The canvas is new: everything has to be drawn.
  void forget() { drawn_.clear(); }

  /// Leaves out of `panels` what the canvas shows already. Windows that lie over each other are drawn
  /// together, so that what is translucent has below it what it had. @param overwritten  where something else
  /// has been put on the canvas
  void keepChanged(ImDrawData& panels, const Rect& overwritten);

 private:
  /// A window as it was drawn.
  struct Drawn {
    Rect box;
    std::vector<unsigned char> bytes;  ///< corners, indices and commands
  };
  static Drawn drawnAs(const ImDrawList& list);

  std::vector<Drawn> drawn_;
  std::vector<ImDrawList*> kept_;
};

}  // namespace vasa::viewer
