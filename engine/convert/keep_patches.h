#pragma once
#include <array>
#include <functional>

#include "convert/source.h"
#include "surface/fork_plan.h"

// The paper's way to draw forks (Park, Shim, Park, Kang, Kim 2013, section 3.3): the source's own wall around
// them is kept.
namespace vasa {

/// What became of a fork.
enum class PatchOutcome {
  kept,
  noMesh,   ///< the source has no surfaces
  apart,    ///< its vessels' surfaces do not touch in the source
  torn,     ///< the wall has holes, or triangles that overlap
  open,     ///< the wall goes on between the vessels: something else leaves there
  crowded,  ///< the vessels end too near to one another
  notRound  ///< the wall is far from the vessels' tubes where they begin
};
constexpr std::size_t kPatchOutcomes = 7;
std::string_view outcomeName(PatchOutcome outcome);  ///< "kept", or the reason why not, for a person

struct PatchReport {
  struct Fork {
    std::vector<VesselId> vessels;  ///< the trunk's, then the branches'
    PatchOutcome outcome = PatchOutcome::noMesh;
    bool joined = false;  ///< its wall was put together (convert/joined_wall.h)
    std::uint32_t triangles = 0;
  };
  std::vector<Fork> forks;                    ///< those with a branch: two vessels joined end to end are none
  std::uint32_t vertices = 0, triangles = 0;  ///< of all patches

  std::uint32_t count(PatchOutcome outcome) const;
  std::uint32_t joined() const;  ///< of those kept
};

struct KeptPatches {
  std::vector<ForkPatch> patches;
  PatchReport report;
};

/// For every fork of the network, as it is drawn (surface/fork_plan.h), the piece of the source's wall
/// between its rings, where there is one: cut out of one surface of the source as it is, or else of the
/// joined wall of the surfaces of the fork's vessels (convert/joined_wall.h), as where each vessel is a
/// surface of its own, or torn; gaps of a radius or two are closed. Where real walls part later than their
/// round tubes, rings move out to there (convert/fork_openings.h).
/// @param network    as it is written: patches are matched to its forks by place
/// @param elements   what it was made of; empty: centre lines
/// @param elementOf  vessel -> element; empty without elements
/// In parallel over forks; the same for any number of threads.
KeptPatches keepPatches(const Network& network, std::span<const SourceElement> elements,
                        std::span<const std::uint32_t> elementOf);

}  // namespace vasa
