#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "core/log.h"
#include "fuzz/targets.h"
#include "support/mutator.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

std::vector<std::string> corpusOf(const char* name) {
  auto files = filesIn(sourceDirectory() / "tests/fuzz/corpus" / name);
  std::sort(files.begin(), files.end());
  std::vector<std::string> contents;
  for (const auto& file : files) contents.push_back(contentOf(file));
  return contents;
}

// Random damage for so long; libFuzzer (./test.sh fuzz) looks where the code branches and goes on for as long
// as one likes.
double secondsEach() {
  const char* told = std::getenv("VASA_FUZZ_SECONDS");
  return told ? std::atof(told) : 0.5;
}

}  // namespace

TEST_CASE("files from the corpus, whole and damaged, neither crash a reader nor break its promises") {
  const LogLevel before = logLevel();
  setLogLevel(LogLevel::quiet);
  for (const fuzz::Target& target : fuzz::targets()) {
    const std::vector<std::string> corpus = corpusOf(target.name);
    REQUIRE(!corpus.empty());
    for (const std::string& file : corpus) target.run(std::as_bytes(std::span(file)));
    Mutator mutator(1);
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(secondsEach());
    std::size_t runs = 0;
    for (; std::chrono::steady_clock::now() < end; ++runs) {
      const std::string damaged = mutator.mutated(corpus[runs % corpus.size()]);
      target.run(std::as_bytes(std::span(damaged)));
    }
    MESSAGE(std::string(target.name) << ": " << corpus.size() << " files, " << runs << " damaged ones");
  }
  setLogLevel(before);
}
