#include "convert/centreline_report.h"

namespace vasa {

ConvertReport reportOfCentrelines(const Centrelines& centrelines, const CentrelineNetwork& made) {
  const auto count = std::uint32_t(centrelines.lines.size());
  Assembly assembly{made.network, std::vector<std::uint32_t>(count),
                    std::vector<std::vector<std::uint32_t>>(count)};
  std::vector<SourceElement> elements(count);
  std::vector<ElementError> errors(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto& line = centrelines.lines[i];
    assembly.elementOf[i] = i;
    assembly.vesselsOf[i] = {i};
    elements[i] = {{line.name, {}, line.ontologyId, {}}, line.kind, line.name};
    const auto points = made.network.pointsOf(made.network.vessels()[i]);
    for (std::size_t s = 0; s < line.samples.size(); ++s)
      errors[i].forward.distances.push_back(
          glm::distance(vec3(evaluate(points, made.parameters[i][s])), vec3(line.samples[s])));
    errors[i].forward.areaEach = 1;
    errors[i].area = double(line.samples.size());
    errors[i].coverage = 1;
  }
  AttachReport joins;
  for (const auto& joint : centrelines.joints)
    if (joint.host)
      joins.endToSide += std::uint32_t(joint.ends.size());
    else
      joins.endToEnd += std::uint32_t(joint.ends.size() - 1);
  const std::vector<ElementOutcome> outcomes(count, {"centre line", {}, {}});
  return makeReport(assembly, elements, outcomes, errors, joins);
}

}  // namespace vasa
