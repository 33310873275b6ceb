// A fork's vertices and triangles from its rings. Mirrors evaluateFork() of engine/surface/fork.cpp: the same operations in
// the same order. The shader that includes it has set the rings and their directions, and has
//   ForkBranch branchAt(uint branch)
//   vec3 piercingOf(ForkBranch branch)     where its axis pierces the wall at rest
//   vec2 halfStepOf(uint around)        (cos, sin) of π/m
#ifndef VASA_FORK_BUILD
#define VASA_FORK_BUILD
#include "lib/fork_collar.glsl"
#include "lib/fork_stump.glsl"

// Puts the branch's hole between columns.
void placeWindow(uint i, ForkRecord fork, ForkBranch branch, ForkShape shape, Section at) {
  vec3 towards = levelled(at, piercingOf(branch));
  vec2 wanted = vec2(dotOf(towards, at.u), dotOf(towards, at.v)), halfStep = halfStepOf(shape.a);
  precise float share = branch.window * float(shape.a) + 1.0;
  ForkWindow window;
  window.count = min(uint(ceil(share)), fork.branchCount > 1 ? shape.a / fork.branchCount : shape.a - 1);
  vec2 halfAngle = vec2(1, 0);
  for (uint c = 0; c < window.count; ++c) halfAngle = turned(halfAngle, halfStep);
  window.first = nearestOf(0, turned(wanted, vec2(halfAngle.x, -halfAngle.y)), shape.a);
  if (i > 0) {  // beside the first one's
    uint otherFirst = windows[0].first, least = windows[0].count, most = shape.a - window.count;
    uint behind = wrapped(window.first + shape.a - otherFirst, shape.a);
    if (behind < least) window.first = wrapped(otherFirst + (2 * behind < least ? most : least), shape.a);
    else if (behind > most) window.first = wrapped(otherFirst + most, shape.a);
  }
  window.hole = holeDirection(branch, wanted, turned(directionAt(0, window.first), halfAngle), halfAngle);
  window.wide = branch.holeAround;
  precise vec3 rows = (vec3(fork.row1, fork.row2, fork.row3) - branch.centre) / branch.holeAlong;
  window.rows = rows;
  windows[i] = window;
}

// The trunk's two ends, then branches. Chosen one by one: a CPU device takes an array apart lane by lane where it does not know
// the place.
Ring rings[2 + kMostBranches];

void setRing(uint part, Ring ring) {
  for (uint i = 0; i < 2 + kMostBranches; ++i)
    if (i == part) rings[i] = ring;
}

Ring ringAt(uint part) {
  Ring ring = rings[0];
  for (uint i = 1; i < 2 + kMostBranches; ++i)
    if (i == part) ring = rings[i];
  return ring;
}

void build(ForkRecord fork, ForkShape shape) {
  Ring a = rings[0], b = rings[1];
  precise float thirdA = fork.scaleA / 3.0, thirdB = -(fork.scaleB / 3.0);
  precise vec3 chord = b.section.centre - a.section.centre;
  Trunk trunk = Trunk(Bezier(vec4(a.section.centre, a.section.radius), innerPoint(a, thirdA), innerPoint(b, thirdB),
                             vec4(b.section.centre, b.section.radius)), chord);
  precise vec3 tangentA = a.turn * a.section.tangent, tangentB = b.turn * b.section.tangent;
  Section bare = trunkAt(trunk, fork.row2);
  Section middle = framed(bare, carried(a.section.u, a.section.centre, tangentA, bare.centre, bare.tangent));

  uint first = 0;
  // One loop for all rows: a device compiles what is called once for each place that calls it, and as often again as it
  // unrolls a loop.
  [[dont_unroll]] for (uint row = 0; row < kTrunkRows; ++row) {
    uint around = rowSize(shape, row), start = rowStart(shape, row);
    bool atB = row + 1 == kTrunkRows;
    if (atB) first = seamAt(1, b, carried(middle.u, middle.centre, middle.tangent, b.section.centre, tangentB), around);
    Section section = wallAt(trunk, middle, row == 1 ? fork.row1 : row == 2 ? fork.row2 : fork.row3);
    if (atB) section = b.section;
    if (row == 0) section = a.section;
    float turn = atB ? b.turn : row == 0 ? a.turn : 1;
    for (uint k = 0; k < around; ++k)
      put(start + k, surfacePoint(section, seamDirection(atB ? 1 : 0, turn, atB ? first : 0, k, around)));
  }
  uint seams[kMostBranches];
  vec3 middles[kMostBranches];  // of the holes, on the trunk's axis
  for (uint i = 0; i < fork.branchCount; ++i) {
    ForkBranch branch = branchAt(fork.firstBranch + i);
    Section at = wallAt(trunk, middle, branch.centre);
    middles[i] = at.centre;
    placeWindow(i, fork, branch, shape, at);
    seams[i] = collar(2 + i, branch, ringAt(2 + i), rowStart(shape, holeRow(i)), shape.branch[i], windows[i].hole, at, trunk, middle);
  }
  addForkTriangles(shape);
  for (uint part = 0; part < fork.branchCount + 2; ++part) {
    bool atA = part == 0, ofTrunk = part < 2;
    uint i = ofTrunk ? 0 : part - 2;
    if (!cut && (ofTrunk || !stumps[i])) continue;
    Ring ring = ringAt(part);
    precise vec3 outward = ring.turn * ring.section.tangent, inward = -outward;
    vec3 towards = atA ? b.section.centre : ofTrunk ? a.section.centre : middles[i];
    uint ringRow = atA ? 0 : ofTrunk ? kTrunkRows - 1 : branchRow(i);
    uint tipRow = atA ? 2 : ofTrunk ? ringRow - 1 : ringRow - 2;
    addStump(shape, part, ring, atA ? 0 : ofTrunk ? first : seams[i], atA ? outward : inward, towards, ringRow,
             atA ? 1 : ringRow - 1, tipRow);
  }
}

#endif
