#pragma once
#include "avoid/bone_constraints.h"
#include "avoid/constraints.h"
#include "avoid/detour.h"
#include "avoid/skin_wall.h"
#include "avoid/solver.h"
#include "core/clock.h"

namespace vasa {

/// Tubes of contacts that lie tube by tube.
std::uint32_t tubesOf(std::span<const BoneContact> contacts);
BoneReport reportOf(std::span<const BoneContact> contacts);

struct Avoider::State {
  State(const Network& own, const Body* body, AvoidOptions chosen)
      : network(own),
        options(chosen),
        interference(own),
        space(own, chosen.bending),
        sides(own, interference),
        pool(own, space, interference, sides),
        boneConstraints(own, space, interference.layout()),
        z(space.variableCount()),
        posedTubes(interference.layout().count()),
        posedTurns(interference.layout().count()) {
    if (body) bones = std::make_unique<Bones>(*body, interference.restTubes());
    if (body && chosen.skinWall) wall = std::make_unique<SkinWall>(*body, interference.restTubes());
  }

  AvoidReport run(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points);
  void look(const PosedVessels& posed, std::span<const vec4> points, Bones::Which which, AvoidReport& report);
  void lookAtBones(Bones::Which which, AvoidReport& report);
  void ascend();
  float ascend(Constraint& constraint, const MotionSpace::Rows& rows);
  void push(const Constraint& constraint, const MotionSpace::Rows& rows, float amount);
  void sumUp();
  void place(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points);
  void separate(unsigned rounds, const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report);
  void letThroughBones(unsigned nodes);
  void giveWay(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report);
  void tryAgain(unsigned rounds, const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report);
  std::vector<vec4> widePoints(const VolumeKeeper* volume, std::span<const vec4> points) const;

  // What is tried once a frame is certified (improve.cpp).
  struct Outcome {
    std::size_t changed;
    BoneReport bones;
    std::uint32_t inSkin;
    std::vector<vec4> points;
    VolumeKeeper::Outcome volume;
  };
  Outcome present(std::span<const vec4> points) const;
  void restore(const Outcome& outcome, const PosedVessels& posed, std::span<vec4> points, AvoidReport& report);
  bool isFreerOfBones(const Outcome& than);
  void bringBack(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report);
  bool isJump(std::span<const vec4> from, std::span<const vec4> to) const;
  void leaveBones(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report);
  std::vector<Stretch> stretchesInTheWay();
  std::pair<std::size_t, std::size_t> contactsOf(VesselId vessel) const;
  void take(const Detour& detour, float factor, const VolumeKeeper* volume, std::span<vec4> points);
  void narrowAtBones(const PosedVessels& posed, std::span<vec4> points, AvoidReport& report);
  void goAroundBones(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report);

  const Network& network;
  AvoidOptions options;
  Interference interference;
  MotionSpace space;
  RestSides sides;
  std::unique_ptr<Bones> bones;
  std::unique_ptr<SkinWall> wall;
  ConstraintPool pool;
  BoneConstraints boneConstraints;
  std::vector<vec3> z;
  std::vector<Bezier> posedTubes;
  std::vector<quat> posedTurns;  // of their middles
  VolumeKeeper::Outcome volumeOutcome;
  bool gaveWay = false;      // some lumen, in this frame
  std::vector<float> most;   // radius of a point, since it did
  std::vector<Interference::Place> found, remaining;
  std::span<const Interference::Place> places;  // of the last look, as the next two
  std::vector<Contact> changed;
  std::span<const BoneContact> boneContacts;
  std::vector<BoneContact> skinContacts, allContacts;  // of the last look; bones and skin together, sorted alike
  std::vector<NarrowPlace> narrowed;
};

}  // namespace vasa
