#include "convert/report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "convert/duplicates.h"

namespace vasa {
namespace {

std::string percent(double share) { return std::to_string(int(std::floor(100 * share))) + " %"; }

// [m] As far off a wall as a mesh may be and count as covered by it.
constexpr float kToldMove = SurfaceErrorOptions{}.coverLeast;

void append(std::string& reason, const std::string& more) {
  if (more.empty()) return;
  if (!reason.empty()) reason += "; ";
  reason += more;
}

void judge(ElementReport& report, float meanRadius) {
  const bool near = report.error.measured && report.error.p95 <= std::max(kOkError, 0.5f * meanRadius);
  if (report.coverage >= kOkCoverage && near) {
    report.status = ElementStatus::ok;
    return;
  }
  report.status = report.coverage >= kPartialCoverage ? ElementStatus::partial : ElementStatus::failed;
  if (!report.error.measured && report.reason.empty())
    append(report.reason, "no vessel was found in the mesh");
  else if (report.coverage < kOkCoverage)
    append(report.reason, "covers " + percent(report.coverage) + " of the surface");
  else
    append(report.reason, "5 % of the surface lie more than " +
                              std::to_string(1000 * report.error.p95).substr(0, 4) + " mm off");
}

double vesselsLength(const Assembly& assembly, std::uint32_t element) {
  double length = 0;
  for (const std::uint32_t v : assembly.vesselsOf[element])
    length += lengthOf(assembly.network.pointsOf(assembly.network.vessels()[v]));
  return length;
}

// The radius of a tube of the same area, ends and all, and the length of the element's vessels.
float meanRadius(const Assembly& assembly, std::uint32_t element, double area) {
  const double length = vesselsLength(assembly, element);
  return length > 0 ? float(0.5 * (std::sqrt(length * length + 2 * area / double(kPi)) - length)) : 0.0f;
}

// Of what has no surface: as its points tell it.
float toldRadius(const Assembly& assembly, std::uint32_t element) {
  double sum = 0;
  std::size_t count = 0;
  for (const std::uint32_t v : assembly.vesselsOf[element])
    for (const vec4& p : assembly.network.pointsOf(assembly.network.vessels()[v])) sum += p.w, ++count;
  return count ? float(sum / double(count)) : 0.0f;
}

// How much alike a surface's directions are, either side counting the same: 1 in a plane, 0.64 around a tube.
double flatness(const TriangleMesh& mesh) {
  dvec3 sum(0), first(0);
  double area = 0;
  for (const uvec3& t : mesh.triangles) {
    const dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const dvec3 across = glm::cross(b - a, c - a);
    if (first == dvec3(0)) first = across;
    sum += glm::dot(across, first) < 0 ? -across : across;
    area += glm::length(across);
  }
  return area > 0 ? glm::length(sum) / area : 0;
}

void doubt(ElementReport& report, float radius, const TriangleMesh& mesh) {
  const bool flat = flatness(mesh) > kFlat;
  if (report.status == ElementStatus::failed || report.vessels == 0 ||
      (!flat && radius >= kThinnestVessel && radius <= kWidestVessel))
    return;
  report.status = ElementStatus::doubtful;
  append(report.reason,
         flat ? "its surface is flat, as no vessel's is: a sheet, or a vessel's cut end"
         : radius > kWidestVessel
             ? "its mean radius of " + std::to_string(int(std::lround(1000 * radius))) +
                   " mm is that of no vessel: a solid or a chamber, or another unit (--unit)"
             : "its mean radius of " + std::to_string(int(std::lround(1e6f * radius))) +
                   " um is less than the " + std::to_string(int(std::lround(1e6f * kThinnestVessel))) +
                   " um to which sections are raised: another unit (--unit)? Centre lines keep their radii");
}

// Of a centre line, which may be an arteriole's.
void doubtTold(ElementReport& report, float radius, double length) {
  doubt(report, std::max(radius, kThinnestVessel), {});
  if (report.vessels == 0 || length <= kLongestInRadii * double(radius)) return;
  report.status = ElementStatus::doubtful;
  append(report.reason, "it is " + std::to_string(std::lround(length / double(radius))) +
                            " of its radii long, as no vessel is: give radii and places in one unit");
}

ElementReport reportElement(const Assembly& assembly, const SourceElement& source, std::uint32_t index,
                            std::span<const SourceElement> elements, const ElementOutcome& outcome,
                            const ElementError& error) {
  ElementReport report;
  report.name = source.element.name;
  report.kind = source.kind;
  report.ontologyId = source.element.ontologyId;
  report.method = outcome.method;
  report.reason = outcome.reason;
  if (source.byLumen) append(report.reason, "by its lumen, without the outside of its wall");
  report.vessels = std::uint32_t(assembly.vesselsOf[index].size());
  for (const std::uint32_t v : assembly.vesselsOf[index])
    report.sweeps += assembly.network.vessels()[v].spanCount();
  report.duplicate = report.vessels == 0 && !outcome.standIn.empty();
  if (!outcome.standIn.empty())
    append(report.reason, (report.duplicate ? "repeats '" : "in part repeats '") +
                              elements[outcome.standIn.front()].element.name + "'");
  report.triangles = std::uint32_t(source.element.mesh.triangles.size());
  report.area = error.area;
  report.coverage = error.coverage;
  report.error = statisticsOf(std::span(&error.forward, 1));
  report.backError = statisticsOf(std::span(&error.backward, 1));
  judge(report, roughRadius(source.element.mesh));
  if (report.status == ElementStatus::partial && outcome.moved > kToldMove)
    append(report.reason, "moved aside by up to " + std::to_string(1000 * outcome.moved).substr(0, 3) +
                              " mm, as it ran through others (--no-part leaves it)");
  if (!source.element.mesh.empty())
    doubt(report, meanRadius(assembly, index, error.area), source.element.mesh);
  else
    doubtTold(report, toldRadius(assembly, index), vesselsLength(assembly, index));
  if (source.noVessel != NoVessel::none && report.vessels > 0) {
    report.status = ElementStatus::doubtful;
    append(report.reason, "its name tells of no vessel (" + std::string(reasonOf(source.noVessel)) +
                              "), as do those of all others; --kind says that it is one");
  }
  return report;
}

void addLengths(const Network& network, ConvertSummary& summary) {
  const std::vector<std::uint32_t> components = network.components();
  std::vector<double> arterial(components.size() + 1, 0);
  for (std::uint32_t v = 0; v < components.size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    const double length = lengthOf(network.pointsOf(vessel));
    summary.length += length;
    if (vessel.kind != VesselKind::artery) continue;
    summary.arteryLength += length;
    arterial[components[v]] += length;
  }
  summary.largestArterialTree = *std::ranges::max_element(arterial);
}

}  // namespace

std::string_view statusName(ElementStatus status) {
  constexpr std::string_view kNames[] = {"ok", "partial", "failed", "doubtful"};
  return kNames[std::size_t(status)];
}

ConvertReport makeReport(const Assembly& assembly, std::span<const SourceElement> elements,
                         std::span<const ElementOutcome> outcomes, std::span<const ElementError> errors,
                         const AttachReport& joins) {
  ConvertReport report;
  ConvertSummary& summary = report.summary;
  std::vector<WeightedErrors> forward, backward;
  double area = 0, covered = 0;
  for (std::uint32_t e = 0; e < elements.size(); ++e) {
    report.elements.push_back(reportElement(assembly, elements[e], e, elements, outcomes[e], errors[e]));
    const ElementReport& own = report.elements.back();
    summary.ok += own.status == ElementStatus::ok;
    summary.partial += own.status == ElementStatus::partial;
    summary.failed += own.status == ElementStatus::failed;
    summary.doubtful += own.status == ElementStatus::doubtful;
    summary.duplicates += own.duplicate;
    summary.meshBytes += elements[e].element.mesh.bytes();
    area += own.area, covered += own.area * own.coverage;
    forward.push_back(errors[e].forward);
    backward.push_back(errors[e].backward);
  }
  const Network& network = assembly.network;
  summary.elements = std::uint32_t(elements.size());
  summary.vessels = std::uint32_t(network.vessels().size());
  summary.sweeps = network.sweepCount();
  summary.junctions = network.junctionCount();
  summary.components = network.componentCount();
  summary.coverage = area > 0 ? covered / area : 0;
  summary.error = statisticsOf(forward);
  summary.backError = statisticsOf(backward);
  summary.bodyHeight = network.bodyHeight();
  summary.joins = joins;
  addLengths(network, summary);
  return report;
}

}  // namespace vasa
