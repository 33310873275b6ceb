#include <map>
#include <optional>

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

// A name in double quotes at the beginning of a text, which then is what comes after it.
std::optional<std::string> takeQuoted(std::string_view& text) {
  if (!text.starts_with('"')) return std::nullopt;
  std::string name;
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] == '"') {
      text = csv::trimmed(text.substr(i + 1));
      return name;
    }
    const bool marked = text[i] == '\\' && i + 1 < text.size();
    if (marked) ++i;
    name += marked && text[i] == 'n' ? '\n' : text[i];
  }
  return std::nullopt;
}

}  // namespace

std::string jointMapName(std::string_view name) {
  const bool plain = !name.empty() && csv::trimmed(name) == name && withoutComment(name) == name &&
                     !name.starts_with('"') && !name.starts_with('=') && !name.ends_with(" =") &&
                     name.find(" = ") == name.npos && name.find('\n') == name.npos;
  if (plain) return std::string(name);
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c == '\n' ? "\\n" : std::string(1, c);
  }
  return text + "\"";
}

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
    const std::string where = name + ":" + std::to_string(number) + ": ";
    const std::string_view whole = csv::trimmed(nextLine(text));
    std::string_view right = whole, uncommented;  // what is right of the sign
    std::string joint;
    if (const auto quoted = takeQuoted(right); quoted && right.starts_with('=')) {
      joint = *quoted;
      right.remove_prefix(1);
      uncommented = withoutComment(right);
    } else {
      const std::string_view line = csv::trimmed(withoutComment(whole));
      if (line.empty()) continue;
      if (const std::size_t sign = signIn(line); sign != line.npos) {
        joint = csv::trimmed(line.substr(0, sign));
        right = whole.substr(sign + 1);
        uncommented = line.substr(sign + 1);
      }
    }
    if (joint.empty()) return badInput(where + "a line must be `motion's joint = body's joint`");
    std::string moved(csv::trimmed(uncommented));
    right = csv::trimmed(right);
    if (const auto quoted = takeQuoted(right); quoted && withoutComment(right).empty()) moved = *quoted;
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
