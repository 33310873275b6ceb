#pragma once
#include <cstddef>
#include <span>
#include <string_view>

#include "body/body.h"
#include "body/spine.h"
#include "core/result.h"

namespace vasa {

constexpr std::size_t kPlacesAsked = 400;  ///< of a network: whether they lie in a body or a surface
constexpr float kMostOutside = 0.15f;      ///< share of them, of what belongs there
constexpr float kToldOutside = 0.01f;  ///< from which it is told; of whole bodies' networks 0.0025 at most

/// Whether vessels lie in a body at rest, judged by a fixed sample of their points. With a skin, by the share
/// that lies outside it by more than 1 % of the body's height; without, by the share farther than 15 % of it
/// from every link. Fails with badInput that names both, the share and what helps, when it is above 15 %.
/// @param points  (x, y, z, r) [m], at least one
/// @param name    of the network, for the message
/// @return the share
Result<float> checkBelongs(const Body& body, const SpineSet& spines, std::span<const vec4> points,
                           std::string_view name);

/// Whether vessels are anywhere near a body at rest: of one network of several, which may be in another unit.
/// Fails with badInput that names both and how far off they lie, where more than 15 % of its points lie
/// outside the box around its joints by more than 15 % of its height.
Result<void> checkNear(const Body& body, std::span<const vec4> points, std::string_view name);

}  // namespace vasa
