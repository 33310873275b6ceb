#include "io/gltf_clips.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>

#include "body/humanoid.h"
#include "core/log.h"
#include "io/gltf_accessor.h"
#include "io/gltf_check.h"
#include "io/gltf_rule.h"

namespace vasa::gltf {
namespace {

// Above one for four bytes of the file, which is what a key has at least.
constexpr std::size_t kFreeKeys = std::size_t(1) << 20;
constexpr double kMaximumFrames = 1e6;  // of a clip: nine hours at 30 a second

std::vector<float> storedFloats(const Asset& asset, int accessor) {
  if (!isStored(asset, accessor))
    breaks("/accessors/" + std::to_string(accessor),
           "an animation that is used needs data, and this has none", kExportAgain);
  return readFloats(asset, accessor);
}

Track<vec3> vectorTrack(const Asset& asset, const Model::Sampler& sampler) {
  Track<vec3> track{sampler.interpolation, storedFloats(asset, sampler.input), {}};
  const auto values = storedFloats(asset, sampler.output);
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    track.values.emplace_back(values[i], values[i + 1], values[i + 2]);
  return track;
}

Track<quat> rotationTrack(const Asset& asset, const Model::Sampler& sampler) {
  Track<quat> track{sampler.interpolation, storedFloats(asset, sampler.input), {}};
  const auto values = storedFloats(asset, sampler.output);
  for (std::size_t i = 0; i + 3 < values.size(); i += 4) {
    const quat q(values[i + 3], values[i], values[i + 1], values[i + 2]);
    const bool tangent = track.interpolation == Interpolation::cubic && (i / 4) % 3 != 1;
    track.values.push_back(tangent ? q : glm::normalize(q));
  }
  return track;
}

template <class T>
void extend(Clip& clip, const Track<T>& track, std::vector<float>& longest) {
  if (track.times.empty()) return;
  clip.start = std::min(clip.start, track.times.front());
  clip.end = std::max(clip.end, track.times.back());
  if (track.times.size() > longest.size()) longest = track.times;
}

// Any number of channels may share a sampler, but each gets keys of its own.
void checkKeyCount(const Model& model, std::size_t bytes) {
  const std::size_t most = bytes / 4 + kFreeKeys;
  std::size_t keys = 0;
  for (std::size_t i = 0; i < model.animations.size(); ++i)
    for (const auto& channel : model.animations[i].channels) {
      keys += model.accessors[std::size_t(model.animations[i].samplers[std::size_t(channel.sampler)].output)]
                  .count;
      if (keys > most)
        breaks("/animations/" + std::to_string(i),
               "too many keys, counting each channel's: more than the " + std::to_string(most) +
                   " accepted for a file of this size",
               "bake fewer keys");
    }
}

void checkLength(const Clip& clip) {
  const double seconds = double(clip.end) - clip.start;
  if (seconds * clip.framesPerSecond > kMaximumFrames)
    breaks("its keys",
           "last " + std::to_string(float(seconds)) + " s: more than the 1000000 frames that are accepted",
           "check the key times, which are in seconds");
}

Clip readClip(const Asset& asset, const Model::Animation& animation, const std::vector<JointId>& jointOfNode,
              AnimationChecks& checks) {
  std::map<std::uint32_t, JointTracks> byJoint;
  for (const auto& channel : animation.channels) {
    if (channel.node < 0) continue;
    const JointId joint = jointOfNode[std::size_t(channel.node)];
    if (!joint.valid()) continue;
    checks.channel(animation, channel);
    const auto& sampler = animation.samplers[std::size_t(channel.sampler)];
    JointTracks& tracks = byJoint[joint.value];
    tracks.joint = joint;
    if (channel.path == Model::Path::translation)
      tracks.translation = vectorTrack(asset, sampler);
    else if (channel.path == Model::Path::rotation)
      tracks.rotation = rotationTrack(asset, sampler);
    else if (channel.path == Model::Path::scale)
      tracks.scale = vectorTrack(asset, sampler);
  }
  Clip clip;
  clip.name = animation.name;
  clip.start = std::numeric_limits<float>::max();
  std::vector<float> longest;
  for (auto& [joint, tracks] : byJoint) {
    extend(clip, tracks.translation, longest);
    extend(clip, tracks.rotation, longest);
    extend(clip, tracks.scale, longest);
    clip.tracks.push_back(std::move(tracks));
  }
  clip.framesPerSecond = framesPerSecondOf(longest);
  checkLength(clip);
  return clip;
}

// Some exporters write an animation for each joint: together they are what the person does. Those of which
// each moves one joint, no two the same, and all of them most joints.
bool areOneMotion(std::span<const Clip> clips, std::size_t joints) {
  std::set<std::uint32_t> moved;
  for (const Clip& clip : clips)
    if (clip.tracks.size() != 1 || !moved.insert(clip.tracks.front().joint.value).second) return false;
  return clips.size() >= std::size_t(kHumanoidKeys) && 2 * clips.size() > joints;
}

Clip together(std::span<Clip> clips) {
  const auto keys = [](const Clip& clip) {
    const JointTracks& tracks = clip.tracks.front();
    return std::max(
        {tracks.translation.times.size(), tracks.rotation.times.size(), tracks.scale.times.size()});
  };
  Clip whole;
  whole.name = clips.front().name;
  whole.framesPerSecond = std::ranges::max_element(clips, {}, keys)->framesPerSecond;
  whole.start = std::ranges::min_element(clips, {}, &Clip::start)->start;
  whole.end = std::ranges::max_element(clips, {}, &Clip::end)->end;
  for (Clip& clip : clips) whole.tracks.push_back(std::move(clip.tracks.front()));
  std::ranges::sort(whole.tracks, {}, [](const JointTracks& tracks) { return tracks.joint.value; });
  checkLength(whole);
  return whole;
}

// Names that clips have already; in step with their number, as a file may have very many of one name.
class ClipNames {
 public:
  // "walk", then "walk 2": so that each can be chosen by its name.
  std::string unique(const std::string& wanted) {
    std::string name = wanted;
    while (!taken_.insert(name).second)
      name = wanted + " " + std::to_string(++last_.try_emplace(wanted, 1).first->second);
    return name;
  }

