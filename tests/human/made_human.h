#pragma once
#include <doctest/doctest.h>

#include "make_human/human.h"

namespace vasa::human {

/// The built-in human, made once for all cases of this program.
inline const Human& madeHuman() {
  static const Result<Human> made = makeHuman(VASA_HUMAN_TABLES);
  if (!made.ok()) FAIL(made.error().message);
  return *made;
}

}  // namespace vasa::human
