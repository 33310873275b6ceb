#include "scene/beds.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/cancellation.h"
#include "core/parallel.h"
#include "growth/random.h"

namespace vasa {
namespace {

using shared::GrowthBed;
using shared::GrowthStem;

constexpr float kMost = 1.35f;          // of a whole bed: halves are then as large in the mean
constexpr float kLeastFilled = 0.32f;   // of its box that a bed's tissue takes
constexpr std::size_t kLeastShare = 8;  // of a whole bed's tissue that it is not cut below for that
constexpr float kAskew = 0.3f;          // tangent of how far a cut leans either way at most
constexpr float kAside = 0.12f;         // of half the extent: how far it strays from the middle
constexpr float kBehindWall = 0.9f;     // cubes beyond this share of the way to a wall are the wall's
constexpr float kMargin = 0.45f;        // in cubes, between a wall and what it keeps out
constexpr float kStemsApart = 0.3f;     // of the half box: from its middle to where a stem ends
constexpr float kUpstream = 0.5f;       // of the way to a bed, by which a stem leaves its vessel before
constexpr int kSlopeReach = 2;          // cubes either way that the skin's direction is taken from
// [tenths of a cube] For a way into or out of an organ: with 16 cm, more than one measures, its own vessels
// feed it where it has any.
constexpr std::uint32_t kToll = 400;
constexpr std::int32_t kNobody = -1;

using Cubes = std::vector<std::int32_t>;

// Principal axes of points, the longest extent first: the eigenvectors of their covariance by Jacobi's
// rotations.
mat3 principalAxes(const Tissue& tissue, const Cubes& cubes, dvec3 mean) {
  std::array<std::array<double, 3>, 3> m{}, v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (const std::int32_t cube : cubes) {
    const dvec3 d = dvec3(tissue.centreOf(cube)) - mean;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m[std::size_t(i)][std::size_t(j)] += d[i] * d[j];
  }
  for (int sweep = 0; sweep < 12; ++sweep)
    for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>(0, 1), {0, 2}, {1, 2}}) {
      if (std::abs(m[p][q]) < 1e-30) continue;
      const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
      const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      for (std::size_t k = 0; k < 3; ++k) {
        const double a = m[k][p], b = m[k][q];
        m[k][p] = c * a - s * b, m[k][q] = s * a + c * b;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const double a = m[p][k], b = m[q][k];
        m[p][k] = c * a - s * b, m[q][k] = s * a + c * b;
        const double e = v[k][p], f = v[k][q];
        v[k][p] = c * e - s * f, v[k][q] = s * e + c * f;
      }
    }
  std::array<std::size_t, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t l, std::size_t r) { return m[l][l] > m[r][r]; });
  mat3 axes(1);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) axes[i][k] = float(v[std::size_t(k)][order[std::size_t(i)]]);
  return axes;
}

// The box around some cubes.
struct Box {
  mat3 axes{1};
  vec3 middle{0}, half{0};
  float filled = 0;  // share of it
};

Box boxAlong(const Tissue& tissue, const Cubes& cubes, const mat3& axes) {
  Box box{.axes = axes};
  vec3 low(1e9f), high(-1e9f);
  for (const std::int32_t cube : cubes) {
    const vec3 own = glm::transpose(axes) * tissue.centreOf(cube);
    low = glm::min(low, own), high = glm::max(high, own);
  }
  const float cell = tissue.cell;
  box.half = 0.5f * (high - low) + 0.5f * cell;
  box.middle = axes * (0.5f * (low + high));
  box.filled = float(cubes.size()) * cell * cell * cell / (8 * box.half.x * box.half.y * box.half.z);
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int l, int r) { return box.half[l] > box.half[r]; });
  const Box same = box;
  for (int i = 0; i < 3; ++i)
    box.axes[i] = same.axes[order[std::size_t(i)]], box.half[i] = same.half[order[std::size_t(i)]];
  return box;
}

// Along the principal axes or the grid's, whichever box is smaller: round pieces have no axes of their own.
Box boxOf(const Tissue& tissue, const Cubes& cubes) {
  dvec3 mean(0);
  for (const std::int32_t cube : cubes) mean += dvec3(tissue.centreOf(cube));
  const Box principal = boxAlong(tissue, cubes, principalAxes(tissue, cubes, mean / double(cubes.size()))),
            straight = boxAlong(tissue, cubes, mat3(1));
  return principal.filled > straight.filled ? principal : straight;
}

