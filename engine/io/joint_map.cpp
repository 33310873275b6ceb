#include "core/atomic_file.h"
#include "core/text_file.h"
#include "io/bvh.h"
#include "io/csv.h"
#include "io/words.h"

namespace vasa {
namespace {

constexpr std::size_t kMaximumMapBytes = std::size_t(1) << 20;

}  // namespace

Result<JointMap> readJointMap(const std::filesystem::path& path) {
  const auto bytes = readFile(path, kMaximumMapBytes);
  if (!bytes) return bytes.error();
  return parseJointMap({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string());
}

Result<JointMap> parseJointMap(std::string_view text, const std::string& name) {
  std::string kept;
  const auto plain = plainText(text, name, kept);
  if (!plain) return plain.error();
  text = *plain;
  JointMap map;
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = nextLine(text);
    line = csv::trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const std::size_t sign = line.find('=');
    const std::string_view from = csv::trimmed(line.substr(0, sign));
    if (sign == line.npos || from.empty())
      return badInput(name + ":" + std::to_string(number) +
                      ": a line must be `motion's joint = body's joint`");
    map[std::string(from)] = std::string(csv::trimmed(line.substr(sign + 1)));
  }
  return map;
}

}  // namespace vasa
