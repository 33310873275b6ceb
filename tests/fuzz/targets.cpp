#include "fuzz/targets.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "body/retarget.h"
#include "core/hash.h"
#include "core/log.h"
#include "core/utf8.h"
#include "edit/replay.h"
#include "growth/growth_rules.h"
#include "growth/regions.h"
#include "io/bvh.h"
#include "io/gltf.h"
#include "io/markups.h"
#include "io/obj.h"
#include "io/stl.h"
#include "io/swc.h"
#include "io/vtk.h"
#include "io/vtp.h"
#include "network/builder.h"
#include "network/file.h"
#include "network/join_lines.h"
#include "scene/scene_file.h"

namespace vasa::fuzz {
namespace {

void must(bool holds) {
  if (!holds) std::abort();
}

std::string_view textOf(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

template <class T>
void messageNames(const Result<T>& result) {
  if (!result) must(result.error().message.starts_with("f: ") || result.error().message.starts_with("f:"));
}

// Fitting is exercised where it is quick.
constexpr std::size_t kMostSamples = 200;

void useLines(const Centrelines& lines) {
  for (const auto& line : lines.lines) {
    must(line.samples.size() >= 2);
    for (std::size_t i = 0; i < line.samples.size(); ++i) {
      must(line.samples[i].w > 0);
      must(i == 0 || vec3(line.samples[i]) != vec3(line.samples[i - 1]));
    }
  }
  for (const auto& joint : lines.joints) {
    if (joint.host)
      must(joint.host->line < lines.lines.size() &&
           joint.host->sample < lines.lines[joint.host->line].samples.size());
    for (const auto& end : joint.ends) must(end.line < lines.lines.size());
  }
  if (lines.sampleCount() > kMostSamples) return;
  const auto made = networkOfCentrelines(lines);
  if (!made) return;
  for (const vec4& p : made->network.points()) must(p.w > 0);
  (void)swcOfCentrelines(centrelinesOfNetwork(made->network, made->network.points()));
}

void checkMesh(const Result<std::vector<MeshElement>>& elements) {
  if (!elements) return;
  must(!elements->empty());
  for (const MeshElement& element : *elements)
    for (const uvec3& t : element.mesh.triangles)
      for (int k = 0; k < 3; ++k) must(t[k] < element.mesh.positions.size());
}

// A body with a few of CMU's joints, to carry motions to.
const Body& doll() {
  static const Body body = [] {
    Body made;
    const std::pair<const char*, int> joints[] = {{"Hips", -1},       {"Spine", 0},    {"LeftArm", 1},
                                                  {"LeftForeArm", 2}, {"LeftHand", 3}, {"LeftUpLeg", 0},
                                                  {"LeftLeg", 5},     {"LeftFoot", 6}};
    for (const auto& [name, parent] : joints) {
      Skeleton::Joint joint;
      joint.name = name;
      joint.rest.translation = {0.1f, parent < 0 ? 1.0f : -0.2f, 0};
      if (parent >= 0) joint.parent = {std::uint32_t(parent)};
      joint.restWorld =
          (parent < 0 ? mat4(1) : made.skeleton.joints[std::size_t(parent)].restWorld) * joint.rest.matrix();
      made.skeleton.joints.push_back(joint);
    }
    return made;
  }();
  return body;
}

// Two vessels to edit, one on the other.
const Network& limb() {
  static const Network network = [] {
    NetworkBuilder builder;
    std::vector<vec4> trunk, branch;
    for (int i = 0; i < 9; ++i) trunk.emplace_back(0, 0, 0.02f * float(i), 0.004f);
    for (int i = 0; i < 5; ++i) branch.emplace_back(0.015f * float(i), 0, 0.08f, 0.002f);
    const VesselId host = builder.addVessel({"a", "", VesselKind::artery}, trunk);
    builder.joinToSide({builder.addVessel({"v", "", VesselKind::artery}, branch), false}, {host, 3});
    return std::move(*builder.build(1.7f));
  }();
  return network;
}

}  // namespace

void swc(Bytes bytes) {
  const auto samples = parseSwc(textOf(bytes), "f");
  messageNames(samples);
  if (!samples) return;
  const std::string text = encodeSwc(*samples);
  const auto again = parseSwc(text, "f");
  must(again.ok() && encodeSwc(*again) == text);
  Centrelines traces = centrelinesOfSwc(*samples, "f", VesselKind::artery);
  useLines(traces);
  joinTouchingLines(traces);
  useLines(traces);
}

void markups(Bytes bytes) {
  const auto curves = parseMarkups(textOf(bytes), "f", VesselKind::artery);
  messageNames(curves);
  if (curves) useLines(*curves);
}

void vtk(Bytes bytes) {
  const auto surface = parseVtkSurface(bytes, "f");
  messageNames(surface);
  checkMesh(surface);
  const auto lines = parseVtkLines(bytes, "f");
  messageNames(lines);
  if (!lines) return;
  if (auto centrelines = centrelinesOfVtp(*lines, "f", VesselKind::artery)) useLines(*centrelines);
}

void vtp(Bytes bytes) {
  const auto lines = parseVtp(bytes, "f");
  messageNames(lines);
  if (!lines) return;
  const std::string text = encodeVtp(*lines);
  const auto again = parseVtp(std::as_bytes(std::span(text)), "f");
  must(again.ok() && encodeVtp(*again) == text);
  if (const auto centrelines = centrelinesOfVtp(*lines, "f", VesselKind::artery)) useLines(*centrelines);
}

void bvh(Bytes bytes) {
  const auto motion = parseBvh(textOf(bytes), "f");
  messageNames(motion);
  if (!motion) return;
  must(motion->rotations.size() == motion->frameCount * motion->joints.size() &&
       motion->translations.size() == motion->rotations.size());
  if (motion->frameCount * motion->joints.size() > 2000) return;
  const auto clip = retarget(*motion, doll());
  if (clip) must(samplePose(doll().skeleton, *clip, clip->end).world.size() == doll().skeleton.joints.size());
}

void obj(Bytes bytes) {
  const auto elements = parseObj(textOf(bytes), "f");
  messageNames(elements);
  checkMesh(elements);
}

void stl(Bytes bytes) {
  const auto elements = parseStl(bytes, "f");
  messageNames(elements);
  checkMesh(elements);
}

void gltf(Bytes bytes) {
  const std::filesystem::path path = "f";
  const std::vector<std::byte> file(bytes.begin(), bytes.end());
  const auto elements = parseGltfElements(file, path);
  messageNames(elements);
  if (elements) {
    for (const MeshElement& element : *elements)
      for (const vec3& p : element.mesh.positions) must(std::isfinite(p.x + p.y + p.z));
    checkMesh(elements);
  }
  const auto body = parseBody(file, path);
  messageNames(body);
  if (!body) return;
  const std::size_t joints = body->skeleton.joints.size();
  for (std::size_t j = 0; j < joints; ++j)
    if (const JointId parent = body->skeleton.joints[j].parent; parent.valid()) must(parent.value < j);
  for (const SkinnedMesh& mesh : body->meshes) {
    must(mesh.influences.size() == mesh.mesh.positions.size() &&
         mesh.normals.size() == mesh.mesh.positions.size());
    for (const uvec3& t : mesh.mesh.triangles) must(std::max({t.x, t.y, t.z}) < mesh.mesh.positions.size());
    for (const SkinInfluence& influence : mesh.influences)
      for (const auto joint : influence.joints) must(joint < joints);
  }
  for (const Clip& clip : body->clips)
    must(samplePose(body->skeleton, clip, clip.end).world.size() == joints);
}

void map(Bytes bytes) {
  const auto pairs = parseJointMap(textOf(bytes), "f");
  messageNames(pairs);
  if (!pairs) return;
  std::string written = "# pairs\n";
  for (const auto& [from, to] : *pairs) {
    must(!from.empty());
    written += jointMapName(from) + " = " + jointMapName(to) + "\n";
  }
  if (!isUtf8(written)) return;  // bytes would be read as another alphabet's
  const auto again = parseJointMap(written, "f");
  must(again && *again == *pairs);
}

void rules(Bytes bytes) {
  const std::string_view text = textOf(bytes);
  const std::size_t border = text.find("\n---\n");
  const auto rules = parseGrowthRules(text.substr(0, border), "f");
  messageNames(rules);
  if (!rules) return;
  must(!rules->systems.empty());
  for (std::size_t s = 0; s < rules->systems.size(); ++s)
    must(rules->tables.system[s].axiom < rules->symbols.size());
  if (border == text.npos) return;
  const auto regions = parseRegions(text.substr(border + 5), "f", *rules);
  messageNames(regions);
  if (!regions) return;
  for (const GrowthRegion& region : *regions)
    must(region.system == GrowthRegion::kNoSystem || region.system < rules->systems.size());
}

void scene(Bytes bytes) { messageNames(parseScene(std::string(textOf(bytes)), "folder", "f")); }

void vasa(Bytes bytes) {
  std::vector<std::byte> file(24);
  std::memcpy(file.data(), "VASA", 4);
  const std::uint32_t version = 1;
  const std::uint64_t length = bytes.size(), hash = hashBytes(bytes);
  std::memcpy(file.data() + 4, &version, 4);
  std::memcpy(file.data() + 8, &length, 8);
  std::memcpy(file.data() + 16, &hash, 8);
  file.insert(file.end(), bytes.begin(), bytes.end());
  const auto network = decodeNetwork(file, "f");
  messageNames(network);
  if (!network) return;
  const auto again = decodeNetwork(encodeNetwork(*network), "f");
  must(again.ok() && again->points().size() == network->points().size());
  must(again->patches().size() == network->patches().size());
}

void vedit(Bytes bytes) {
  const auto edits = parseJournal(textOf(bytes), "f");
  messageNames(edits);
  if (!edits) return;
  std::string lines;
  for (const Edit& edit : *edits) lines += journalLine(edit.operation) + "\n";
  const auto again = parseJournal(lines, "f");
  must(again.ok() && again->size() == edits->size());
  for (std::size_t i = 0; i < edits->size(); ++i)
    must(journalLine((*again)[i].operation) == journalLine((*edits)[i].operation));
}

void replay(Bytes bytes) {
  const auto edits = parseJournal(textOf(bytes), "f");
  if (!edits || edits->size() > 3) return;
  const Replay replay = replayEdits(limb(), *edits);
  for (const vec4& p : replay.network.points()) must(p.w > 0);
  must(replay.rows.size() == edits->size());
}

std::span<const Target> targets() {
  static constexpr Target all[] = {{"swc", swc},       {"vtp", vtp},        {"vtk", vtk},   {"bvh", bvh},
                                   {"obj", obj},       {"stl", stl},        {"gltf", gltf}, {"map", map},
                                   {"rules", rules},   {"scene", scene},    {"vasa", vasa}, {"vedit", vedit},
                                   {"replay", replay}, {"markups", markups}};
  return all;
}

}  // namespace vasa::fuzz
