#include "avoid/certificate.h"

#include <algorithm>

namespace vasa {

Certificate certify(Interference& interference, std::span<const vec4> points,
                    std::vector<Interference::Place>* interfering) {
  Certificate certificate;
  if (interfering) interfering->clear();
  for (const Interference::Place& place : interference.find(points, 0)) {
    if (!place.interferes()) {
      ++certificate.restContacts;
      continue;
    }
    ++certificate.contacts;
    certificate.depth = std::max(certificate.depth, place.excess());
    if (interfering) interfering->push_back(place);
  }
  return certificate;
}

}  // namespace vasa
