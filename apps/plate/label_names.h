#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "network/network.h"

namespace vasa::plate {

/// What labels call a network's vessels. Keeps a reference to the network.
class LabelNames {
 public:
  explicit LabelNames(const Network& network);

  /// A vessel's name with a capital; "left" and "right" are left out where a vessel of the same name lies
  /// mirrored on the other side and leaves a like vessel (kidneys' arteries, not the heart's or the bowel's),
  /// and the number of a piece, "(2)".
  std::string of(VesselId vessel) const;

 private:
  std::optional<std::uint32_t> otherSideOf(const std::string& name) const;

  const Network& network_;
  std::map<std::string, std::uint32_t> byName_;
  float middle_ = 0;  // the body's, x
};

/// What the name of one of a row shares with the others': "Sixth posterior intercostal artery" and
/// "Ulnar palmar digital artery of little finger" without the sixth and the finger.
std::string rowOf(std::string_view name);

/// The vessel that a branch or a companion is named after, in lower case: X of "Anterior branch of X" and of
/// "Lateral X"; empty for other names.
std::string namedAfter(std::string_view name);

/// "Renal arteries", "Dorsal branches of aorta"
std::string plural(std::string name);

/// "right leg artery 2": one of many that nobody named.
bool isNumbered(std::string_view name);

}  // namespace vasa::plate
