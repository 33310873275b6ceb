#include "convert/reslice.h"

#include <algorithm>
#include <cmath>

namespace vasa {
namespace {

constexpr float kSpacing = 0.6f;       // of sections, in radii
constexpr float kTangentReach = 1.0f;  // a tangent is the chord over so many radii to both sides
constexpr int kMostEndCuts = 200;
constexpr float kEndPrecision = 0.04f;  // of where the surface ends, in radii
constexpr float kSliceReach = 3.0f;     // triangles considered around a centre, in radii

float centreDistance(const vec4& a, const vec4& b) { return glm::distance(vec3(a), vec3(b)); }

// A polyline by its arc length.
class ArcLength {
 public:
  explicit ArcLength(const std::vector<vec4>& points) : points_(points), at_(points.size(), 0) {
    for (std::size_t i = 1; i < points.size(); ++i)
      at_[i] = at_[i - 1] + centreDistance(points[i], points[i - 1]);
  }
  float length() const { return at_.back(); }
  vec4 operator()(float s) const {
    const auto upper = std::upper_bound(at_.begin(), at_.end(), s);
    if (upper == at_.begin()) return points_.front();
    if (upper == at_.end()) return points_.back();
    const auto i = std::size_t(upper - at_.begin());
    const float gap = at_[i] - at_[i - 1];
    return glm::mix(points_[i - 1], points_[i], gap > 0 ? (s - at_[i - 1]) / gap : 0.0f);
  }
  vec3 tangent(float s, float reach) const {
    const vec3 chord =
        vec3((*this)(std::min(s + reach, length()))) - vec3((*this)(std::max(s - reach, 0.0f)));
    const float l = glm::length(chord);
    return l > 0 ? chord / l : vec3(0, 0, 1);
  }

 private:
  const std::vector<vec4>& points_;
  std::vector<float> at_;
};

float medianRadius(const std::vector<vec4>& sections, std::size_t i, std::size_t reach) {
  std::vector<float> radii;
  for (std::size_t k = i > reach ? i - reach : 0; k < std::min(sections.size(), i + reach + 1); ++k)
    radii.push_back(sections[k].w);
  std::nth_element(radii.begin(), radii.begin() + std::ptrdiff_t(radii.size() / 2), radii.end());
  return radii[radii.size() / 2];
}

// Leaves out sections that disagree with their neighbours or turn back. Where the second in a row turns back,
// the one before them was wrong.
std::vector<vec4> consistent(const std::vector<vec4>& sections) {
  std::vector<vec4> kept;
  int turned = 0;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const float median = medianRadius(sections, i, 4);
    if (sections[i].w > 1.5f * median || sections[i].w < 0.55f * median) continue;
    if (!kept.empty() && centreDistance(sections[i], kept.back()) < 0.1f * median) continue;
    const bool turns = kept.size() > 1 && glm::dot(vec3(sections[i]) - vec3(kept.back()),
                                                   vec3(kept.back()) - vec3(kept[kept.size() - 2])) < 0;
    if (turns && ++turned < 2) continue;
    if (turns) kept.pop_back();
    turned = 0;
    kept.push_back(sections[i]);
  }
  return kept;
}

std::vector<vec4> slicePass(Slicer& slicer, const std::vector<vec4>& axis, float leastSpacing) {
  const ArcLength curve(axis);
  const float length = curve.length();
  std::vector<vec4> sections;
  if (!(length > 0)) return sections;
  for (float s = 0; sections.size() < 100000;) {
    const vec4 at = curve(s);
    const vec3 tangent = curve.tangent(s, kTangentReach * at.w);
    if (const auto shape = slicer.section(vec3(at), tangent, kSliceReach * at.w))
      if (glm::distance(shape->centre, vec3(at)) < std::max(at.w, shape->radius))
        sections.push_back(vec4(shape->centre, shape->radius));
    if (s >= length) break;
    // The last step ends at the end, without a sliver before it.
    const float step = std::max({kSpacing * at.w, leastSpacing, length * 1e-4f});
    s = s + 1.5f * step > length ? length : s + step;
  }
  return consistent(sections);
}

// Unit direction in which a polyline ends: its chord over the last `reach`.
vec3 endDirection(const std::vector<vec4>& sections, float reach) {
  std::size_t i = sections.size() - 1;
  while (i > 0 && centreDistance(sections[i], sections.back()) < reach) --i;
  const vec3 chord = vec3(sections.back()) - vec3(sections[i]);
  const float length = glm::length(chord);
  return length > 0 ? chord / length : vec3(0, 0, 1);
}

// A flat end that is not quite at right angles to the axis cuts the slices off on one side. The axis meets
// the end where half the area is left: how far that is beyond the last whole section.
float cutBeyond(Slicer& slicer, const vec4& last, vec3 direction, float reach) {
  float low = 0, high = 0.5f * last.w;
  const auto stillHalf = [&](float along) {
    const auto shape = slicer.section(vec3(last) + along * direction, direction, reach);
    return shape && shape->radius > 0.7071f * last.w && shape->radius < 1.4f * last.w;
  };
  if (stillHalf(high)) return 0;  // no end here
  while (high - low > 0.5f * kEndPrecision * last.w)
    (stillHalf(0.5f * (low + high)) ? low : high) = 0.5f * (low + high);
  return low;
}

}  // namespace

void smoothSections(std::vector<vec4>& sections, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    vec4 before = sections.empty() ? vec4(0) : sections[0];
    for (std::size_t i = 1; i + 1 < sections.size(); ++i) {
      const vec4 here = sections[i];
      sections[i] = 0.25f * before + 0.5f * here + 0.25f * sections[i + 1];
      before = here;
    }
  }
}

std::vector<vec4> reslice(Slicer& slicer, const std::vector<vec4>& rough, float leastSpacing) {
  if (rough.size() < 2) return {};
  std::vector<vec4> axis = rough;
  smoothSections(axis, 4);
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<vec4> sections = slicePass(slicer, axis, leastSpacing);
    if (sections.size() < 2) return pass == 0 ? std::vector<vec4>{} : axis;
    axis = std::move(sections);
    if (pass == 0) smoothSections(axis, 1);
  }
  return axis;
}

void extendToEnd(Slicer& slicer, std::vector<vec4>& sections, float limit) {
  if (sections.size() < 2) return;
  const float full = sections.back().w;
  if (!(full > 0)) return;
  vec3 direction = endDirection(sections, 2 * full);
  float step = 0.3f * full, travelled = 0;
  for (int cuts = 0; cuts < kMostEndCuts && step >= kEndPrecision * full && travelled < limit; ++cuts) {
    const vec4 last = sections.back();
    const vec3 ahead = vec3(last) + step * direction;
    const auto shape = slicer.section(ahead, direction, kSliceReach * full);
    const float aside = shape ? glm::distance(shape->centre, ahead) : 0;
    if (!shape || aside > 0.25f * last.w || shape->radius > 1.4f * last.w || shape->radius < 0.35f * full) {
      step *= 0.5f;
      continue;
    }
    travelled += step;
    sections.push_back(vec4(shape->centre, shape->radius));
    if (shape->radius > 0.85f * full) direction = endDirection(sections, 1.5f * full);
  }
  const vec4 last = sections.back();
  const float beyond = cutBeyond(slicer, last, direction, kSliceReach * full);
  if (beyond > kEndPrecision * last.w) sections.push_back(vec4(vec3(last) + beyond * direction, last.w));
}

}  // namespace vasa
