#include <map>

#include "core/atomic_file.h"
#include "core/text_file.h"
#include "io/bvh.h"
#include "io/csv.h"
#include "io/words.h"

namespace vasa {
namespace {

constexpr std::size_t kMaximumMapBytes = std::size_t(1) << 20;

// Without its comment: names may hold a #, but none begins with one.
std::string_view withoutComment(std::string_view line) {
  for (std::size_t at = line.find('#'); at != line.npos; at = line.find('#', at + 1))
    if (at == 0 || line[at - 1] == ' ' || line[at - 1] == '\t') return line.substr(0, at);
  return line;
}

// Where names end: at a sign between blanks, as names may hold one, else at the first.
std::size_t signIn(std::string_view line) {
  const std::size_t between = line.find(" = ");
  return between == line.npos ? line.find('=') : between + 1;
}

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
  std::map<std::string, std::string> moverOf;  // of the body's joints
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = nextLine(text);
    line = csv::trimmed(withoutComment(line));
    if (line.empty()) continue;
    const std::size_t sign = signIn(line);
    const std::string_view from = csv::trimmed(line.substr(0, sign));
    const std::string where = name + ":" + std::to_string(number) + ": ";
    if (sign == line.npos || from.empty())
      return badInput(where + "a line must be `motion's joint = body's joint`");
    const std::string joint(from), moved(csv::trimmed(line.substr(sign + 1)));
    if (!map.emplace(joint, moved).second)
      return badInput(where + "'" + joint +
                      "' is on the left twice; it can move one joint, so keep one line");
    if (const auto [other, isNew] = moverOf.emplace(moved, joint); !moved.empty() && !isNew)
      return badInput(where + "'" + moved + "' is moved by '" + other->second +
                      "' already; keep one of the lines");
  }
  return map;
}

}  // namespace vasa
