#include "io/gltf_accessor.h"
#include "io/gltf_check.h"
#include "io/gltf_model.h"
#include "io/read_limits.h"

// Few bytes of JSON can ask for much: nodes of three bytes, accessors that share their data or have none.
namespace vasa::gltf {
namespace {

// Of memory; the document takes the most of the rest.
constexpr std::size_t kModelTimes = 6, kModelFreeMiB = 32;
constexpr std::size_t kLongest = std::size_t(1) << 22;         // numbers, above two a byte
constexpr std::size_t kFreeComponents = std::size_t(1) << 26;  // numbers, above eight a byte
constexpr const char* kSplit = "split or reduce the asset";

}  // namespace

void checkAmounts(const JsonView& root, std::size_t bytes) {
  const std::size_t memory = modelMemory(root), accepted = partOfMemory(bytes, kModelTimes, kModelFreeMiB);
  if (memory > accepted)
    root.fail("so many nodes, meshes, accessors and animations " + beyondMemory(memory, accepted), kSplit);
  const std::size_t longest = 2 * bytes + kLongest, most = 8 * bytes + kFreeComponents;
  std::size_t sum = 0;
  for (const JsonView& accessor : root.items("accessors")) {
    const auto layout =
        elementLayout(accessor.at("componentType").integer(0, 65535), accessor.at("type").text());
    const std::size_t numbers =
        std::size_t(accessor.at("count").integer(1, std::int64_t(1) << 40)) * layout.components();
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
