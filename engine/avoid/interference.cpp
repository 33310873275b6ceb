#include "avoid/interference.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "collide/contact_search.h"
#include "core/parallel.h"

namespace vasa {
namespace {

constexpr float kNearAtRest = 0.005f;  // [m]
// By control points, at most; wider counts, too.
float farthestMoved(const Bezier& a, const Bezier& b) {
  float most = 0;
  for (int k = 0; k < 4; ++k)
    most = std::max(most, glm::distance(vec3(a.b[k]), vec3(b.b[k])) + std::abs(a.b[k].w - b.b[k].w));
  return most;
}

}  // namespace

Interference::Interference(const Network& network)
    : layout_(network), rest_(layout_.count()), tubes_(layout_.count()) {
  layout_.shape(network.points(), rest_);
  tubes_ = rest_;
  detector_ = std::make_unique<TubeDetector>(rest_, layout_.neighbours().exclusions());
  detector_->update(rest_, 0);
  if (!detector_->detect().empty())
    for (const Contact& contact : detector_->contacts())
      restPairs_.push_back({{contact.i, contact.j}, std::min(contact.f, 0.0f)});
}

std::vector<Contact> Interference::findNearAtRest() {
  std::vector<Contact> near;
  detector_->update(rest_, kNearAtRest);
  if (detector_->detect().empty()) return near;
  for (const Contact& contact : detector_->contacts())
    if (contact.f < rest_[contact.i].at(contact.s).w + rest_[contact.j].at(contact.t).w)
      near.push_back(contact);
  return near;
}

float Interference::allowed(TubePair pair) const {
  const auto found = std::lower_bound(restPairs_.begin(), restPairs_.end(), pair,
                                      [](const RestPair& a, TubePair b) { return a.tubes < b; });
  return found != restPairs_.end() && found->tubes == pair ? found->f : 0;
}

void Interference::gather(float margin) {
  places_.clear();
  for (const Contact& contact : near_)
    if (contact.f < margin) places_.push_back({contact, allowed({contact.i, contact.j})});
}

std::span<const Interference::Place> Interference::find(std::span<const vec4> points, float margin,
                                                        bool beginsToFollow) {
  layout_.shape(points, tubes_);
  const float within = beginsToFollow ? std::max(kFollowed, margin) : margin;
  detector_->update(tubes_, within);
  near_.clear();
  if (!detector_->detect().empty())
    for (const Contact& contact : detector_->contacts()) near_.push_back(contact);
  if (beginsToFollow)
    tubesThen_ = tubes_;
  else
    tubesThen_.clear();
  gather(margin);
  return places_;
}

std::span<const Interference::Place> Interference::follow(std::span<const vec4> points, float margin) {
  if (tubesThen_.empty()) return find(points, margin, true);
  lastTubes_.swap(tubes_);
  tubes_.resize(lastTubes_.size());
  layout_.shape(points, tubes_);
  moved_.resize(tubes_.size());
  std::atomic<bool> tooFar{false};
  parallelFor(tubes_.size(), 512, [&](std::size_t tube) {
    moved_[tube] = tubes_[tube].b != lastTubes_[tube].b;
    if (moved_[tube] && farthestMoved(tubes_[tube], tubesThen_[tube]) > 0.5f * (kFollowed - margin))
      tooFar.store(true, std::memory_order_relaxed);
  });
  if (tooFar) return find(points, margin, true);
  parallelFor(near_.size(), 64, [&](std::size_t k) {
    Contact& contact = near_[k];
    if (!moved_[contact.i] && !moved_[contact.j]) return;
    const auto [i, j] = std::pair{contact.i, contact.j};
    contact = nearestPlace(tubes_[i], tubes_[j]);
    contact.i = i, contact.j = j;
  });
  gather(margin);
  return places_;
}

}  // namespace vasa
