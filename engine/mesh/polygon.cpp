#include "mesh/polygon.h"

// An ear is a corner that turns outward and whose triangle holds no corner that turns inward. Cutting one
// changes only its two neighbours, so each corner is looked at three times at most.
namespace vasa {
namespace {

using glm::dvec2;

// Newell's: twice the area, along the normal.
dvec3 areaOf(std::span<const vec3> corners) {
  dvec3 sum(0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dvec3 a = dvec3(corners[i]) - dvec3(corners[0]),
                b = dvec3(corners[(i + 1) % corners.size()]) - dvec3(corners[0]);
    sum += glm::cross(a, b);
  }
  return sum;
}

double turn(dvec2 a, dvec2 b, dvec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

class Clipper {
 public:
  explicit Clipper(std::span<const vec3> corners) : count_(std::uint32_t(corners.size())) {
    const dvec3 area = areaOf(corners), size = glm::abs(area);
    const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const int u = (drop + 1) % 3, v = (drop + 2) % 3;
    for (std::uint32_t i = 0; i < count_; ++i) {
      const dvec3 p = dvec3(corners[i]) - dvec3(corners[0]);
      at_.push_back(area[drop] < 0 ? dvec2(p[v], p[u]) : dvec2(p[u], p[v]));
      before_.push_back((i + count_ - 1) % count_);
      after_.push_back((i + 1) % count_);
    }
    inward_.resize(count_);
    gone_.resize(count_);
    for (std::uint32_t i = 0; i < count_; ++i)
      if (look(i)) turned_.push_back(i);
  }

  void run(std::vector<uvec3>& triangles) {
    std::uint32_t left = count_, any = 0;
    for (refill(); left > 3; --left) {
      const std::uint32_t ear = nextEar(any), a = before_[ear], c = after_[ear];
      triangles.emplace_back(a, ear, c);
      gone_[ear] = 1, inward_[ear] = 0;
      after_[a] = c, before_[c] = a;
      any = c;
      for (const std::uint32_t i : {c, a}) {
        look(i);
        if (isEar(i)) ears_.push_back(i);
      }
    }
    triangles.emplace_back(before_[any], any, after_[any]);
  }

 private:
  void refill() {
    for (std::uint32_t i = count_; i-- > 0;)
      if (!gone_[i] && isEar(i)) ears_.push_back(i);
  }
  // Cutting one ear may free another elsewhere, which a few looks at all corners find. Where nothing is an
  // ear, a corner is cut off all the same.
  std::uint32_t nextEar(std::uint32_t otherwise) {
    while (true) {
      while (!ears_.empty()) {
        const std::uint32_t ear = ears_.back();
        ears_.pop_back();
        if (!gone_[ear] && isEar(ear)) return ear;
      }
      if (refills_++ >= kMostRefills) return otherwise;
      refill();
    }
  }
  bool look(std::uint32_t i) {
    inward_[i] = turn(at_[before_[i]], at_[i], at_[after_[i]]) < 0;
    return inward_[i];
  }
  bool isEar(std::uint32_t i) const {
    if (inward_[i]) return false;
    const dvec2 a = at_[before_[i]], b = at_[i], c = at_[after_[i]];
    for (const std::uint32_t k : turned_) {
      if (!inward_[k] || k == before_[i] || k == after_[i]) continue;
      const dvec2 p = at_[k];
      if (p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  std::uint32_t count_;
  std::vector<dvec2> at_;
  std::vector<std::uint32_t> before_, after_, turned_, ears_;
  std::vector<char> inward_, gone_;
  static constexpr int kMostRefills = 4;
  int refills_ = 0;
};

}  // namespace

void cutPolygon(std::span<const vec3> corners, std::vector<uvec3>& triangles) {
  if (corners.size() == 3) return triangles.emplace_back(0, 1, 2), void();
  if (corners.size() > 4) return Clipper(corners).run(triangles);
  const vec3 even = corners[2] - corners[0], odd = corners[3] - corners[1];
  if (glm::dot(even, even) < glm::dot(odd, odd))
    triangles.insert(triangles.end(), {{0, 1, 2}, {0, 2, 3}});
  else
    triangles.insert(triangles.end(), {{0, 1, 3}, {1, 2, 3}});
}

}  // namespace vasa
