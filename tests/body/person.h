#pragma once
#include <string>
#include <vector>

#include "body/body.h"

namespace vasa::test {

/// Half a trunk's width, and how far it reaches back and forward [m], at a height.
struct Section {
  float y, wide, back, front;
};

/// A closed surface around +Y through sections that lie around x.
TriangleMesh stacked(const std::vector<Section>& sections, float x);

/// Of someone with a belly, so that front and back differ; the last one is the neck.
const std::vector<Section>& personTrunk();

/// The doll (body/doll.h) in a skin of trunk, head, arms and legs, each vertex bound to the nearest bone; no
/// clips.
Body person();

/// What may be odd in a file of it.
struct PersonFile {
  bool eyes = false;   ///< a second primitive of 64 vertices, bound to neck and head
  bool stuck = false;  ///< all of the skin is bound to a joint that no clip moves, beside the hips
  float unitsAMetre = 1;
  bool jumps = false;     ///< the nodes are saved in the middle of a jump, arms raised
  float seconds = 2;      ///< that its clip takes
  bool vanishes = false;  ///< its clip scales the chest to nothing
  bool mirrored = false;  ///< by a node of negative scale above all
  bool half = false;      ///< the skin's left half alone: a mirror that was not applied
};

/// Written as a .glb, with a clip "walk" in which the hips go a metre forward and the chest
/// bends.
std::string personGlb(const PersonFile& file = {});

}  // namespace vasa::test
