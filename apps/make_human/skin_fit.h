#pragma once
#include "body/body.h"

namespace vasa::human {

/// Gives a skin the weights with which it comes nearest, in the poses of the body's clips that differ most
/// from one another, to what skin does there: it lies over the bones, none of which comes out of it, and is
/// stretched and pressed as little as may be (skin_sheet.h). Only joints that move the skin near by at first
/// can take part in a place. Weights stay near those they were and vary smoothly. Parallel, the same for any
/// number of threads.
/// @param body  its first mesh is the skin, its second the bones
void fitSkin(Body& body);

}  // namespace vasa::human
