#include <set>

#include "io/gltf_accessor.h"
#include "io/gltf_check.h"

namespace vasa::gltf {
namespace {

struct Sampler {
  JsonView place, output;
  std::string outputType;
  std::int64_t outputComponent, keys, values;
  bool normalised, cubic;
};

Sampler checkSampler(const JsonView& sampler, const std::vector<JsonView>& accessors,
                     const std::vector<JsonView>& views) {
  const auto accessorOf = [&](const char* key) -> const JsonView& {
    return accessors[sampler.at(key).index(accessors.size(), "accessors")];
  };
  const JsonView &input = accessorOf("input"), &output = accessorOf("output");
  if (input.at("type").text() != "SCALAR" || !isFloatComponent(input.at("componentType").integer(0, 65535)))
    sampler.at("input").fail("key times must be scalar floats");
  for (const char* key : {"input", "output"})
    if (hasStride(accessorOf(key), views))
      sampler.at(key).fail("keys must lie one behind the other, without a byteStride");
  const auto interpolation = sampler.find("interpolation");
  const std::string& method = interpolation ? interpolation->text() : std::string("LINEAR");
  if (method != "LINEAR" && method != "STEP" && method != "CUBICSPLINE")
    interpolation->fail("\"" + method + "\" must be LINEAR, STEP or CUBICSPLINE");
  const auto normalised = output.find("normalized");
  Sampler result{sampler,
                 sampler.at("output"),
                 output.at("type").text(),
                 output.at("componentType").integer(0, 65535),
                 input.at("count").integer(1, std::int64_t(1) << 40),
                 output.at("count").integer(1, std::int64_t(1) << 40),
                 normalised && normalised->boolean(),
                 method == "CUBICSPLINE"};
  if (result.cubic && result.keys < 2) sampler.at("input").fail("a cubic spline needs at least two keys");
  return result;
}

void checkOutput(const Sampler& sampler, const std::string& path) {
  const bool isFloat = isFloatComponent(sampler.outputComponent);
  const std::string wanted = path == "rotation" ? "VEC4" : path == "weights" ? "SCALAR" : "VEC3";
  if (sampler.outputType != wanted)
    sampler.output.fail("must be " + wanted + " for " + path + ", is " + sampler.outputType);
  const bool mayBeInteger = path == "rotation" || path == "weights";
  if (!isFloat && !(mayBeInteger && sampler.normalised))
    sampler.output.fail("must be of floats" + std::string(mayBeInteger ? " or normalised integers" : ""));
  if (path == "weights") return;  // not used here; their number depends on the mesh
  const std::int64_t expected = sampler.keys * (sampler.cubic ? 3 : 1);
  if (sampler.values != expected)
    sampler.output.fail("must have " + std::to_string(expected) + " values for " +
                        std::to_string(sampler.keys) + " keys, has " + std::to_string(sampler.values));
}

void checkAnimation(const JsonView& animation, const std::vector<JsonView>& nodes,
                    const std::vector<JsonView>& accessors, const std::vector<JsonView>& views) {
  std::vector<Sampler> samplers;
  for (const JsonView& sampler : animation.at("samplers").items())
    samplers.push_back(checkSampler(sampler, accessors, views));
  std::set<std::pair<std::uint32_t, std::string>> driven;
  for (const JsonView& channel : animation.at("channels").items()) {
    const JsonView target = channel.at("target");
    const std::string& path = target.at("path").text();
    const Sampler& sampler = samplers[channel.at("sampler").index(samplers.size(), "samplers")];
    const auto node = target.find("node");
    const bool moves = path == "translation" || path == "rotation" || path == "scale";
    if (moves || path == "weights") checkOutput(sampler, path);
    if (!node) continue;
    const std::uint32_t index = node->index(nodes.size(), "nodes");
    if (!driven.emplace(index, path).second)
      target.fail("node " + std::to_string(index) + " has its " + path + " driven by two channels");
    if (moves && nodes[index].has("matrix"))
      node->fail("node " + std::to_string(index) + " is animated, so it must not have a matrix");
  }
}

}  // namespace

void checkAnimations(const JsonView& root) {
  const auto nodes = root.items("nodes"), accessors = root.items("accessors"),
             views = root.items("bufferViews");
  for (const JsonView& animation : root.items("animations"))
    checkAnimation(animation, nodes, accessors, views);
}

}  // namespace vasa::gltf
