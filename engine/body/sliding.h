#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "body/binding.h"
#include "network/network.h"

namespace vasa {

/// A place where a vessel is held: a tunnel, a hiatus, a band over it.
struct VesselHold {
  std::string vessel;  ///< its name
  float at = 0;        ///< share of its length at rest, 0 to 1
};

/// Lets vessels slide in their beds. Posed point by point a vessel is as short behind a bent knee as its bed,
/// and unchanged a hand's breadth above; a living one shifts along its course and evens that out. Along each
/// course (vessels joined end to end, past side branches, up to forks and other places that hold) the shift a
/// [m] is least in
///   ½ ∫ (da/ds + λ - 1)² ds + ½ ∫ a² / ℓ² ds,
/// with λ the stretch that the pose makes and s the arc at rest: a rod of elastic wall tied to its bed. So
/// strain becomes its mean over some ℓ to both sides, lengths between what holds stay, and nothing is shifted
/// where nothing is strained. A free end draws back where its vessel is stretched. Points move along the
/// posed course alone; what branches off goes along. Continuous in the pose.
///
/// What is squeezed even so bows out of its bed (body/bowing.h), if the bed is known.
class VesselSlider {
 public:
  /// @param network  at rest; must outlive this
  /// @param binding  of its points; without it nothing bows out
  /// @param holds    where vessels are held besides forks; names that no vessel bears hold nothing
  explicit VesselSlider(const Network& network, const Binding* binding = nullptr,
                        std::span<const VesselHold> holds = {});

  /// @param points  a posed network's points, ends on their nodes; radii stay. O(points), parallel over
  /// courses
  /// @param turned  how the bed of each point has turned since rest; asked for where a binding was given
  void run(std::span<vec4> points, std::span<const quat> turned = {}) const;

  /// ℓ of a vessel of this radius [m].
  static float slidingLength(float radius);

 private:
  struct Piece {
    VesselId vessel;
    bool backwards;
  };
  // What a course's end hangs on, and comes along with.
  struct Hold {
    bool holds = false;            // false: the end is free
    std::optional<Host> host;      // on this side, or
    std::optional<VesselEnd> end;  // on this end of a thicker course; neither: where the pose has it
  };
  // The points of a course that count, each farther along it than the one before: what never changes.
  struct Rows {
    std::vector<std::uint32_t> points, samples;
    std::vector<float> along;   // [m] at rest
    std::vector<float> tether;  // 1/ℓ²; infinite where it is held
    std::vector<vec4> rest;
    std::vector<vec3> outwards;  // from the axis of its limb; empty: nothing bows
  };
  struct Course {
    std::vector<Piece> pieces;
    // Of the network, in order. Where vessels join, the one point is there for both; its row is the same.
    std::vector<std::uint32_t> points, rowOf;
    std::vector<float> along, legs;  // [m] at rest, to each point; from the one before
    std::vector<float> holds;        // [m] along it
    Rows rows;
    Hold start, finish;
  };
  void layOut(Course& course, std::span<const VesselHold> holds, std::span<const vec3> outwards);
  void slide(const Course& course, std::span<vec4> points, std::span<const quat> turned) const;
  bool isUnstrained(const Course& course, std::span<const vec4> points) const;
  void carry(const Course& course, std::span<vec4> points) const;
  void settleOrder();

  const Network* network_;
  bool bows_ = false;
  std::size_t mostRows_ = 0, mostSamples_ = 0;  // of a course
  std::vector<Course> courses_;                 // in an order in which what others hang on comes first
};

}  // namespace vasa
