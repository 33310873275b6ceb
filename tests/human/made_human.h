#pragma once
#include <doctest/doctest.h>

#include "make_human/human.h"
#include "make_human/motion_probe.h"

namespace vasa::human {

inline const std::filesystem::path kTables = VASA_HUMAN_TABLES;

constexpr std::size_t kFrameStep = 6;  ///< of a clip's frames one in so many is looked at

/// The built-in human, made once for all cases of this program.
inline const Human& madeHuman() {
  static const Result<Human> made = makeHuman(kTables);
  if (!made.ok()) FAIL(made.error().message);
  return *made;
}

inline const Body& madeBody() {
  static const Body made = bodyOf(madeHuman().rig, madeHuman().meshes, madeHuman().clips);
  return made;
}

}  // namespace vasa::human
