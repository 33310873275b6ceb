#include "body/inside.h"

#include <algorithm>

#include "core/parallel.h"

namespace vasa {
namespace {

constexpr int kInsideRounds = 3;
constexpr float kSkinThickness = 0.0012f;  // of the body's height
constexpr float kMost = 4;                 // times that a point is asked to lie below the skin
constexpr float kNegligibleDepth = 1e-5f;  // [m]

// A neighbour moves half as far, its neighbour a quarter: no kinks.
void spreadAlongVessels(const Network& network, std::vector<vec3>& moves) {
  for (const Vessel& vessel : network.vessels()) {
    const auto own = Network::pointsOf(vessel, std::span(moves));
    const auto follow = [&](std::size_t i, std::size_t before) {
      const vec3 half = 0.5f * own[before];
      if (glm::dot(half, half) > glm::dot(own[i], own[i])) own[i] = half;
    };
    for (std::size_t i = 1; i < own.size(); ++i) follow(i, i - 1);
    for (std::size_t i = own.size() - 1; i-- > 0;) follow(i, i + 1);
  }
}

}  // namespace

std::uint32_t moveInside(const Network& network, std::span<const float> depths, const SkinShell& skin,
                         float bodyHeight, std::span<vec4> points) {
  const float thickness = kSkinThickness * bodyHeight;
  std::vector<float> wanted(points.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    wanted[i] = std::min(std::min(points[i].w, kMost * thickness) + thickness, depths[i]);
  std::uint32_t moved = 0;
  for (int round = 0; round < kInsideRounds; ++round) {
    std::vector<vec3> moves(points.size(), vec3(0));
    parallelFor(moves.size(), 32, [&](std::size_t i) {
      const auto place = skin.look(vec3(points[i]));
      if (place.depth < wanted[i] - kNegligibleDepth)
        moves[i] = place.nearest - wanted[i] * place.normal - vec3(points[i]);
    });
    if (round == 0)
      moved = std::uint32_t(std::ranges::count_if(moves, [](const vec3& m) { return m != vec3(0); }));
    spreadAlongVessels(network, moves);
    for (std::size_t i = 0; i < moves.size(); ++i) points[i] += vec4(moves[i], 0);
  }
  return moved;
}

}  // namespace vasa
