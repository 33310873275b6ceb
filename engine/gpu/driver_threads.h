#pragma once
#include <array>
#include <vector>

namespace vasa::gpu {

/// The worker threads that a CPU device's driver (Mesa's lavapipe) makes when its Vulkan device is made, kept
/// on one processor each. Left alone, Linux often wakes all of them where the thread ran that gave them work,
/// and they take turns there while other processors idle: a sixth of a frame on two. Does nothing for other
/// drivers, elsewhere than on Linux, or with one processor.
class DriverThreads {
 public:
  /// Notes the threads that are there already. While this lives the calling thread has another name, which
  /// threads that it makes begin with: so they are told from those that other threads make meanwhile.
  DriverThreads();
  ~DriverThreads();
  DriverThreads(const DriverThreads&) = delete;
  DriverThreads& operator=(const DriverThreads&) = delete;
  /// Those made since. Call after the device was made; waits up to 20 ms until they can be told apart.
  void spread() const;

 private:
  std::vector<int> made() const;

  std::vector<int> before_;  // sorted
  std::array<char, 16> name_{};
};

}  // namespace vasa::gpu
