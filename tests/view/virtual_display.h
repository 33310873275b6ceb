#pragma once
#include <sys/types.h>

#include <string>

namespace vasa::test {

/// An X server without a screen (Xvfb) for as long as the object lives. Fails the test case where it cannot
/// be started.
class VirtualDisplay {
 public:
  /// @param dpi  that it tells programs, as desktops do; 0: nothing, which is 96
  explicit VirtualDisplay(int dpi = 0);
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// For ProgramOptions::environment.
  std::string variable() const { return "DISPLAY=" + name_; }

 private:
  void tellDpi(int dpi) const;

  pid_t server_ = -1;
  std::string name_;
};

}  // namespace vasa::test
