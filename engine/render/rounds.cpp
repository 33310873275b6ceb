#include "render/rounds.h"

#include <algorithm>

namespace vasa {

bool Rounds::settle(const Filling& filling, const FillRange& vessels) {
  const shared::Filling state = filling.read();
  const std::uint32_t room = filling.room().blocks, wanted = state.blocks + state.blocks / 8;
  const double items = vessels.tubeEnd + vessels.forkEnd, done = double(state.firstTube) + state.firstFork;
  const bool whole = done == items;
  next_ =
      whole
          ? std::max({1u, state.rounds, (wanted + room - 1) / room})
          : std::uint32_t(std::min(items, std::max(next_ + 1.0, 1.25 * next_ * items / std::max(done, 1.0))));
  drawnTriangles_ = state.indices / 3;
  return whole;
}

}  // namespace vasa
