#include "surface/fork_item.h"

#include <cmath>

namespace vasa {
namespace {

constexpr float kWidestHole = 0.9f;    // sine of half its angle
constexpr float kHoleMargin = 1.1f;    // rows of the trunk stay outside the hole
constexpr float kBetweenHoles = 0.3f;  // [radians] around the host

// Branches that need the same room on different sides of the host become one fork.
void pairUp(std::vector<ForkItem>& items) {
  for (std::size_t i = 0; i + 1 < items.size(); ++i) {
    ForkItem& one = items[i];
    for (std::size_t k = i + 1; k < items.size() && one.branches.size() == 1; ++k) {
      ForkItem& other = items[k];
      if (other.branches.size() != 1) continue;
      if (other.room.centre - other.room.before >= one.room.centre + one.room.after) continue;
      const ForkLeaving &a = one.branches[0], &b = other.branches[0];
      if (std::abs(a.centre - b.centre) > 1.2f * std::min(a.hole, b.hole) + 0.8f * std::max(a.hole, b.hole))
        continue;
      const float apart = std::acos(std::clamp(glm::dot(a.direction, b.direction), -1.0f, 1.0f));
      if (apart < std::asin(a.around) + std::asin(b.around) + kBetweenHoles) continue;
      const float low = std::min(one.room.centre - one.room.before, other.room.centre - other.room.before);
      const float high = std::max(one.room.centre + one.room.after, other.room.centre + other.room.after);
      one.room.want += high - low - one.room.before - one.room.after;
      one.room.centre = (low + high) / 2;
      one.room.before = one.room.after = (high - low) / 2;
      one.shiftLimit = std::max(one.shiftLimit, other.shiftLimit);
      one.branches.push_back(b);
      items.erase(items.begin() + std::ptrdiff_t(k));
    }
  }
}

ForkItem joinItem(const VesselLine& line, const VesselLine::Join& join) {
  const vec4 before = line.point(join.at), after = line.point(join.at + join.gap);
  const float radius = std::max(before.w, after.w), probe = 1.5f * radius, middle = join.at + join.gap / 2;
  const vec3 in = vec3(before - line.point(join.at - probe)),
             out = vec3(line.point(join.at + join.gap + probe) - after);
  const float size = std::max(glm::length(in) * glm::length(out), 1e-20f);
  const float cosine = std::clamp(glm::dot(in, out) / size, -0.6f, 1.0f);
  const float bend = std::sqrt((1 - cosine) / (1 + cosine));  // tan of half the angle
  const vec3 course = in + out;
  const float overlap =  // of one that begins before the other ends
      std::max(-glm::dot(vec3(after - before), course) / std::max(glm::length(course), 1e-12f), 0.0f);
  ForkItem item;
  item.radius = radius;
  item.room.centre = middle;
  item.room.before = item.room.after = kBesideJoin * radius + (join.gap + overlap) / 2;
  item.room.want = item.room.before + radius * (2 + bend) + std::abs(before.w - after.w);
  item.mustLow = join.at;
  item.mustHigh = join.at + join.gap;
  return item;
}

// The branch's fork covers the join, too, and somewhat more, so that it may move.
void take(ForkItem& branch, const ForkItem& join) {
  const float beside = join.room.before + 0.35f * join.radius;
  branch.room.before = std::max(branch.room.before, branch.room.centre - join.room.centre + beside);
  branch.room.after = std::max(branch.room.after, join.room.centre - branch.room.centre + beside);
  branch.mustLow = std::min(branch.mustLow, join.mustLow);
  branch.mustHigh = std::max(branch.mustHigh, join.mustHigh);
}

const ForkItem* nearestBranch(std::span<const ForkItem> items, std::size_t to) {
  const ForkItem* nearest = nullptr;
  for (const ForkItem& item : items)
    if (item.branch() && (!nearest || std::abs(item.room.centre - items[to].room.centre) <
                                          std::abs(nearest->room.centre - items[to].room.centre)))
      nearest = &item;
  return nearest;
}

}  // namespace

ForkItem branchItem(const VesselLine& host, const VesselLine& branch, std::uint32_t end, const ForkExit& exit,
                    float fillet) {
  const float trunk = host.point(exit.foot).w;
  const float stretched = 1 / std::sqrt(std::max(1 - exit.lean * exit.lean, 1.0f / 9));
  ForkLeaving leaving;
  leaving.child = end;
  leaving.exit = exit;
  leaving.centre = exit.foot;
  leaving.radius = exit.radius;
  // Without a fillet wall and branch meet in about an ellipse. In a narrow angle that ends before the
  // branch is clear.
  const float radius = std::min(exit.radius, 1.3f * trunk);
  const float corner = std::clamp(std::abs(exit.ringFoot - exit.foot), radius, radius * stretched);
  leaving.hole = corner + fillet * (0.5f * radius + 0.5f * corner);
  leaving.around = std::min(exit.radius * (1 + fillet) / trunk, kWidestHole);
  leaving.cornerAlong = corner / leaving.hole;
  leaving.cornerAround = 1 / (1 + fillet);
  const vec3 axis = host.tangent(exit.foot);
  const vec3 out =
      vec3(branch.point(end % 2 ? branch.length() - exit.cross : exit.cross) - host.point(exit.foot));
  const vec3 level = out - glm::dot(out, axis) * axis;
  leaving.direction = level / std::max(glm::length(level), 1e-12f);
  ForkItem item;
  item.branches = {leaving};
  item.radius = exit.radius;
  item.room.centre = exit.foot;
  item.room.before = item.room.after = kHoleMargin * leaving.hole + 0.08f * trunk;
  item.room.want = (kHoleMargin + 0.2f) * leaving.hole + 0.35f * trunk;
  item.shiftLimit = 2.6f * leaving.hole + 2 * trunk;
  return item;
}

std::vector<ForkItem> arrangedItems(const VesselLine& line, std::vector<ForkItem> items, float low,
                                    float high) {
  const auto byCentre = [](const ForkItem& a, const ForkItem& b) {
    if (a.room.centre != b.room.centre || !a.branch() || !b.branch()) return a.room.centre < b.room.centre;
    return a.branches[0].child < b.branches[0].child;
  };
  std::sort(items.begin(), items.end(), byCentre);
  pairUp(items);
  std::vector<ForkItem> joins;
  for (const VesselLine::Join& join : line.joins()) {
    if (join.at <= low || join.at + join.gap >= high) continue;
    ForkItem item = joinItem(line, join);
    ForkItem* nearest = nullptr;
    for (ForkItem& branch : items) {
      const float apart = std::abs(branch.room.centre - item.room.centre);
      if (apart < branch.room.before + 1.5f * item.room.before + 0.5f * item.radius &&
          (!nearest || apart < std::abs(nearest->room.centre - item.room.centre)))
        nearest = &branch;
    }
    if (nearest)
      take(*nearest, item);
    else
      joins.push_back(item);
  }
  items.insert(items.end(), joins.begin(), joins.end());
  std::sort(items.begin(), items.end(), byCentre);
  return items;
}

const ForkItem* withoutRoom(std::span<const ForkItem> items, std::vector<ForkRoom>& rooms, float low,
                            float high, float sliver) {
  for (const ForkItem& item : items) rooms.push_back(item.room);
  const ForkItem* worst = nullptr;
  if (!shareRoom(rooms, low, high, sliver)) {
    for (const ForkItem& item : items)
      if (item.branch() && (!worst || item.thinnest().radius < worst->thinnest().radius)) worst = &item;
    return worst;
  }
  float excess = 1;
  for (std::size_t i = 0; i < items.size(); ++i) {
    // A join that a fork pushes off its place: the nearest branch gives way.
    if (items[i].mustLow <= rooms[i].low || items[i].mustHigh >= rooms[i].high)
      return items[i].branch() ? &items[i] : nearestBranch(items, i);
    const float share = items[i].branch() ? std::abs(rooms[i].shift) / items[i].shiftLimit : 0;
    if (share > excess) excess = share, worst = &items[i];
  }
  return worst;
}

}  // namespace vasa
