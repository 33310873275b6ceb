#include "scene/motion_track.h"

#include <array>
#include <cmath>
#include <limits>

#include "core/atomic_file.h"
#include "core/bytes.h"
#include "core/hash.h"
#include "scene/frame.h"

namespace vasa {
namespace {

// The numeral goes up whenever a frame comes out otherwise for the same input.
constexpr std::array<char, 8> kMagic{'v', 'a', 's', 'a', 't', 'r', 'k', '1'};

struct Header {
  std::array<char, 8> magic;
  std::uint64_t key, hash;  // hash: of all, itself as 0
  std::uint32_t variables, points, frames, reserved;
};
struct Moved {
  std::uint32_t variable;
  std::array<float, 3> by;
};
struct Narrowed {
  std::uint32_t point;
  float widest;
};

bool takeFrame(ByteReader& reader, Correction& frame) {
  std::uint32_t moved = 0, narrowed = 0;
  if (!reader.take(moved) || !reader.take(narrowed)) return false;
  for (std::uint32_t k = 0; k < moved; ++k) {
    Moved own;
    if (!reader.take(own) || own.variable >= frame.motions.size()) return false;
    const vec3 by(own.by[0], own.by[1], own.by[2]);
    if (!std::isfinite(glm::dot(by, by))) return false;
    frame.motions[own.variable] = by;
  }
  for (std::uint32_t k = 0; k < narrowed; ++k) {
    Narrowed own;
    if (!reader.take(own) || own.point >= frame.widest.size() || !(own.widest >= 0)) return false;
    frame.widest[own.point] = own.widest;
  }
  return true;
}

template <class T>
std::uint64_t hashed(const T& value, std::uint64_t hash) {
  return hashOf(std::span<const T>(&value, 1), hash);
}

std::uint64_t hashOfFile(Header header, std::span<const std::byte> frames) {
  header.hash = 0;
  return hashBytes(frames, hashed(header, 0));
}

}  // namespace

std::uint64_t trackKey(const Scene& scene, const Clip& clip, const FrameOptions& options) {
  const Network& network = scene.network;
  std::uint64_t hash = hashed(kMagic, 0);
  hash = hashOf(network.points(), hash);
  for (const Vessel& vessel : network.vessels())
    hash =
        hashed(std::array{vessel.firstPoint, vessel.pointCount, vessel.start.value, vessel.end.value}, hash);
  for (const Node& node : network.nodes())
    if (node.host) hash = hashed(node.host->parameter, hashed(node.host->vessel.value, hash));
  for (const SkinnedMesh& mesh : scene.body.meshes) {
    hash = hashOf(std::span(std::as_const(mesh.name)), hash);
    hash = hashOf(std::span(std::as_const(mesh.mesh.positions)), hash);
    hash = hashOf(std::span(std::as_const(mesh.mesh.triangles)), hash);
    for (const SkinInfluence& influence : mesh.influences)
      hash = hashed(influence.weights, hashed(influence.joints, hash));
  }
  for (const Skeleton::Joint& joint : scene.body.skeleton.joints)
    hash = hashed(joint.inverseBind, hashed(joint.parent.value, hash));
  for (std::uint32_t frame = 0; frame < clip.frameCount(); ++frame) {
    const Pose pose = samplePose(scene.body.skeleton, clip, clip.timeOfFrame(frame));
    hash = hashOf(std::span(std::as_const(pose.world)), hash);
  }
  hash = hashed(std::array{clip.start, clip.end, clip.framesPerSecond, options.avoidance.bending}, hash);
  return hashed(std::array{unsigned(options.keepVolume), unsigned(options.slide), unsigned(options.beat),
                           options.avoidance.rounds, options.avoidance.sweeps, options.avoidance.lumenRounds,
                           unsigned(options.avoidance.skinWall)},
                hash);
}

Result<void> writeTrack(const std::filesystem::path& path, const MotionTrack& track, std::uint64_t key) {
  ByteWriter frames;
  std::vector<Moved> moved;
  std::vector<Narrowed> narrowed;
  for (const Correction& frame : track.frames) {
    moved.clear(), narrowed.clear();
    for (std::uint32_t v = 0; v < frame.motions.size(); ++v)
      if (const vec3 by = frame.motions[v]; by != vec3(0)) moved.push_back({v, {by.x, by.y, by.z}});
    for (std::uint32_t p = 0; p < frame.widest.size(); ++p)
      if (std::isfinite(frame.widest[p])) narrowed.push_back({p, frame.widest[p]});
    frames.add(std::uint32_t(moved.size())), frames.add(std::uint32_t(narrowed.size()));
    for (const Moved& own : moved) frames.add(own);
    for (const Narrowed& own : narrowed) frames.add(own);
  }
  const bool any = !track.frames.empty();
  Header header{kMagic,
                key,
                0,
                any ? std::uint32_t(track.frames[0].motions.size()) : 0,
                any ? std::uint32_t(track.frames[0].widest.size()) : 0,
                std::uint32_t(track.frames.size()),
                0};
  header.hash = hashOfFile(header, frames.bytes());
  ByteWriter file;
  file.add(header);
  file.addRaw(frames.bytes());
  return writeFileAtomically(path, file.bytes());
}

Result<MotionTrack> readTrack(const std::filesystem::path& path, const Scene& scene, const Clip& clip,
                              std::uint64_t key) {
  const auto bytes = readFile(path);
  if (!bytes) return bytes.error();
  const Error damaged =
      badInput(path.string() + ": is no whole track of a motion; remove it and it is made anew");
  ByteReader reader(*bytes);
  Header header;
  if (!reader.take(header) || header.magic != kMagic || header.hash != hashOfFile(header, reader.rest()))
    return damaged;
  if (header.key != key)
    return Error{Fault::resumeMismatch, path.string() +
                                            ": is the track of another motion (other vessels, body, clip or "
                                            "options); choose another file, or remove "
                                            "it and it is made anew"};
  // A frame takes eight bytes at least, so a header cannot ask for more than the file holds.
  const std::size_t points = scene.network.points().size(), variables = points + scene.network.nodes().size();
  if (header.frames > clip.frameCount() ||
      (header.frames > 0 && (header.points != points || header.variables != variables)))
    return damaged;
  MotionTrack track{&clip, {}};
  for (std::uint32_t k = 0; k < header.frames; ++k) {
    Correction frame{std::vector<vec3>(variables, vec3(0)),
                     std::vector<float>(points, std::numeric_limits<float>::infinity())};
    if (!takeFrame(reader, frame)) return damaged;
    track.frames.push_back(std::move(frame));
  }
  if (!reader.rest().empty()) return damaged;
  return track;
}

}  // namespace vasa
