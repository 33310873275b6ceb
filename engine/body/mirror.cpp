#include "body/mirror.h"

namespace vasa {

std::string mirrored(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    if (text.starts_with("left"))
      out += "right", text.remove_prefix(4);
    else if (text.starts_with("right"))
      out += "left", text.remove_prefix(5);
    else
      out += text.front(), text.remove_prefix(1);
  }
  return out;
}

bool hasSide(std::string_view text) {
  return text.find("left") != text.npos || text.find("right") != text.npos;
}

}  // namespace vasa
