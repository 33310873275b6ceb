#pragma once
#include "body/carry.h"
#include "body/surface_fit.h"

namespace vasa {

/// A network carried by the surface around it.
struct SurfaceCarried {
  CarriedNetwork network;  ///< no joints were matched
  SurfaceFit fit;
};

/// Carries a network into a body from where only a surface is known around it, without a skeleton: the skin
/// of a scan, of a whole person or a part. The surface is found in the body's skin (body/surface_fit.h),
/// space between follows the one onto the other (body/skin_warp.h), and what then is less deep below the skin
/// than it was is moved in. It must be held as the body is at rest: arms are not bent.
///
/// Fails with badInput: the body has no skin, the vessels do not lie in the surface, or no place is found
/// where kLeastSurfaceShare of the surface is near the skin.
/// @param surface  [m], +Y up, closed but for small holes
/// @param name, surfaceName  for messages
Result<SurfaceCarried> carryBySurface(const Network& network, const TriangleMesh& surface, const Body& to,
                                      const std::string& name, const std::string& surfaceName);

}  // namespace vasa
