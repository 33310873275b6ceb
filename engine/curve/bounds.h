#pragma once
#include "curve/bezier.h"
#include "math/capsule.h"

// Bounds of one cubic segment of a tube: the union of the balls of radius r(t) around C(t), t in [0, 1].
// Every bound holds in spite of rounding: it is grown by a few rounding errors of the coordinates.
namespace vasa {

/// K = max(|b0 - 2 b1 + b2|, |b1 - 2 b2 + b3|) over positions: a sixth of the largest |C''|.
float filipConstant(const Bezier& segment);
/// The same of the radius coefficients.
float filipRadiusConstant(const Bezier& segment);

/// Distance within which a piece of the curve between neighbouring samples at j / 2^level follows its chord:
/// ε = 3K / 4^(level + 1) (Filip, Magedson, Markot 1986).
float filipBound(float filipConstant, int level);

/// Largest of the four radius coefficients: no r(t) exceeds it.
float radiusBound(const Bezier& segment);

/// Sphere around the whole tube: centre (b0 + b3) / 2, radius max |b_l - centre| + max r_l (paper §5).
Sphere boundingSphere(const Bezier& segment);

/// Line-swept sphere around the piece between the samples `index` and `index + 1` of 2^level:
/// two entries of the Bernstein table, Filip's bound for centre line and radius. level <= kBernsteinLevels.
Capsule pieceCapsule(const Bezier& segment, int level, int index);

}  // namespace vasa
