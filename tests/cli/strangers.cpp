#include "cli/strangers.h"

#include <doctest/doctest.h>

#include <cstdio>

#include "cli/program.h"
#include "core/atomic_file.h"
#include "io/swc.h"

namespace vasa::test {

std::string writeInto(const TemporaryFolder& folder, const char* name, const std::string& text) {
  const auto path = (folder.path() / name).string();
  REQUIRE(writeFileAtomically(path, text).ok());
  return path;
}

std::string wordsOf(const char* word, vec3 p, const char* end) {
  char text[128];
  std::snprintf(text, sizeof text, "%s%.4f %.4f %.4f%s", word, double(p.x), double(p.y), double(p.z), end);
  return text;
}

std::string personVessels() {
  std::string swc;
  int id = 0;
  const auto trace = [&](vec3 from, vec3 to, int type) {
    for (int i = 0; i <= 12; ++i) {
      ++id;
      swc += std::to_string(id) + " " + std::to_string(type) +
             wordsOf(" ", glm::mix(from, to, float(i) / 12), " ") + "0.006 " +
             std::to_string(i ? id - 1 : -1) + "\n";
    }
  };
  trace({0.02f, 1.4f, -0.03f}, {0.02f, 0.96f, -0.03f}, 11);
  trace({-0.09f, 0.88f, 0.01f}, {-0.09f, 0.45f, 0.01f}, 10);
  return swc;
}

std::vector<float> waysOf(const TemporaryFolder& folder, const std::string& body, const std::string& network,
                          std::string& told) {
  std::vector<std::vector<vec3>> at;
  for (const char* frame : {"0", "60"}) {
    const auto out = (folder.path() / (std::string(frame) + ".swc")).string();
    const auto outcome =
        runProgram({"export", "--body", body, "--network", network, "--clip", "walk", "--frames",
                    std::string(frame) + ":" + frame, "--unit", "m", "-o", out, "--no-avoid"});
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    told += outcome.err;
    const auto samples = readSwc(out, {});
    REQUIRE(samples.ok());
    at.emplace_back();
    for (const auto& sample : *samples) at.back().push_back(sample.position);
  }
  REQUIRE(at[0].size() == at[1].size());
  std::vector<float> ways;
  for (std::size_t i = 0; i < at[0].size(); ++i) ways.push_back(glm::distance(at[0][i], at[1][i]));
  return ways;
}

}  // namespace vasa::test