// Halves a group's tissue until its pieces are beds.
void cut(const Tissue& tissue, Cubes cubes, std::size_t most, std::vector<Cubes>& pieces) {
  checkpoint();
  const Box box = boxOf(tissue, cubes);
  if (cubes.size() <= most && (box.filled >= kLeastFilled || cubes.size() < most / kLeastShare)) {
    pieces.push_back(std::move(cubes));
    return;
  }
  // Somewhat askew, lest beds stand in rows.
  const std::uint32_t key = scramble(std::uint32_t(cubes.front()) + std::uint32_t(cubes.size()));
  const vec3 across =
      box.axes[0] + kAskew * (signedOf(key, 0) * box.axes[1] + signedOf(key, 1) * box.axes[2]);
  std::array<Cubes, 2> halves;
  double mean = 0;
  for (const std::int32_t cube : cubes) mean += double(glm::dot(across, tissue.centreOf(cube)));
  mean = mean / double(cubes.size()) + double(kAside * box.half.x * signedOf(key, 2));
  for (const std::int32_t cube : cubes)
    halves[double(glm::dot(across, tissue.centreOf(cube))) < mean ? 0 : 1].push_back(cube);
  for (Cubes& half : halves)
    if (!half.empty()) {
      if (half.size() == cubes.size()) return pieces.push_back(std::move(half));
      cut(tissue, std::move(half), most, pieces);
    }
}

// A bed in the making.
struct Piece {
  Cubes cubes;
  Box box;
  std::uint8_t region = 0;
  std::int32_t centre = 0;                         // cube
  std::array<vec4, shared::kGrowthWalls> walls{};  // from the centre, at rest
  vec4 surface{0};
  std::array<std::int32_t, 2> from{kNobody, kNobody};  // piece, or itself: a vessel
  std::array<double, 2> flow{};  // [m³] cubes of radii: own and of all that goes on from it
  std::array<vec3, 2> start{}, end{}, through{};
};

class Sharing {
 public:
  Sharing(const Tissue& tissue, const BedWish& wish) : tissue_(tissue), wish_(wish) {
    for (std::size_t i = 0; i < tissue.count(); ++i)
      passable_.push_back(tissue.kinds[i] != Tissue::Kind::solid);
  }

