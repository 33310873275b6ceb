#pragma once
#include "io/csv.h"

namespace vasa::human {
using namespace csv;
}
