// Read by C++ and GLSL (std430): what capillaries grow from, and how one frame draws them.
#ifndef VASA_SHARED_GROWTH_H
#define VASA_SHARED_GROWTH_H
#include "shared/draw.h"
#include "shared/tubes.h"
#ifdef __cplusplus
namespace vasa::shared {
#endif

VASA_CONSTANT uint kMostGrowthLevels = 6;  // generations of a tree
VASA_CONSTANT uint kMostGrowthSystems = 16;
VASA_CONSTANT uint kMostGrowthSymbols = 48;  // of all systems
VASA_CONSTANT uint kMostGrowthChildren = 256;
VASA_CONSTANT uint kMostCapillaryEdges = 10;
/// CapillaryPush::edges of curves that are drawn as threads, and what those have (engine/growth/ribbon.h).
VASA_CONSTANT uint kThreads = 0, kThreadEdges = 2, kThreadVertices = 6;
/// Curves drawn at a time: with kMostCapillaryEdges, what the ring of vertices holds.
VASA_CONSTANT uint kRingCurves = 8192;
/// A bracket of a production: a branch of a curve.
struct GrowthChild {
  uint symbol;
  float at;      // place along the parent, 0 to 1
  float radius;  // first radius in first radii of the parent, by Murray's law
};

/// A letter of an L-system: the curve that it is drawn as, and its branches.
struct GrowthSymbol {
  uint firstChild, childCount;
  float taper;                             // last radius in first radii
  float meander;                           // how far both ends of a curve stray from the straight way
  float fibre;                             // pull along the longest side of the bed, either way
  uint treeSize[kMostGrowthLevels + 1];    // curves of a tree of so many generations that begins here
  uint sparseSize[kMostGrowthLevels + 1];  // likewise, of its last generation every second one
};

/// How many of a curve's branches are drawn where every second one is.
VASA_FUNCTION uint sparseOf(uint branches) { return (branches + 1) / 2; }

/// An L-system.
struct GrowthSystem {
  uint axiom;
  float radius;  // of a bed's own stem, in sizes of the bed (the cube root of its volume)
  float share;   // most radius of a stem in radii of its vessel
};

struct GrowthTables {
  GrowthSystem system[kMostGrowthSystems];
  GrowthSymbol symbol[kMostGrowthSymbols];
  GrowthChild child[kMostGrowthChildren];
};

/// Planes that keep a bed's capillaries below the skin and out of bones.
VASA_CONSTANT uint kGrowthWalls = 4;
/// GrowthStem::from of a stem that leaves a vessel, and of a bed that no such vessel reaches.
VASA_CONSTANT uint kFromVessel = 0xfffffffeu, kNoStem = 0xffffffffu;

/// Where an artery's or a vein's tree comes into a bed.
struct GrowthStem {
  vec3 leaving;  // unit: first direction of a stem that leaves a vessel, in the axes u, v, tangent there
  float radius;  // [m] first
  vec3 end;      // [m] from the bed's centre, in the axes of the bed's section
  float last;    // [m] radius there
  vec3 through;  // unit, likewise: direction there
  float own;     // [m] first radius of what goes on to the bed's own branches
  uint from;     // bed whose stem it goes on from, or kFromVessel, kNoStem
  uint span;     // of the vessel that all of it hangs on
  float t;       // place on that span, in [0, 1], of a stem that leaves it
  uint unused;
};

/// A piece of the body that an artery's and a vein's tree fill together. It moves with the section of a
/// vessel: lengths are in that section's axes u, v, tangent.
struct GrowthBed {
  vec3 centre;  // [m] from the section's; inside of the tissue
  uint span;
  vec3 middle;              // of the box that the tissue fills, from the centre, in half sides of the box
  float t;                  // place of the section on its span
  vec3 entry;               // of the artery's stem, as middle
  uint system;              // number of the L-system
  vec4 side[3];             // unit normals of the box' sides and half its lengths [m], the longest first
  vec4 wall[kGrowthWalls];  // no curve of the bed crosses dot(xyz, p - centre) = w, w >= 0
  vec4 surface;             // unit normal of the nearest skin, and how deep [m] the centre lies below it
  GrowthStem stem[2];       // artery's, vein's
};

/// A tree that is drawn curve after curve.
struct GrowthJob {
  uint firstCurve;  // of the batch's curves
  uint bed;
  uint side;  // 0: the artery's tree, 1: the vein's
  uint levels;
  uint sparse;  // 1: of the last generation every second curve is drawn, as thick as those that it stands for
};

/// A picture's view of the capillaries.
struct GrowthView {
  mat4 viewProjection;
  vec3 eye;           // [m] the camera; orthographic: unit direction towards it
  float perspective;  // 1, or 0 orthographic
  vec4 depth;   // dot(depth.xyz, p) + depth.w: how far p lies before the eye [m]; (0, 0, 0, 1) orthographic
  vec3 right;   // the camera's axes
  float focal;  // pixels a metre at depth 1
  vec3 up;
  uint seed;
  uint capillary;  // colour half way between artery and vein, sRGB, red lowest
  uint unused0, unused1, unused2;
};

/// A vertex of a ribbon: 24 bytes.
struct CapillaryVertex {
  vec4 clip;
  uint colour;  // sRGB and opacity, 8 bits each
  uint across;  // where across the ribbon, in the camera's x and y: two signed 16-bit numbers
};

#ifndef __cplusplus
VASA_MEMORY(4) readonly buffer Growth { GrowthTables growth; };
VASA_MEMORY(4) readonly buffer Beds { GrowthBed bed[]; };
VASA_MEMORY(4) readonly buffer Jobs { GrowthJob job[]; };
VASA_MEMORY(4) readonly buffer Views { GrowthView view; };
VASA_MEMORY(4) readonly buffer SpanColours { uint colour[]; };
VASA_MEMORY(8) writeonly buffer Ribbons { Word word[]; };  // three a vertex
#endif

/// Of capillary.comp: one batch of curves.
struct CapillaryPush {
  VASA_ADDRESS(Points) points;
  VASA_ADDRESS(Knots) knots;
  VASA_ADDRESS(Sweeps) spans;  // whole
  VASA_ADDRESS(Tables) tables;
  VASA_ADDRESS(Growth) growth;
  VASA_ADDRESS(Beds) beds;
  VASA_ADDRESS(SpanColours) colours;
  VASA_ADDRESS(Views) view;
  VASA_ADDRESS(Jobs) jobs;  // from the batch's first on
  VASA_ADDRESS(Ribbons) vertices;
  uint jobCount;
  uint curveCount;
  uint edges;  // or kThreads
  uint hiddenKinds;
};

#ifdef __cplusplus
static_assert(sizeof(GrowthChild) == 12 && sizeof(GrowthSymbol) == 76 && sizeof(GrowthSystem) == 12);
static_assert(sizeof(GrowthStem) == 64 && sizeof(GrowthBed) == 304 && sizeof(GrowthJob) == 20 &&
              sizeof(CapillaryVertex) == 24);
static_assert(sizeof(GrowthView) == 64 + 5 * 16 && sizeof(CapillaryPush) == 96);
}  // namespace vasa::shared
#endif
#endif
