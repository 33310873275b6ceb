#include "avoid/interference.h"

#include <algorithm>

#include "collide/closest_tubes.h"

namespace vasa {
namespace {

constexpr float kNearAtRest = 0.005f;  // [m]
constexpr double kExact = 1e-8;         // [m]

// Newton steps from the nearest chords may end in another local minimum than the one for which the pair was reported.
Contact deepest(const Contact& contact, std::span<const Bezier> tubes, float margin = 0) {
  if (contact.f < margin) return contact;
  Contact found = closestOfTubes(tubes[contact.i], tubes[contact.j], kExact);
  found.i = contact.i, found.j = contact.j;
  return found;
}

}  // namespace

Interference::Interference(const Network& network) : layout_(network), rest_(layout_.count()), tubes_(layout_.count()) {
  layout_.shape(network.points(), rest_);
  tubes_ = rest_;
  detector_ = std::make_unique<TubeDetector>(rest_, layout_.neighbours().exclusions());
  detector_->update(rest_, 0);
  if (!detector_->detect().empty())
    for (const Contact& contact : detector_->contacts())
      restPairs_.push_back({{contact.i, contact.j}, std::min(deepest(contact, rest_).f, 0.0f)});
}

std::vector<Contact> Interference::findNearAtRest() {
  std::vector<Contact> near;
  detector_->update(rest_, kNearAtRest);
  if (detector_->detect().empty()) return near;
  for (const Contact& contact : detector_->contacts())
    if (contact.f < rest_[contact.i].at(contact.s).w + rest_[contact.j].at(contact.t).w) near.push_back(contact);
  return near;
}

float Interference::allowed(TubePair pair) const {
  const auto found = std::lower_bound(restPairs_.begin(), restPairs_.end(), pair,
                                      [](const RestPair& a, TubePair b) { return a.tubes < b; });
  return found != restPairs_.end() && found->tubes == pair ? found->f : 0;
}

std::span<const Interference::Place> Interference::find(std::span<const vec4> points, float margin) {
  layout_.shape(points, tubes_);
  detector_->update(tubes_, margin);
  places_.clear();
  if (!detector_->detect().empty())
    for (const Contact& contact : detector_->contacts())
      places_.push_back({deepest(contact, tubes_, margin), allowed({contact.i, contact.j})});
  return places_;
}

}  // namespace vasa
