#include "avoid/interference.h"

#include <algorithm>

#include "collide/closest_tubes.h"
#include "core/parallel.h"

namespace vasa {
namespace {

// [m] Neighbours whose nearest points that count lie on the limit of what counts cost ever more the finer the question.
constexpr double kTolerance = 1e-5;

}  // namespace

Interference::Interference(const Network& network) : layout_(network), rest_(layout_.count()), tubes_(layout_.count()) {
  layout_.shape(network.points(), rest_);
  const Neighbours& neighbours = layout_.neighbours();
  detector_ = std::make_unique<TubeDetector>(rest_, neighbours.exclusions());
  tubes_ = rest_;
  const auto overlapping = intersectingNeighbours(rest_, neighbours, kTolerance);
  restNeighbours_ = overlapping.size();
  meets_.resize(watched_.size());
  search(0, Watch::allNeighbours);
  for (const Place& place : places_) restPairs_.push_back({{place.contact.i, place.contact.j}, place.contact.f});
}

float Interference::allowed(TubePair pair) const {
  const auto found = std::lower_bound(restPairs_.begin(), restPairs_.end(), pair,
                                      [](const RestPair& a, TubePair b) { return a.tubes < b; });
  return found != restPairs_.end() && found->tubes == pair ? found->f : 0;
}

std::span<const Interference::Place> Interference::find(std::span<const vec4> points, float margin, Watch which) {
  layout_.shape(points, tubes_);
  search(margin, which);
  for (Place& place : places_) place.allowed = allowed({place.contact.i, place.contact.j});
  return places_;
}

void Interference::search(float margin, Watch which) {
  detector_->update(tubes_, margin);
  const std::span<const TubePair> strangers = detector_->detect();
  places_.clear();
  if (!strangers.empty())
    for (const Contact& contact : detector_->contacts()) places_.push_back({contact, 0, false});
  searchNeighbours(margin, which);
  std::inplace_merge(places_.begin(), places_.begin() + std::ptrdiff_t(strangers.size()), places_.end(),
                     [](const Place& a, const Place& b) {
                       return TubePair{a.contact.i, a.contact.j} < TubePair{b.contact.i, b.contact.j};
                     });
}

void Interference::searchNeighbours(float margin, Watch which) {
  const Neighbours& neighbours = layout_.neighbours();
  const auto look = [&](std::size_t k) {
    const NeighbourPair& pair = watched_[k];
    const Bezier &a = tubes_[pair.tubes.i], &b = tubes_[pair.tubes.j];
    meets_[k] = !neighboursRunOn(a, b, neighbours, pair, margin) &&
                neighboursIntersect(a, b, neighbours, pair, kTolerance, margin);
  };
  if (which == Watch::allNeighbours) {
    parallelFor(watched_.size(), 256, look);
    met_.clear();
    for (std::uint32_t k = 0; k < watched_.size(); ++k)
      if (meets_[k]) met_.push_back(k);
  } else {
    parallelFor(met_.size(), 16, [&](std::size_t k) { look(met_[k]); });
  }
  const std::size_t first = places_.size();
  for (const std::uint32_t k : met_)
    if (meets_[k]) places_.push_back({{watched_[k].tubes.i, watched_[k].tubes.j}, 0, true});
  parallelFor(places_.size() - first, 4, [&](std::size_t k) {
    Contact& contact = places_[first + k].contact;
    const TubePair pair{contact.i, contact.j};
    contact = closestOfNeighbours(tubes_[pair.i], tubes_[pair.j], neighbours, *neighbours.find(pair), kTolerance);
    contact.i = pair.i;
    contact.j = pair.j;
  });
}

}  // namespace vasa