 private:
  std::set<std::string> taken_;
  std::map<std::string, std::size_t> last_;  // number that a name was given
};

}  // namespace

float framesPerSecondOf(const std::vector<float>& times) {
  constexpr float kDefault = 30;
  if (times.size() < 3) return kDefault;
  std::vector<float> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  std::nth_element(steps.begin(), steps.begin() + std::ptrdiff_t(steps.size() / 2), steps.end());
  const float median = steps[steps.size() / 2];
  // A key may be missing now and then, but not a tenth of them; times late in a clip are rounded coarsely.
  const float tolerance = 0.02f * median + 1e-6f * times.back();
  const auto regular = std::count_if(steps.begin(), steps.end(),
                                     [&](float step) { return std::abs(step - median) <= tolerance; });
  if (std::size_t(regular) * 10 < steps.size() * 9) return kDefault;
  const auto rate = float(likelyRate(1 / double(median)));
  return rate >= 10 && rate <= 240 ? rate : kDefault;
}

std::vector<Clip> readClips(const Asset& asset, const std::vector<JointId>& jointOfNode) {
  checkKeyCount(asset.model, asset.bytes);
  std::vector<Clip> clips;
  ClipNames names;
  std::vector<std::string> moveNone;
  AnimationChecks checks(asset);
  std::size_t broken = 0;
  std::string why;
  for (std::size_t i = 0; i < asset.model.animations.size(); ++i) {
    const Model::Animation& animation = asset.model.animations[i];
    const std::string name = animation.name.empty() ? "animation " + std::to_string(i) : animation.name;
    Clip clip;
    try {
      clip = readClip(asset, animation, jointOfNode, checks);
    } catch (const BrokenRule& rule) {
      if (broken++ == 0) why = "\"" + name + "\": " + rule.place + ": " + rule.rule + "; " + rule.remedy;
      continue;
    }
    clip.name = name;
    if (!(clip.end >= clip.start)) {
      moveNone.push_back(clip.name);
      continue;
    }
    clip.name = names.unique(clip.name);
    clips.push_back(std::move(clip));
  }
  if (areOneMotion(clips, std::size_t(std::ranges::count_if(jointOfNode, &JointId::valid)))) {
    logInfo(asset.name + ": " + std::to_string(clips.size()) +
            " animations that move a joint each are played together, as \"" + clips.front().name + "\"");
    clips = {together(clips)};
  }
  if (broken > 0)
    logWarning(asset.name + ": " + std::to_string(broken) + " of " +
               std::to_string(asset.model.animations.size()) + " animations are left out: " + why);
  if (!moveNone.empty())
    logInfo(
        asset.name + ": " + std::to_string(moveNone.size()) + " of " +
        std::to_string(asset.model.animations.size()) +
        " animations move no joint (but morph targets, cameras, or by an extension), and are left out: \"" +
        moveNone.front() + "\" first");
  return clips;
}

void holdFilePose(std::vector<Clip>& clips, const Skeleton& skeleton,
                  const std::vector<JointTransform>& filePose) {
  const auto hold = [](auto& track, const auto& value, const auto& rest, float time) {
    if (track.times.empty() && value != rest) track.times = {time}, track.values = {value};
  };
  for (Clip& clip : clips) {
    std::vector<JointTracks> all(skeleton.joints.size());
    for (std::uint32_t j = 0; j < all.size(); ++j) all[j].joint = {j};
    for (JointTracks& own : clip.tracks) all[own.joint.value] = std::move(own);
    clip.tracks.clear();
    for (JointTracks& own : all) {
      if (own.joint.value >= filePose.size()) continue;  // the double of a joint goes with it
      const JointTransform &told = filePose[own.joint.value], &rest = skeleton.joints[own.joint.value].rest;
      hold(own.translation, told.translation, rest.translation, clip.start);
      hold(own.rotation, told.rotation, rest.rotation, clip.start);
      hold(own.scale, told.scale, rest.scale, clip.start);
      if (!own.translation.times.empty() || !own.rotation.times.empty() || !own.scale.times.empty())
        clip.tracks.push_back(std::move(own));
    }
  }
}

}  // namespace vasa::gltf
