#include "convert/strand_fit.h"

#include <algorithm>
#include <cmath>

#include "curve/interpolate.h"

namespace vasa {
namespace {

constexpr float kSamplesPerSpan = 4;
// Radii between two sections up to which the mesh's own facets are followed, and from which on a curve is. A
// scanned body's meshes are dense: a curve from the first on costs their coverage 0.2 %.
constexpr float kLineRadii = 3, kCurveRadii = 6;
constexpr float kSharpTurn = 0.5f;  // cosine: chords that turn by more than 60 degrees make a corner

vec3 chordAfter(const Sections& sections, std::size_t i) { return vec3(sections[i + 1]) - vec3(sections[i]); }

// The direction of a curve through the sections at each of them, by the chords around it, the shorter one
// more (Bessel); of unit speed. Where the chords turn sharply there is none.
std::vector<vec3> tangentsOf(const Sections& sections) {
  const std::size_t n = sections.size();
  std::vector<vec3> tangents(n, vec3(0));
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const vec3 before = chordAfter(sections, i - 1), after = chordAfter(sections, i);
    const float a = glm::length(before), b = glm::length(after);
    if (glm::dot(before, after) < kSharpTurn * a * b) continue;
    tangents[i] = (b * before / a + a * after / b) / (a + b);
  }
  return tangents;
}

// Sections no farther apart than `spacing`, so that a spline cannot swing out between two of them. A mesh
// tells nothing between its rings: where these are far apart the way is a curve through them, not a line,
// which a spline would need many spans to follow around its corners.
Sections densified(const Sections& sections, float spacing) {
  const std::vector<vec3> tangents = tangentsOf(sections);
  Sections dense{sections.front()};
  for (std::size_t i = 1; i < sections.size(); ++i) {
    const vec4 from = sections[i - 1], to = sections[i];
    const float gap = glm::distance(vec3(from), vec3(to));
    const vec3 chord = (vec3(to) - vec3(from)) / std::max(gap, 1e-12f);
    // An end leaves as the other one's tangent mirrored would, a sharp corner along the chord.
    const auto direction = [&](std::size_t at, std::size_t other) {
      if (tangents[at] != vec3(0)) return tangents[at];
      const bool end = at == 0 || at + 1 == sections.size();
      return end && tangents[other] != vec3(0) ? 1.5f * chord - 0.5f * tangents[other] : chord;
    };
    const float curved =
        glm::smoothstep(kLineRadii, kCurveRadii, gap / std::max(0.5f * (from.w + to.w), 1e-12f));
    const vec3 leaving = gap * glm::mix(chord, direction(i - 1, i), curved),
               arriving = gap * glm::mix(chord, direction(i, i - 1), curved);
    const int parts = std::max(1, int(std::ceil(gap / spacing)));
    for (int part = 1; part < parts; ++part) {
      const float t = float(part) / float(parts), u = 1 - t;
      const vec3 p = u * u * (1 + 2 * t) * vec3(from) + t * u * u * leaving + t * t * (3 - 2 * t) * vec3(to) -
                     t * t * u * arriving;
      dense.push_back(vec4(p, glm::mix(from.w, to.w, t)));
    }
    dense.push_back(to);
  }
  return dense;
}

// The first, the last and every so many between, so that no more than `most` gaps are left.
Sections thinnedOut(const Sections& sections, std::size_t most) {
  const std::size_t stride = (sections.size() - 2) / most + 1;
  Sections some;
  for (std::size_t i = 0; i + 1 < sections.size(); i += stride) some.push_back(sections[i]);
  some.push_back(sections.back());
  return some;
}

}  // namespace

std::uint32_t spansWanted(const Sections& sections, const StrandFitOptions& options) {
  double radius = 0;
  for (const vec4& section : sections) radius += section.w;
  radius /= double(sections.size());
  return 2 + std::uint32_t(std::ceil(lengthOf(sections) / (options.radiiPerSpan * float(radius))));
}

std::vector<vec4> fitStrand(const Sections& all, const StrandFitOptions& options) {
  if (options.interpolate) return interpolateSamples(all).points;
  const bool tooMany = spansWanted(all, options) > options.mostSpans;
  const Sections sections = tooMany ? thinnedOut(all, std::size_t(kSamplesPerSpan) * options.mostSpans) : all;
  FitOptions fit;
  fit.maxSpans = std::min(spansWanted(sections, options), options.mostSpans);
  const Sections samples = densified(sections, lengthOf(sections) / (kSamplesPerSpan * float(fit.maxSpans)));
  fit.position = options.position;
  fit.radius = options.radius;
  return fitSpline(samples, fit);
}

}  // namespace vasa
