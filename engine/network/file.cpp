#include "network/file.h"

#include <cmath>
#include <cstring>

#include "core/atomic_file.h"
#include "core/hash.h"
#include "network/builder.h"
#include "network/file_bytes.h"
#include "network/patch_chunk.h"

// Quantised points: ends that hang on nodes are re-pinned on reading, from points that lie on the grid
// exactly, so reading a quantised file and writing it again gives the same bytes.
namespace vasa {
namespace {

constexpr char kMagic[4] = {'V', 'A', 'S', 'A'};
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderBytes = 24;

struct Grid {
  vec3 origin{0};
  std::int8_t exponent = 0;
  float radiusStep = 1;
  float step() const { return std::ldexp(1.0f, exponent); }

  vec4 decode(const std::uint16_t q[4]) const {
    return {origin + step() * vec3(q[0], q[1], q[2]), radiusStep * float(q[3])};
  }
  void encode(const vec4& p, std::uint16_t q[4]) const {
    for (int axis = 0; axis < 3; ++axis)
      q[axis] = std::uint16_t(std::clamp(std::round((p[axis] - origin[axis]) / step()), 0.0f, kGridSteps));
    q[3] = std::uint16_t(std::clamp(std::round(p.w / radiusStep), 1.0f, kGridSteps));
  }
};

Grid gridOf(std::span<const vec4> points) {
  Aabb box;
  float radius = 0;
  for (const vec4& p : points) {
    box.add(vec3(p));
    radius = std::max(radius, p.w);
  }
  Grid grid;
  if (points.empty()) return grid;
  int exponent = -40;  // finer than any float needs
  while (std::ldexp(kGridSteps - 1, exponent) < box.size()) ++exponent;
  grid.exponent = std::int8_t(exponent);
  for (int axis = 0; axis < 3; ++axis)
    grid.origin[axis] = std::round(box.low[axis] / grid.step()) * grid.step();
  grid.radiusStep = radius / kGridSteps;
  return grid;
}

void encodePoints(const Network& network, bool quantise, PortableWriter& out) {
  PortableWriter payload;
  if (!quantise) {
    for (const vec4& p : network.points()) payload.raw(p);
    out.chunk("PNTS", payload);
    return;
  }
  const Grid grid = gridOf(network.points());
  payload.raw(grid.origin);
  payload.raw(grid.exponent);
  payload.raw(grid.radiusStep);
  std::vector<vec4> snapped;
  std::uint16_t q[4];
  for (const vec4& p : network.points()) {
    grid.encode(p, q);
    snapped.push_back(grid.decode(q));
  }
  pinEnds(network, snapped);
  for (const vec4& p : snapped) {
    grid.encode(p, q);
    for (const std::uint16_t value : q) payload.raw(value);
  }
  out.chunk("PNTQ", payload);
}

struct Contents {
  float bodyHeight = 0;
  std::vector<std::pair<NetworkBuilder::Label, std::size_t>> vessels;  // with their point counts
  std::vector<std::pair<std::optional<Host>, std::vector<VesselEnd>>> nodes;
  std::vector<vec4> points;
  std::vector<ForkPatch> patches;
  std::string fault;  // of a chunk, where there is more to say than that it is malformed
  bool meta = false, vessel = false, node = false, point = false, patch = false;
};

// A name may be some bytes in the file and thousands in memory, as it shares what the one before has.
constexpr std::size_t kNameTimes = 4, kFreeNames = std::size_t(16) << 20;

bool readVessels(std::span<const std::byte> payload, Contents& contents) {
  PortableReader in(payload);
  NetworkBuilder::Label before;
  const std::size_t mostText = kNameTimes * payload.size() + kFreeNames;
  std::size_t left = in.count(6), text = 0;
  for (contents.vessels.reserve(left); left && in.ok(); --left) {
    NetworkBuilder::Label label;
    const auto kind = in.raw<std::uint8_t>();
    if (kind > std::uint8_t(VesselKind::other)) return false;
    label.kind = VesselKind(kind);
    label.name = in.text(before.name);
    label.ontologyId = in.text(before.ontologyId);
    before = label;
    text += label.name.size() + label.ontologyId.size();
    if (text > mostText) {
      contents.fault = "its names are longer than the " + std::to_string(mostText) +
                       " bytes accepted for a file of this size";
      return false;
    }
    const std::uint64_t points = in.number();
    if (points > 0x7fffffff) return false;
    contents.vessels.emplace_back(std::move(label), std::size_t(points));
  }
  return in.ok() && in.empty();
}

bool readNodes(PortableReader in, Contents& contents) {
  std::size_t left = in.count(2);
  for (contents.nodes.reserve(left); left && in.ok(); --left) {
    std::optional<Host> host;
    if (in.raw<std::uint8_t>()) {
      const std::uint64_t vessel = in.number();
      host = Host{{std::uint32_t(std::min<std::uint64_t>(vessel, 0xfffffffe))}, in.raw<float>()};
    }
    std::vector<VesselEnd> ends;
    for (std::size_t n = in.count(1); n && in.ok(); --n) {
      const std::uint64_t code = in.number();
      ends.push_back({{std::uint32_t(std::min<std::uint64_t>(code / 2, 0xfffffffe))}, code % 2 == 1});
    }
    contents.nodes.emplace_back(host, std::move(ends));
  }
  return in.ok() && in.empty();
}

bool readExactPoints(std::span<const std::byte> payload, Contents& contents) {
  if (payload.size() % sizeof(vec4)) return false;
  contents.points.resize(payload.size() / sizeof(vec4));
  if (!payload.empty()) std::memcpy(contents.points.data(), payload.data(), payload.size());
  return true;
}

bool readQuantisedPoints(PortableReader in, Contents& contents) {
  Grid grid;
  grid.origin = in.raw<vec3>();
  grid.exponent = in.raw<std::int8_t>();
  grid.radiusStep = in.raw<float>();
  while (in.ok() && !in.empty()) {
    std::uint16_t q[4];
    for (std::uint16_t& value : q) value = in.raw<std::uint16_t>();
    contents.points.push_back(grid.decode(q));
  }
  return in.ok();
}

bool readChunk(const std::string& tag, std::span<const std::byte> payload, Contents& contents) {
  const auto first = [](bool& seen) { return !std::exchange(seen, true); };
  if (tag == "META") {
    PortableReader in(payload);
    contents.bodyHeight = in.raw<float>();
    return first(contents.meta) && in.ok();
  }
  if (tag == "VESL") return first(contents.vessel) && readVessels(payload, contents);
  if (tag == "NODE") return first(contents.node) && readNodes(PortableReader(payload), contents);
  if (tag == "PNTS") return first(contents.point) && readExactPoints(payload, contents);
  if (tag == "PNTQ") return first(contents.point) && readQuantisedPoints(PortableReader(payload), contents);
  if (tag == "PTCH") return first(contents.patch) && readPatches(payload, contents.patches);
  return true;
}

Result<Network> build(Contents contents, const std::string& name) {
  if (contents.vessels.size() > contents.points.size() / kMinPoints ||
      contents.nodes.size() > 2 * contents.vessels.size())
    return badInput(name + ": " + std::to_string(contents.vessels.size()) + " vessels and " +
                    std::to_string(contents.nodes.size()) + " nodes are more than " +
                    std::to_string(contents.points.size()) + " points can make; write the file anew");
  NetworkBuilder builder;
  std::size_t next = 0;
  for (auto& [label, count] : contents.vessels) {
    if (count > contents.points.size() - next)
      return badInput(name + ": vessel '" + label.name +
                      "' claims more points than the file holds; write the file anew");
    const auto begin = contents.points.begin() + std::ptrdiff_t(next);
    builder.addVessel(std::move(label), {begin, begin + std::ptrdiff_t(count)});
    next += count;
  }
  if (next != contents.points.size())
    return badInput(name + ": holds " + std::to_string(contents.points.size()) + " points, its vessels use " +
                    std::to_string(next) + "; write the file anew");
  for (auto& [host, ends] : contents.nodes) builder.addNode(host, std::move(ends));
  auto network = builder.build(contents.bodyHeight);
  if (network && !contents.patches.empty())
    network = withPatches(std::move(*network), std::move(contents.patches));
  if (!network) return Error{network.error().fault, name + ": " + network.error().message};
  return network;
}

}  // namespace

float quantisationError(const Network& network) { return 0.5f * gridOf(network.points()).step(); }

std::vector<std::byte> encodeNetwork(const Network& network, NetworkFileOptions options) {
  PortableWriter meta, vessels, nodes, body, file;
  meta.raw(network.bodyHeight());
  vessels.number(network.vessels().size());
  const Vessel none;
  const Vessel* before = &none;
  for (const Vessel& vessel : network.vessels()) {
    vessels.raw(std::uint8_t(vessel.kind));
    vessels.text(vessel.name, before->name);
    vessels.text(vessel.ontologyId, before->ontologyId);
    vessels.number(vessel.pointCount);
    before = &vessel;
  }
  nodes.number(network.nodes().size());
  for (const Node& node : network.nodes()) {
    nodes.raw(std::uint8_t(node.host.has_value()));
    if (node.host) {
      nodes.number(node.host->vessel.value);
      nodes.raw(node.host->parameter);
    }
    nodes.number(node.endCount);
    for (const VesselEnd& end : network.ends(node))
      nodes.number(2 * std::uint64_t(end.vessel.value) + end.last);
  }
  body.chunk("META", meta);
  body.chunk("VESL", vessels);
  body.chunk("NODE", nodes);
  encodePoints(network, options.quantise, body);
  if (!network.patches().empty()) body.chunk("PTCH", patchPayload(network.patches()));
  for (const char letter : kMagic) file.raw(letter);
  file.raw(kVersion);
  file.raw(std::uint64_t(body.bytes.size()));
  file.raw(hashBytes(body.bytes));
  file.append(body.bytes);
  return file.bytes;
}

Result<Network> decodeNetwork(std::span<const std::byte> bytes, const std::string& name) {
  PortableReader header(bytes);
  const auto magic = header.take(sizeof(kMagic));
  if (!header.ok() || std::memcmp(magic.data(), kMagic, sizeof(kMagic)) != 0)
    return badInput(name + ": is not a .vasa file (it does not begin with VASA); make one with vasa convert");
  const auto version = header.raw<std::uint32_t>();
  if (header.ok() && version != kVersion)
    return badInput(name + ": version " + std::to_string(version) + ", but this program reads version " +
                    std::to_string(kVersion) + "; convert the vessels again");
  const auto length = header.raw<std::uint64_t>();
  const auto checksum = header.raw<std::uint64_t>();
  if (!header.ok() || length != bytes.size() - kHeaderBytes)
    return badInput(name + ": has " + std::to_string(bytes.size()) +
                    " bytes, not as many as its header says; copy it again");
  const auto body = bytes.subspan(kHeaderBytes);
  if (hashBytes(body) != checksum)
    return badInput(name + ": the checksum does not match, so the file is damaged; copy it again");
  Contents contents;
  PortableReader in(body);
  while (in.ok() && !in.empty()) {
    const auto letters = in.take(4);
    const std::string tag(reinterpret_cast<const char*>(letters.data()), letters.size());
    const auto payload = in.take(in.raw<std::uint32_t>());
    if (!in.ok() || !readChunk(tag, payload, contents))
      return badInput(name + ": chunk '" + tag + "' at byte " +
                      std::to_string(letters.data() - bytes.data()) + " is malformed" +
                      (contents.fault.empty() ? "" : ": " + contents.fault) + "; write the file anew");
  }
  if (!contents.meta || !contents.vessel || !contents.point)
    return badInput(name + ": a chunk is missing (META, VESL and points are needed); write the file anew");
  return build(std::move(contents), name);
}

Result<std::size_t> writeNetwork(const std::filesystem::path& path, const Network& network,
                                 NetworkFileOptions options) {
  const auto bytes = encodeNetwork(network, options);
  if (auto written = writeFileAtomically(path, bytes); !written) return written.error();
  return bytes.size();
}

Result<Network> readNetwork(const std::filesystem::path& path) {
  const auto bytes = readFile(path);
  if (!bytes) return bytes.error();
  return decodeNetwork(*bytes, path.string());
}

}  // namespace vasa
