#include "scene/motion_track.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/atomic_file.h"
#include "core/bytes.h"
#include "core/hash.h"
#include "scene/frame.h"

namespace vasa {
namespace {

constexpr std::array<char, 8> kMagic{'v', 'a', 's', 'a', 't', 'r', 'k', char('0' + kMotionEdition)};
static_assert('0' + kMotionEdition < 127);

struct Header {
  std::array<char, 8> magic;
  std::uint64_t key, hash;  // hash: of all, itself as 0
  std::uint32_t variables, points, frames, reserved;
};
using TrackFrame = MotionTrack::Frame;
using Moved = MotionTrack::Moved;
using Narrowed = MotionTrack::Narrowed;
static_assert(sizeof(Moved) == 16 && sizeof(Narrowed) == 8);  // as they are in a file

// To the bit: a negative zero moves something, too.
bool moves(const vec3& by) {
  return std::bit_cast<std::array<std::uint32_t, 3>>(by) != std::array<std::uint32_t, 3>{};
}

void take(const Correction& correction, TrackFrame& frame) {
  frame.moved.clear(), frame.narrowed.clear();
  frame.moved.reserve(std::size_t(std::ranges::count_if(correction.motions, moves)));
  for (std::uint32_t v = 0; v < correction.motions.size(); ++v)
    if (moves(correction.motions[v])) frame.moved.push_back({v, correction.motions[v]});
  for (std::uint32_t p = 0; p < correction.widest.size(); ++p)
    if (std::isfinite(correction.widest[p])) frame.narrowed.push_back({p, correction.widest[p]});
}

bool takeFrame(ByteReader& reader, const Header& header, TrackFrame& frame) {
  std::uint32_t moved = 0, narrowed = 0;
  if (!reader.take(moved) || !reader.take(narrowed)) return false;
  for (std::uint32_t k = 0; k < moved; ++k) {
    Moved own;
    if (!reader.take(own) || own.variable >= header.variables || !std::isfinite(glm::dot(own.by, own.by)))
      return false;
    frame.moved.push_back(own);
  }
  for (std::uint32_t k = 0; k < narrowed; ++k) {
    Narrowed own;
    if (!reader.take(own) || own.point >= header.points || !(own.widest >= 0)) return false;
    frame.narrowed.push_back(own);
  }
  return true;
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
  for (const VesselHold& hold : scene.holds) hash = hashed(hold.at, hashOf(std::span(hold.vessel), hash));
  const std::uint32_t samples = clip.frameCount() + !endsOnFrame(clip);
  for (std::uint32_t frame = 0; frame < samples; ++frame) {
    const Pose pose = samplePose(scene.body.skeleton, clip, clip.timeOfFrame(frame));  // the last key's holds
    hash = hashOf(std::span(std::as_const(pose.world)), hash);
  }
  hash = hashed(std::array{clip.start, clip.end, clip.framesPerSecond, options.avoidance.bending}, hash);
  return hashed(
      std::array{unsigned(options.keep), unsigned(options.slide), unsigned(options.beat),
                 options.avoidance.rounds, options.avoidance.sweeps, unsigned(options.avoidance.skinWall)},
      hash);
}

void MotionTrack::restart(const Clip& clip, std::size_t variables, std::size_t points,
                          std::vector<TrackFrame> frames) {
  clip_ = &clip;
  first_ = 0;
  variables_ = variables;
  points_ = points;
  frames_ = std::move(frames);
}

void MotionTrack::restart(const Clip& clip, const Correction& first) {
  if (keeps_ == Keeps::latest && frames_.size() == 2) spare_ = std::move(frames_[1]);
  frames_.resize(1);
  take(first, frames_[0]);
  restart(clip, first.motions.size(), first.widest.size(), std::move(frames_));
}

void MotionTrack::add(const Correction& correction) {
  if (keeps_ == Keeps::latest && frames_.size() == 2) {
    ++first_;
    std::swap(frames_[0], frames_[1]);
  } else {
    frames_.push_back(std::move(spare_));
    spare_ = {};
  }
  take(correction, frames_.back());
  if (keeps_ == Keeps::all) return;
  for (TrackFrame& frame : frames_)  // either may come to hold any frame of the next round
    for (const TrackFrame& other : frames_) {
      frame.moved.reserve(other.moved.size());
      frame.narrowed.reserve(other.narrowed.size());
    }
}

void MotionTrack::at(std::uint32_t frame, Correction& correction) const {
  correction.motions.assign(variables_, vec3(0));
  correction.widest.assign(points_, std::numeric_limits<float>::infinity());
  const TrackFrame& kept = frames_[frame - first_];
  for (const Moved& own : kept.moved) correction.motions[own.variable] = own.by;
  for (const Narrowed& own : kept.narrowed) correction.widest[own.point] = own.widest;
}

Result<void> writeTrack(const std::filesystem::path& path, const MotionTrack& track, std::uint64_t key) {
  ByteWriter frames;
  for (const TrackFrame& frame : track.frames()) {
    frames.add(std::uint32_t(frame.moved.size())), frames.add(std::uint32_t(frame.narrowed.size()));
    frames.addRaw(std::as_bytes(std::span(frame.moved)));
    frames.addRaw(std::as_bytes(std::span(frame.narrowed)));
  }
  Header header{kMagic,
                key,
                0,
                std::uint32_t(track.variables()),
                std::uint32_t(track.points()),
                std::uint32_t(track.frames().size()),
                0};
  header.hash = hashOfFile(header, frames.bytes());
  ByteWriter file;
  file.add(header);
  file.addRaw(frames.bytes());
  return writeFileAtomically(path, file.bytes());
}

namespace {

// However damaged: what does not even begin like one is somebody's, and nothing to be removed.
bool beginsLikeTrack(std::span<const std::byte> bytes) {
  const std::size_t told = std::min(bytes.size(), kMagic.size() - 1);  // the last tells the edition
  return std::equal(kMagic.begin(), kMagic.begin() + std::ptrdiff_t(told),
                    reinterpret_cast<const char*>(bytes.data()));
}

}  // namespace

Result<MotionTrack> readTrack(const std::filesystem::path& path, const Scene& scene, const Clip& clip,
                              std::uint64_t key) {
  const auto bytes = readFile(path);
  if (!bytes) return bytes.error();
  if (!beginsLikeTrack(*bytes))
    return badInput(path.string() +
                    ": is no track of a motion; name another file, or one that is not there yet to keep the "
                    "track in");
  const Error damaged =
      badInput(path.string() + ": is no whole track of a motion; remove it and it is made anew");
  ByteReader reader(*bytes);
  Header header;
  const bool isWhole = reader.take(header);
  if (isWhole && header.magic != kMagic && std::equal(kMagic.begin(), kMagic.end() - 1, header.magic.begin()))
    return Error{Fault::resumeMismatch,
                 path.string() +
                     ": was made by another version of vasa, whose frames come out otherwise; "
                     "choose another file, or remove it and it is made anew"};
  if (!isWhole || header.magic != kMagic || header.hash != hashOfFile(header, reader.rest())) return damaged;
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
  std::vector<TrackFrame> frames(header.frames);
  for (TrackFrame& frame : frames)
    if (!takeFrame(reader, header, frame)) return damaged;
  if (!reader.rest().empty()) return damaged;
  MotionTrack track;
  track.restart(clip, variables, points, std::move(frames));
  return track;
}

}  // namespace vasa
