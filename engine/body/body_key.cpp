#include "body/body_key.h"

#include "body/body.h"
#include "core/hash.h"

namespace vasa {
namespace {

std::uint64_t hashedText(const std::string& text, std::uint64_t hash) {
  return hashed(text.size(), hashOf(std::span(text), hash));
}

std::uint64_t hashedMesh(const SkinnedMesh& mesh, std::uint64_t hash) {
  static_assert(sizeof(SkinInfluence) == 4 * sizeof(std::uint16_t) + sizeof(vec4));  // without gaps
  hash = hashedText(mesh.name, hash);
  hash = hashedAll(mesh.mesh.triangles, hashedAll(mesh.mesh.positions, hash));
  return hashedAll(mesh.influences, hashedAll(mesh.normals, hash));
}

std::uint64_t hashedJoint(const Skeleton::Joint& joint, std::uint64_t hash) {
  hash = hashed(std::uint32_t(joint.parent.value), hashedText(joint.name, hash));
  hash = hashed(joint.rest.scale, hashed(joint.rest.rotation, hashed(joint.rest.translation, hash)));
  return hashed(joint.inverseBind, hashed(joint.restWorld, hash));
}

template <class T>
std::uint64_t hashedTrack(const Track<T>& track, std::uint64_t hash) {
  return hashedAll(track.values, hashedAll(track.times, hashed(track.interpolation, hash)));
}

std::uint64_t hashedClip(const Clip& clip, std::uint64_t hash) {
  hash = hashed(std::array{clip.start, clip.end, clip.framesPerSecond}, hash);
  for (const JointTracks& own : clip.tracks) {
    hash = hashed(std::uint32_t(own.joint.value), hash);
    hash = hashedTrack(own.scale, hashedTrack(own.rotation, hashedTrack(own.translation, hash)));
  }
  return hash;
}

}  // namespace

std::uint64_t bodyKey(const Body& body) {
  std::uint64_t hash = hashed(body.skeleton.rootTransform, 0);
  for (const Skeleton::Joint& joint : body.skeleton.joints) hash = hashedJoint(joint, hash);
  for (const SkinnedMesh& mesh : body.meshes) hash = hashedMesh(mesh, hash);
  for (const Clip& clip : body.clips) hash = hashedClip(clip, hash);
  return hash;
}

}  // namespace vasa
