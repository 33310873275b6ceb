#include "body/joint_pairs.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/ids.h"
#include "core/nearest_names.h"

namespace vasa {
namespace {

std::string perhaps(const std::string& name, std::span<const std::string> names) {
  const std::string near = didYouMean(name, names);
  return near.empty() ? near : "; " + near;
}

class Matcher {
 public:
  Matcher(const Rig& motion, const Rig& body)
      : motion_(motion),
        body_(body),
        told_(motion.names.size()),
        leftOut_(motion.names.size()),
        taken_(body.names.size()) {
    match_.source.assign(body.names.size(), kNone);
  }

  Result<JointPairs> run(const JointMap& map, const std::string& motionName, const std::string& bodyName) {
    for (const auto& [from, to] : map) {
      const auto a = std::ranges::find(motion_.names, from), b = std::ranges::find(body_.names, to);
      if (a == motion_.names.end())
        return badInput(motionName + " has no joint '" + from +
                        "', which a line of the joint map begins with" + perhaps(from, motion_.names));
      const auto source = std::uint32_t(a - motion_.names.begin());
      told_[source] = true, leftOut_[source] = to.empty();
      if (to.empty()) continue;
      if (b == body_.names.end())
        return badInput(bodyName + " has no joint '" + to + "', which a line of the joint map ends with" +
                        perhaps(to, body_.names));
      match_.source[std::size_t(b - body_.names.begin())] = source;
      taken_[std::size_t(b - body_.names.begin())] = true;
    }
    matchTrunk();
    matchRest();
    return std::move(match_);
  }

 private:
  // As many joints: in their order. Of the motion's only spine, chest and upper chest, and the body has the
  // same: these follow one another. Else by shares.
  void matchTrunk() {
    Trunk from = findTrunk(motion_);
    const Trunk to = findTrunk(body_);
    if (from.joints.empty() || to.joints.empty()) return;
    const bool asMany = from.joints.size() == to.joints.size();
    const auto parts = spineParts(motion_, from);
    const bool sameParts = parts == spineParts(body_, to);
    if (!asMany && sameParts && parts.size() == from.joints.size()) return;
    trunk_ = to.joints;
    for (std::size_t k = from.joints.size(); k-- > 0;) {
      const std::uint32_t s = from.joints[k];
      if (asMany && !told_[s] && !taken_[to.joints[k]]) match_.source[to.joints[k]] = s;
      if (leftOut_[s]) from.leaveOut(k);
      told_[s] = true;  // nothing else follows it by its name
    }
    if (!asMany && !from.joints.empty()) spread(from, to, sameParts);
  }

  static std::set<std::string_view> spineParts(const Rig& rig, const Trunk& trunk) {
    std::set<std::string_view> parts;
    for (const std::uint32_t joint : trunk.joints)
      if (!rig.parts.of[joint].empty()) parts.insert(rig.parts.of[joint]);
    return parts;
  }

  void spread(const Trunk& from, const Trunk& to, bool sameParts) {
    std::vector<std::uint32_t> free;
    for (std::size_t k = 0; k < to.joints.size(); ++k) {
      if (taken_[to.joints[k]]) continue;
      free.push_back(to.joints[k]);
      const auto nearest = std::ranges::min_element(
          from.shares, {}, [&](float share) { return std::abs(share - to.shares[k]); });
      const std::string_view part = body_.parts.of[to.joints[k]];
      const std::uint32_t named = sameParts && !part.empty() ? motion_.partNamed(part) : kNone;
      match_.source[to.joints[k]] = named != kNone && !leftOut_[named]
                                        ? named
                                        : from.joints[std::size_t(nearest - from.shares.begin())];
    }
    match_.spread = spreadTrunk(from, to, free, body_.centres);
  }

  void matchRest() {
    // Shapes have no names in common that mean the same.
    const bool sameFamily = motion_.parts.family == body_.parts.family && motion_.parts.family != "shape";
    for (std::uint32_t j = 0; j < body_.names.size(); ++j) {
      if (taken_[j] || std::ranges::find(trunk_, j) != trunk_.end()) continue;
      for (std::uint32_t s = 0; s < motion_.names.size() && match_.source[j] == kNone; ++s) {
        if (told_[s]) continue;
        const bool samePart = !body_.parts.of[j].empty() && body_.parts.of[j] == motion_.parts.of[s];
        if (samePart || (sameFamily && plainName(body_.names[j]) == plainName(motion_.names[s])))
          match_.source[j] = s;
      }
    }
  }

  const Rig &motion_, &body_;
  std::vector<bool> told_, leftOut_;  // of the motion: what the map names, what it leaves out
  std::vector<bool> taken_;           // of the body: what the map names
  std::vector<std::uint32_t> trunk_;  // the body's, where names do not pair it
  JointPairs match_;
};

}  // namespace

Result<JointPairs> pairJoints(const Rig& motion, const Rig& body, const JointMap& map,
                              const std::string& motionName, const std::string& bodyName) {
  return Matcher(motion, body).run(map, motionName, bodyName);
}

}  // namespace vasa
