#include "avoid/certificate.h"

#include <algorithm>

namespace vasa {

Certificate certificateOf(std::span<const Interference::Place> places,
                          std::vector<Interference::Place>* interfering) {
  Certificate certificate;
  if (interfering) interfering->clear();
  for (const Interference::Place& place : places) {
    if (!place.interferes()) {
      certificate.restContacts += place.contact.f < 0;
      continue;
    }
    ++certificate.contacts;
    certificate.depth = std::max(certificate.depth, place.excess());
    if (interfering) interfering->push_back(place);
  }
  return certificate;
}

}  // namespace vasa
