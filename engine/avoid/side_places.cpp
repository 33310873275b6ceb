#include "avoid/side_places.h"

namespace vasa {

std::array<SidePlace, kSidePlaces> sidePlaces(const Contact& nearest, std::span<const Bezier> tubes) {
  std::array<SidePlace, kSidePlaces> places{{{nearest.s, nearest.t}}};
  for (std::size_t k = 1; k < kSidePlaces; ++k) {
    const float s = float(k - 1) / float(kSidePlaces - 2);
    places[k] = {s, tubes[nearest.j].nearest(vec3(tubes[nearest.i].at(s)))};
  }
  return places;
}

}  // namespace vasa
