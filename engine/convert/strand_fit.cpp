#include "convert/strand_fit.h"

#include <algorithm>
#include <cmath>

#include "curve/interpolate.h"

namespace vasa {
namespace {

constexpr float kSamplesPerSpan = 4;

// Sections no farther apart than `spacing`, so that a spline cannot swing out between two of them.
Sections densified(const Sections& sections, float spacing) {
  Sections dense{sections.front()};
  for (std::size_t i = 1; i < sections.size(); ++i) {
    const float gap = glm::distance(vec3(sections[i - 1]), vec3(sections[i]));
    const int parts = std::max(1, int(std::ceil(gap / spacing)));
    for (int part = 1; part < parts; ++part)
      dense.push_back(glm::mix(sections[i - 1], sections[i], float(part) / float(parts)));
    dense.push_back(sections[i]);
  }
  return dense;
}

FitTolerance scaled(const FitTolerance& tolerance, float factor) {
  return {factor * tolerance.share, factor * tolerance.least, factor * tolerance.most};
}

}  // namespace

std::vector<vec4> fitStrand(const Sections& sections, const StrandFitOptions& options) {
  if (options.interpolate) return interpolateSamples(sections).points;
  double radius = 0;
  for (const vec4& section : sections) radius += section.w;
  radius /= double(sections.size());
  FitOptions fit;
  const float length = lengthOf(sections);
  fit.maxSpans = 2 + std::uint32_t(std::ceil(length / (options.radiiPerSpan * float(radius))));
  const Sections samples = densified(sections, length / (kSamplesPerSpan * float(fit.maxSpans)));
  const auto within = [&](float factor) {
    fit.position = scaled(options.position, factor);
    fit.radius = scaled(options.radius, factor);
    return fitSplineMeasured(samples, fit);
  };
  Fit tight = within(1);
  if (tight.error <= 1) return tight.points;
  Fit relaxed = within(options.relaxed);
  return relaxed.error <= 1 ? relaxed.points : tight.points;
}

}  // namespace vasa
