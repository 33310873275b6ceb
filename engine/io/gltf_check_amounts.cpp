#include "io/gltf_accessor.h"
#include "io/gltf_check.h"
#include "io/read_limits.h"

// Few bytes of JSON can ask for much: nodes of three bytes, accessors that share their data or have none.
namespace vasa::gltf {
namespace {

constexpr std::size_t kBytesANode = 24, kFreeNodes = 100'000;               // a node takes some 300 bytes of memory
constexpr std::size_t kLongest = std::size_t(1) << 22;                      // numbers, above two a byte
constexpr std::size_t kFreeComponents = std::size_t(1) << 26;               // numbers, above eight a byte
constexpr const char* kSplit = "split or reduce the asset";

}  // namespace

void checkAmounts(const JsonView& root, std::size_t bytes) {
  const std::size_t nodes = countOf(root, "nodes"), mostNodes = bytes / kBytesANode + kFreeNodes;
  if (nodes > mostNodes)
    root.at("nodes").fail(std::to_string(nodes) + " nodes are more than the " + std::to_string(mostNodes) +
                              " accepted for a file of this size",
                          kSplit);
  const std::size_t longest = 2 * bytes + kLongest, most = 8 * bytes + kFreeComponents;
  std::size_t sum = 0;
  for (const JsonView& accessor : root.items("accessors")) {
    const auto layout = elementLayout(accessor.at("componentType").integer(0, 65535), accessor.at("type").text());
    const std::size_t numbers = std::size_t(accessor.at("count").integer(1, std::int64_t(1) << 40)) * layout.components();
    sum += numbers;
    if (numbers > longest)
      accessor.fail(std::to_string(numbers) + " numbers are more than the " + std::to_string(longest) +
                        " accepted for a file of this size",
                    kSplit);
    if (sum > most)
      accessor.fail("all accessors up to this hold " + std::to_string(sum) + " numbers, more than the " +
                        std::to_string(most) + " accepted for a file of this size",
                    kSplit);
  }
}

}  // namespace vasa::gltf
