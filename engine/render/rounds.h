#pragma once
#include "render/filling.h"

namespace vasa {

/// How many rounds of tubes and forks a frame gets: how many it takes is seen once it is done, so as many as
/// the last one took, with an eighth to spare; and more where they did not do, for the frame to be drawn once
/// more. Rounds do not show in the picture.
class Rounds {
 public:
  std::uint32_t next() const { return next_; }
  /// Of the latest frame, those that may be seen.
  std::uint64_t drawnTriangles() const { return drawnTriangles_; }

  /// After a frame of next() rounds. @param filling  where its last round ended
  /// @return whether they did for all of its vessels
  bool settle(const Filling& filling, const FillRange& vessels);
  /// After a frame without vessels.
  void settleWithout() { drawnTriangles_ = 0; }

 private:
  // Before it is known what pictures need: a whole body's at four samples a pixel; one that holds nothing
  // costs next to nothing.
  static constexpr std::uint32_t kFirst = 4;
  std::uint32_t next_ = kFirst;
  std::uint64_t drawnTriangles_ = 0;
};

}  // namespace vasa