  void run(CapillaryBeds& beds) {
    parallelFor(2, 1, [&](std::size_t side) { findWays(side); });
    findDepths();
    findPieces();
    pieceOf_.assign(tissue_.count(), kNobody);
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      for (const std::int32_t cube : pieces_[i].cubes) pieceOf_[std::size_t(cube)] = std::int32_t(i);
    parallelFor(pieces_.size(), 16, [&](std::size_t i) { fitRoom(pieces_[i]); });
    for (const std::size_t side : {0u, 1u}) joinUp(side);
    beds.beds.clear(), beds.regionOfBed.clear();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      checkpoint();
      beds.beds.push_back(bedOf(i));
      beds.regionOfBed.push_back(pieces_[i].region);
    }
  }

 private:
  const BedSource& sourceOf(std::size_t side, std::int32_t cube) const {
    return wish_.sources[side][std::size_t(ways_[side].source[std::size_t(cube)])];
  }
  bool reached(std::size_t side, std::int32_t cube) const {
    const std::uint32_t length = ways_[side].length[std::size_t(cube)];
    return length != TissueWays::kFar && float(length) * 0.1f * tissue_.cell <= wish_.mostWay;
  }
  // Whose vessel a cube's tissue belongs to: the artery's where one is near.
  std::size_t ownerSide(std::int32_t cube) const { return reached(0, cube) ? 0 : 1; }

  void findWays(std::size_t side) {
    std::vector<TissueWays::Source> sources;
    for (std::size_t i = 0; i < wish_.sources[side].size(); ++i)
      if (const std::int32_t cube = tissue_.numberAt(wish_.sources[side][i].at); cube >= 0)
        sources.push_back({cube, std::int32_t(i)});
    // Without a skin ways have a longest length, which a toll would use up.
    ways_[side] = waysFrom(tissue_, sources, passable_, tissue_.hasSkin ? kToll : 0);
  }

  // How deep every cube lies below the skin, and below skin or bone.
  void findDepths() {
    const std::vector<char> all(tissue_.count(), 1);
    for (const bool bone : {false, true}) depth_[bone] = depthsIn(tissue_, bone ? passable_ : all);
  }

  // What fills a cube: its organ's region, else that of the vessel that feeds it; 255: nothing.
  std::uint8_t regionOf(std::int32_t cube, std::size_t side) const {
    const std::uint8_t room = tissue_.rooms[std::size_t(cube)];
    assert(room != Tissue::kHollow);
    return room == Tissue::kCommon ? sourceOf(side, cube).region : wish_.regionOfRoom[room - 1u];
  }

  void findPieces() {
    // By region and, of organs, by room.
    const std::size_t rooms = wish_.regionOfRoom.size();
    std::vector<Cubes> tissues(rooms + wish_.regions.size());
    for (std::int32_t cube = 0; cube < std::int32_t(tissue_.count()); ++cube) {
      if (tissue_.kinds[std::size_t(cube)] != Tissue::Kind::flesh) continue;
      const std::size_t side = ownerSide(cube);
      if (!reached(side, cube)) continue;
      const std::uint8_t region = regionOf(cube, side), room = tissue_.rooms[std::size_t(cube)];
      if (region != 255) tissues[room == Tissue::kCommon ? rooms + region : room - 1u].push_back(cube);
    }
    for (std::size_t i = 0; i < tissues.size(); ++i) {
      if (tissues[i].empty()) continue;
      const std::size_t region = i < rooms ? wish_.regionOfRoom[i] : i - rooms;
      const float side = wish_.regions[region].bed * wish_.scale / tissue_.cell;
      std::vector<Cubes> pieces;
      cut(tissue_, std::move(tissues[i]), std::size_t(std::max(kMost * side * side * side, 1.0f)), pieces);
      for (Cubes& piece : pieces) {
        Piece& own = pieces_.emplace_back();
        own.cubes = std::move(piece);
        own.region = std::uint8_t(region);
      }
    }
  }

  // Centre, walls, surface.
  void fitRoom(Piece& piece) const {
    piece.box = boxOf(tissue_, piece.cubes);
    float nearest = 1e9f;
    for (const std::int32_t cube : piece.cubes)
      if (const float d = glm::distance(tissue_.centreOf(cube), piece.box.middle); d < nearest)
        nearest = d, piece.centre = cube;
    const vec3 centre = tissue_.centreOf(piece.centre);
    const std::uint8_t room = tissue_.rooms[std::size_t(piece.centre)];
    std::vector<vec3> blocked;
    const vec3 reach = glm::abs(piece.box.axes[0]) * piece.box.half.x +
                       glm::abs(piece.box.axes[1]) * piece.box.half.y +
                       glm::abs(piece.box.axes[2]) * piece.box.half.z + tissue_.cell;
    const ivec3 low(glm::floor((piece.box.middle - reach - tissue_.low) / tissue_.cell)),
        high(glm::floor((piece.box.middle + reach - tissue_.low) / tissue_.cell));
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
          const std::int32_t cube = tissue_.numberAt(ivec3(x, y, z));
          const bool free = cube >= 0
                                ? passable_[std::size_t(cube)] && tissue_.rooms[std::size_t(cube)] == room
                                : !tissue_.hasSkin;
          if (free) continue;
          const vec3 p = tissue_.centreOf(ivec3(x, y, z));
          const vec3 own = glm::abs(glm::transpose(piece.box.axes) * (p - piece.box.middle));
          if (glm::all(glm::lessThanEqual(own, piece.box.half + tissue_.cell))) blocked.push_back(p - centre);
        }
    for (vec4& wall : piece.walls) {
      if (blocked.empty()) break;
      const auto found = std::min_element(blocked.begin(), blocked.end(),
                                          [](vec3 a, vec3 b) { return glm::dot(a, a) < glm::dot(b, b); });
      const vec3 at = *found;
      // Along what bounds the tissue there: the mean direction of the cubes around that one.
      vec3 sum(0);
      for (const vec3 p : blocked)
        if (glm::distance(p, at) < 2.6f * tissue_.cell) sum += glm::normalize(p);
      const vec3 towards = glm::normalize(at);
      vec3 normal = glm::normalize(sum + 1e-6f * towards);
      if (glm::dot(normal, towards) < 0.5f) normal = towards;
      float offset = glm::dot(normal, at);
      wall = vec4(normal, std::max(offset - (0.5f + kMargin) * tissue_.cell, 0.0f));
      std::erase_if(blocked, [&](vec3 p) { return glm::dot(normal, p) >= kBehindWall * offset; });
    }
    if (tissue_.hasSkin) piece.surface = surfaceAt(piece.centre, wish_.regions[piece.region].inBone);
  }

  vec4 surfaceAt(std::int32_t cube, bool bone) const {
    const auto depthOf = [&](std::int32_t number) {
      if (number < 0 || (bone && !passable_[std::size_t(number)])) return 0.0f;
      const std::uint32_t length = depth_[bone][std::size_t(number)];
      return length == TissueWays::kFar ? 0.0f : 0.1f * float(length) + 0.5f;
    };
    vec3 slope(0);
    for (int z = -kSlopeReach; z <= kSlopeReach; ++z)
      for (int y = -kSlopeReach; y <= kSlopeReach; ++y)
        for (int x = -kSlopeReach; x <= kSlopeReach; ++x) {
          const ivec3 step(x, y, z);
          slope -= depthOf(tissue_.numberAt(tissue_.places[std::size_t(cube)] + step)) * vec3(step);
        }
    const float size = glm::length(slope);
    return size > 0 ? vec4(slope / size, depthOf(cube) * tissue_.cell) : vec4(0);
  }

  // Which bed, or vessel, each bed's stem comes from.
  void joinUp(std::size_t side) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      if (reached(side, pieces_[i].centre) && regionOf(pieces_[i].centre, side) != 255) order.push_back(i);
    const auto wayOf = [&](std::size_t i) { return ways_[side].length[std::size_t(pieces_[i].centre)]; };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t l, std::size_t r) { return wayOf(l) < wayOf(r); });
    for (const std::size_t i : order) {
      checkpoint();
      Piece& piece = pieces_[i];
      piece.from[side] = std::int32_t(i);
      for (std::int32_t cube = piece.centre;; cube = ways_[side].before[std::size_t(cube)]) {
        const std::int32_t other = pieceOf_[std::size_t(cube)];
        if (other >= 0 && std::size_t(other) != i && pieces_[std::size_t(other)].from[side] != kNobody &&
            wayOf(std::size_t(other)) < wayOf(i)) {
          piece.from[side] = other;
          break;
        }
        if (ways_[side].before[std::size_t(cube)] == cube) break;
      }
      const vec3 centre = tissue_.centreOf(piece.centre);
      const float apart = (side ? -kStemsApart : kStemsApart) * piece.box.half.y;
      piece.end[side] = apart * piece.box.axes[1];
      for (const vec4& wall : piece.walls) {
        const float along = glm::dot(vec3(wall), piece.end[side]);
        if (along > wall.w) piece.end[side] *= wall.w / along;
      }
      const Piece& before = pieces_[std::size_t(piece.from[side])];
      piece.start[side] = std::size_t(piece.from[side]) == i
                              ? sourceOf(side, piece.centre).at
                              : tissue_.centreOf(before.centre) + before.end[side];
      piece.through[side] = unitOr(centre + piece.end[side] - piece.start[side], vec3(0, 1, 0));
    }
    // Murray's law from the farthest in; the widest of what goes on from a stem goes straight on.
    std::vector<double> widest(pieces_.size(), 0);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const float own = systemOf(i).radius * sideOf(i);
      pieces_[i].flow[side] = double(own) * own * own;
    }
    for (std::size_t k = order.size(); k-- > 0;) {
      const std::size_t i = order[k];
      const Piece& piece = pieces_[i];
      const auto to = std::size_t(piece.from[side]);
      if (to == i) continue;
      Piece& before = pieces_[to];
      before.flow[side] += piece.flow[side];
      if (piece.flow[side] <= widest[to]) continue;
      widest[to] = piece.flow[side];
      const vec3 here = tissue_.centreOf(before.centre) + before.end[side];
      before.through[side] = unitOr(unitOr(here - before.start[side], vec3(0, 1, 0)) +
                                        unitOr(tissue_.centreOf(piece.centre) - here, vec3(0, 1, 0)),
                                    before.through[side]);
    }
  }

  static vec3 unitOr(vec3 v, vec3 otherwise) {
    const float length = glm::length(v);
    return length > 1e-6f ? v / length : otherwise;
  }
  const shared::GrowthSystem& systemOf(std::size_t i) const {
    return wish_.rules.tables.system[wish_.regions[pieces_[i].region].system];
  }
  // Of a cube as large as the bed's tissue [m].
  float sideOf(std::size_t i) const { return std::cbrt(float(pieces_[i].cubes.size())) * tissue_.cell; }

  static mat3 axesOf(const Section& section) {
    return {section.frame.u, section.frame.v, section.frame.tangent};
  }

  GrowthBed bedOf(std::size_t i) const {
    const Piece& piece = pieces_[i];
    const BedSource& anchor = sourceOf(ownerSide(piece.centre), piece.centre);
    const Section section = sectionOn(wish_.rest, wish_.spans[anchor.span], anchor.t);
    const mat3 inverse = glm::transpose(axesOf(section));
    const vec3 centre = tissue_.centreOf(piece.centre);
    const auto inBox = [&](vec3 p) { return glm::transpose(piece.box.axes) * p / piece.box.half; };
    GrowthBed bed{};
    bed.centre = inverse * (centre - section.centre);
    bed.span = anchor.span;
    bed.t = anchor.t;
    bed.system = wish_.regions[piece.region].system;
    bed.middle = inBox(piece.box.middle - centre);
    for (int a = 0; a < 3; ++a) bed.side[a] = vec4(inverse * piece.box.axes[a], piece.box.half[a]);
    for (std::size_t w = 0; w < piece.walls.size(); ++w)
      bed.wall[w] = vec4(inverse * vec3(piece.walls[w]), piece.walls[w].w);
    bed.surface = vec4(inverse * vec3(piece.surface), piece.surface.w);
    const std::size_t first = piece.from[0] == kNobody ? 1 : 0;
    bed.entry = inBox(piece.start[first] - centre);
    for (const std::size_t side : {0u, 1u}) bed.stem[side] = stemOf(i, side, inverse);
    return bed;
  }

  GrowthStem stemOf(std::size_t i, std::size_t side, const mat3& inverse) const {
    const Piece& piece = pieces_[i];
    GrowthStem stem{};
    stem.from = shared::kNoStem;
    if (piece.from[side] == kNobody) return stem;
    std::size_t root = i;
    while (std::size_t(pieces_[root].from[side]) != root) root = std::size_t(pieces_[root].from[side]);
    const BedSource& source = sourceOf(side, pieces_[root].centre);
    const float own = systemOf(i).radius * sideOf(i), most = systemOf(root).share * source.radius;
    const float taper = wish_.rules.tables.symbol[systemOf(i).axiom].taper;
    const float last = std::cbrt(float(piece.flow[side]) - own * own * own * (1 - taper * taper * taper));
    // A vessel is wider than what hangs on it.
    stem.radius = std::min(std::cbrt(float(piece.flow[side])), most);
    stem.last = std::min(last, most);
    stem.own = std::min(own, most);
    stem.end = inverse * piece.end[side];
    stem.through = inverse * piece.through[side];
    stem.span = source.span;
    stem.from = std::uint32_t(piece.from[side]);
    if (root != i) return stem;
    stem.from = shared::kFromVessel;
    // It leaves the vessel slantwise, in the direction of the blood or against it as the vessel thins out.
    const Section at = sectionOn(wish_.rest, wish_.spans[source.span], source.t);
    const vec3 downstream = source.againstFlow ? -at.frame.tangent : at.frame.tangent;
    const vec3 way = tissue_.centreOf(piece.centre) + piece.end[side] - at.centre;
    const vec4 chord = wish_.rest.points[wish_.spans[source.span].point + 2] -
                       wish_.rest.points[wish_.spans[source.span].point + 1];
    const float length = std::max(glm::length(vec3(chord)), 1e-5f);
    const float before = kUpstream * glm::length(way) / length * (source.againstFlow ? 1.0f : -1.0f);
    stem.t = std::clamp(source.t + before, 0.0f, 1.0f);
    const Section leaves = sectionOn(wish_.rest, wish_.spans[source.span], stem.t);
    stem.leaving = glm::transpose(axesOf(leaves)) * unitOr(downstream + unitOr(way, downstream), downstream);
    return stem;
  }

  const Tissue& tissue_;
  const BedWish& wish_;
  std::vector<char> passable_;
  std::array<TissueWays, 2> ways_;
  std::array<std::vector<std::uint32_t>, 2> depth_;
  std::vector<Piece> pieces_;
  std::vector<std::int32_t> pieceOf_;  // one a cube
};

}  // namespace

void shareOut(const Tissue& tissue, const BedWish& wish, CapillaryBeds& beds) {
  Sharing(tissue, wish).run(beds);
}

}  // namespace vasa
