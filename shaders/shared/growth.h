// Read by C++ and GLSL (std430): what capillaries grow from, and how one frame draws them.
#ifndef VASA_SHARED_GROWTH_H
#define VASA_SHARED_GROWTH_H
#include "shared/tubes.h"
#ifdef __cplusplus
#include <cstddef>
namespace vasa::shared {
#define VASA_CONSTANT constexpr
#define VASA_ADDRESS(Block) std::uint64_t
#else
#define VASA_CONSTANT const
#endif

VASA_CONSTANT uint kMostGrowthLevels = 6;  // generations of a tree
VASA_CONSTANT uint kMostGrowthSystems = 16;
VASA_CONSTANT uint kMostGrowthSymbols = 48;  // of all systems
VASA_CONSTANT uint kMostGrowthChildren = 256;
VASA_CONSTANT uint kMostCapillaryEdges = 10;
/// CapillaryPush::edges of curves that are drawn as threads, and what those have (engine/growth/ribbon.h).
VASA_CONSTANT uint kThreads = 0, kThreadEdges = 3, kThreadVertices = 6;
/// Curves drawn at a time: with kMostCapillaryEdges, what the ring of vertices holds.
VASA_CONSTANT uint kRingCurves = 8192;
/// GrowthJob::firstSprout of the sprouts at a vessel's free end; the second bit: at its last section.
VASA_CONSTANT uint kTipSprout = 0x80000000u, kLastSprout = 0x40000000u;

/// A bracket of a production: a branch of a curve.
struct GrowthChild {
  uint symbol;
  float at;                  // place along the parent, 0 to 1
  float radius;              // first radius in first radii of the parent, by Murray's law
  float stretch;             // factor of its length
  float pitch, pitchSpread;  // [rad] angle to the parent's tangent, and how far it strays either way
  float roll, rollSpread;    // [rad] about the tangent; 0 and π lie in the plane across the site's radius
};

/// A letter of an L-system: the curve that it is drawn as, and its branches.
struct GrowthSymbol {
  uint firstChild, childCount;
  float reach, reachSpread;  // length in first radii; share that it strays either way
  float taper;               // last radius in first radii
  float meander;             // sideways step per unit of way
  float curl;                // steady turn across the site's radius, to one side or the other
  float hug;                 // 0 to 1: keeps to the sphere about the site's hub
  float outward;             // pull away from the hub
  float along, fibre;        // pull to the site's axis; to the axis or against it, whichever is nearer
  uint treeSize[kMostGrowthLevels + 1];  // curves of a tree of so many generations that begins here
};

/// An L-system.
struct GrowthSystem {
  uint axiom;
  float share, shareSpread;  // a sprout's first radius in radii of the vessel; share of it that some lack
  float mostRadius;          // [m] and never more than this
  float lean;                // [rad] between the vessel's downstream tangent and the sprout
  uint tips;                 // sprouts at a free end
  float tipRadius;           // their radius in radii of the vessel, by Murray's law
  float tipSpread;           // [rad] most angle to the vessel's tangent
};

struct GrowthTables {
  GrowthSystem system[kMostGrowthSystems];
  GrowthSymbol symbol[kMostGrowthSymbols];
  GrowthChild child[kMostGrowthChildren];
};

/// Planes that keep a site's capillaries below the skin.
VASA_CONSTANT uint kGrowthWalls = 4;
/// GrowthSite::partner of a site whose capillaries end freely.
VASA_CONSTANT uint kNoPartner = 0xffffffffu;

/// What capillaries know of their surroundings, one a span of the network, in the axes u, v, tangent of the
/// span's section where they sprout, from its centre.
struct GrowthSite {
  vec3 hub;                 // [m] middle of the part of the body: the limb's axis, the brain
  float reach;              // [m] no curve leaves the ball about the centre
  vec3 axis;                // unit: direction of the limb
  uint system;              // lowest 8 bits: number of the L-system; bit 8: blood flows against the tangent
  vec4 wall[kGrowthWalls];  // nor does one cross dot(xyz, p) = w, w >= 0
  vec2 stretch;  // of the span, in [0, 1], that trees stand along: not where it lies in a fork's collar
  uint key;      // of the vessel and the place on it
  uint sprouts;  // trees along the span
  uint partner;  // span, vein beside artery and the other way round, whose trees the last curves run into
  uint unused0, unused1, unused2;
};

/// Trees of one span that are drawn one after another.
struct GrowthJob {
  uint firstCurve;  // of the batch's curves
  uint span;
  uint firstSprout;
  uint levels;
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
  float thinnest;  // [pixels] least width of what is drawn: thinner curves fade instead
  uint seed;
  uint capillary;   // colour half way between artery and vein, sRGB, red lowest
  uint joinLevels;  // trees of so many generations run into their partners', others end freely
  uint unused;
};

/// A vertex of a ribbon: 24 bytes.
struct CapillaryVertex {
  vec4 clip;
  uint colour;  // sRGB and opacity, 8 bits each
  uint across;  // where across the ribbon, in the camera's x and y: two signed 16-bit numbers
};

#ifndef __cplusplus
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Growth { GrowthTables growth; };
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Sites { GrowthSite site[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Jobs { GrowthJob job[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Views { GrowthView view; };
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer SpanColours { uint colour[]; };
layout(buffer_reference, std430, buffer_reference_align = 8) writeonly buffer Ribbons {
  Word word[];
};  // three a vertex
#define VASA_ADDRESS(Block) Block
#endif

/// Of capillary.comp: one batch of curves.
struct CapillaryPush {
  VASA_ADDRESS(Points) points;
  VASA_ADDRESS(Knots) knots;
  VASA_ADDRESS(Sweeps) spans;  // whole
  VASA_ADDRESS(Tables) tables;
  VASA_ADDRESS(Growth) growth;
  VASA_ADDRESS(Sites) sites;
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
static_assert(sizeof(GrowthChild) == 32 && sizeof(GrowthSymbol) == 72 && sizeof(GrowthSystem) == 32);
static_assert(sizeof(GrowthSite) == 128 && sizeof(GrowthJob) == 16 && sizeof(CapillaryVertex) == 24);
static_assert(sizeof(GrowthView) == 64 + 5 * 16 && sizeof(CapillaryPush) == 96);
}  // namespace vasa::shared
#endif
#undef VASA_ADDRESS
#undef VASA_CONSTANT
#endif
