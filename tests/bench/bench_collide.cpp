// Compares detectors on one tube list or a made-up network, one thread, in one run: for each shape, every
// detector in turn, so that what else the machine does hits all alike. Prints least and median time, the
// ratio of the medians to the exact detector's, and a hash of the pairs found over all shapes.
//   bench_collide [--tubes FILE | --made TUBES] [--runs N] [--tolerance T]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "collide/paper_detector.h"
#include "collide/tube_detector.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "support/tube_network.h"
#ifdef VASA_BENCH_EMBREE
#include "embree_detector.h"
#endif
#ifdef VASA_BENCH_FCL
#include "fcl_detector.h"
#endif

using namespace vasa;

namespace {

using Clock = std::chrono::steady_clock;

struct Entry {
  std::string name;
  std::function<std::span<const TubePair>(std::span<const Bezier>)> detect;
  int every = 1;  // slow ones take part in fewer shapes
  std::vector<double> times = {};
  std::uint64_t hash = 0;
  std::size_t pairs = 0;
};

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[std::size_t(share * double(values.size() - 1))];
}

void run(const TubeList& list, int runs, std::vector<Entry>& entries) {
  constexpr int kWarmUp = 2;
  LargeVector<Bezier> shape;
  for (int k = -kWarmUp; k < runs; ++k) {
    // Shares that never repeat and jump about: no shape, and no sequence of branches, is learnt by heart.
    list.blend(0.5f - 0.5f * std::cos(2.4f * float(k)), shape);
    for (Entry& entry : entries) {
      if (k >= 0 && k % entry.every) continue;
      const auto start = Clock::now();
      const std::span<const TubePair> pairs = entry.detect(shape);
      const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
      if (k < 0) continue;
      entry.times.push_back(ms);
      entry.hash = hashOf<TubePair>(pairs, entry.hash);
      entry.pairs += pairs.size();
    }
  }
}

void print(const std::vector<Entry>& entries) {
  const double exact = quantile(entries[0].times, 0.5), exactLeast = quantile(entries[0].times, 0);
  std::printf("%-14s %10s %10s %8s %8s %10s  %s\n", "", "least ms", "median ms", "x least", "x median",
              "pairs", "hash");
  for (const Entry& entry : entries)
    std::printf("%-14s %10.3f %10.3f %8.2f %8.2f %10.1f  %016llx\n", entry.name.c_str(),
                quantile(entry.times, 0), quantile(entry.times, 0.5), quantile(entry.times, 0) / exactLeast,
                quantile(entry.times, 0.5) / exact,
                double(entry.pairs) / double(std::max<std::size_t>(1, entry.times.size())),
                static_cast<unsigned long long>(entry.hash));
}

}  // namespace

int main(int argc, char** argv) {
  std::string file;
  std::uint32_t made = 4030;
  int runs = 60;
  float tolerance = 1e-3f;
  for (int k = 1; k + 1 < argc; k += 2) {
    const std::string option = argv[k];
    if (option == "--tubes") file = argv[k + 1];
    if (option == "--made") made = std::uint32_t(std::strtoul(argv[k + 1], nullptr, 10));
    if (option == "--runs") runs = std::max(1, std::atoi(argv[k + 1]));
    if (option == "--tolerance") tolerance = std::strtof(argv[k + 1], nullptr);
  }
  auto list = file.empty() ? Result<TubeList>(test::makeTubeNetwork(made, 1)) : readTubeList(file);
  if (!list) {
    std::fprintf(stderr, "error: %s\n", list.error().message.c_str());
    return int(list.error().fault);
  }
  setThreadCount(1);
  const std::vector<Bezier>& rest = list->poses[0];
  const Exclusions exclusions(std::uint32_t(rest.size()), list->excluded);
  TubeDetector exact(rest, exclusions);
  PaperDetector paper(rest, exclusions, tolerance);
  std::vector<Entry> entries;
  entries.push_back({"exact", [&](std::span<const Bezier> tubes) {
                       exact.update(tubes);
                       return exact.detect();
                     }});
  entries.push_back({"paper", [&](std::span<const Bezier> tubes) {
                       paper.update(tubes);
                       return paper.detect();
                     }});
#ifdef VASA_BENCH_EMBREE
  bench::EmbreeDetector embree(rest, exclusions);
  entries.push_back({"embree + exact", [&](std::span<const Bezier> tubes) { return embree.detect(tubes); }});
#endif
#ifdef VASA_BENCH_FCL
  bench::FclDetector<fcl::AABBf> fclBoxes(rest, exclusions);
  entries.push_back({"fcl AABB", [&](std::span<const Bezier> tubes) { return fclBoxes.detect(tubes); }, 10});
  bench::FclDetector<fcl::OBBRSSf> fclObbRss(rest, exclusions);
  entries.push_back(
      {"fcl OBBRSS", [&](std::span<const Bezier> tubes) { return fclObbRss.detect(tubes); }, 10});
#endif
  std::printf("%zu tubes, %d shapes, 1 thread\n", rest.size(), runs);
  run(*list, runs, entries);
  print(entries);
}
