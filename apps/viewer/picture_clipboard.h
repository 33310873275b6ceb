#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace vasa::viewer {

/// Offers a picture to other programs on X11's clipboard, which GLFW offers text alone: to those that paste
/// pictures as image/png, to those that paste text by its file's name. It is there until something else is
/// copied or the object goes. A connection and a thread of its own answer, so that nothing waits for the
/// app's next picture.
class PictureClipboard {
 public:
  PictureClipboard();
  PictureClipboard(const PictureClipboard&) = delete;
  PictureClipboard& operator=(const PictureClipboard&) = delete;
  ~PictureClipboard();

  /// In place of what was offered before. @return  false where there is no X server, or it takes nothing
  bool offer(std::vector<std::byte> png, std::string name);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vasa::viewer
