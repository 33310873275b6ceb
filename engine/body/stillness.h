#pragma once
#include <span>

#include "body/binding.h"
#include "body/body.h"

namespace vasa {

/// The share of bound points that stay behind: whose nearest links (those up to twice as far as the nearest
/// one) all go somewhere in one of the body's clips (by more than 5 % of its height) while they move by less
/// than a tenth of that. Judged by a fixed sample of points and of frames. Whatever the evidence was that
/// they were bound by, such vessels do not follow the body.
/// @param points  the bound points at rest
/// O(samples · frames · joints)
float shareLeftBehind(const Body& body, const Binding& binding, std::span<const vec4> points);

}  // namespace vasa
