#include "avoid/interference.h"

#include <algorithm>
#include <iterator>

namespace vasa {
namespace {

constexpr float kNear = 0.005f;  // [m]

}  // namespace

Interference::Interference(const Network& network)
    : layout_(network), rest_(layout_.count()), tubes_(layout_.count()) {
  layout_.shape(network.points(), rest_);
  tubes_ = rest_;
  detector_ = std::make_unique<TubeDetector>(rest_, layout_.neighbours());
  detector_->update(rest_, 0);
  if (!detector_->detect().empty())
    for (const Contact& contact : detector_->contacts())
      restPairs_.push_back({{contact.i, contact.j}, std::min(contact.f, 0.0f)});
}

bool isNear(const Contact& at, std::span<const Bezier> tubes) {
  return at.f < std::min(tubes[at.i].at(at.s).w + tubes[at.j].at(at.t).w, kNear);
}

std::vector<Contact> Interference::findNearAtRest() {
  std::vector<Contact> near;
  detector_->update(rest_, kNear);
  if (detector_->detect().empty()) return near;
  std::ranges::copy_if(detector_->contacts(), std::back_inserter(near),
                       [&](const Contact& contact) { return isNear(contact, rest_); });
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
  if (detector_->detect().empty()) return places_;
  for (const Contact& contact : detector_->contacts())
    if (contact.f < margin) places_.push_back({contact, allowed({contact.i, contact.j})});
  return places_;
}

}  // namespace vasa
