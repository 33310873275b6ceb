#pragma once
#include <sys/types.h>

#include <string>

namespace vasa::test {

/// An X server without a screen (Xvfb) for as long as the object lives. Fails the test case where it cannot be started.
class VirtualDisplay {
 public:
  /// @param dpi  of the screen that it stands for; 96 is ordinary
  explicit VirtualDisplay(int dpi = 96);
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// For ProgramOptions::environment.
  std::string variable() const { return "DISPLAY=" + name_; }

 private:
  pid_t server_ = -1;
  std::string name_;
};

}  // namespace vasa::test
