#pragma once
#include <array>

namespace vasa {

struct QuadraturePoint {
  float position;  ///< in [0, 1]
  float weight;    ///< weights sum to 1
};

/// Gauss-Legendre with four points on [0, 1]: exact for polynomials up to degree 7.
inline constexpr std::array<QuadraturePoint, 4> kGauss4{{
    {0.06943184420297371f, 0.17392742256872693f},
    {0.33000947820757187f, 0.32607257743127307f},
    {0.66999052179242813f, 0.32607257743127307f},
    {0.93056815579702629f, 0.17392742256872693f},
}};

}  // namespace vasa
