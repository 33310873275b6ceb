#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/cancellation.h"
#include "paper_easel.h"

// Figure 4: a Y, a T and a crossing, the thickest of the network. Only the vessels that meet there are shown.
namespace vasa::cli {
namespace {

struct Arm {
  VesselId vessel;
  vec3 direction;  // unit, away from the fork
  float radius, length;
};

struct Fork {
  vec3 place{0};
  std::vector<Arm> arms;

  float thinnest() const { return std::ranges::min(arms, {}, &Arm::radius).radius; }
  float thickest() const { return std::ranges::max(arms, {}, &Arm::radius).radius; }
};

constexpr float kArm = 5;  // radii of an arm that a picture shows

// @param reach  [m] looked at, at most
Arm armAt(const Network& network, VesselId id, float from, bool forwards, float reach) {
  const auto points = network.pointsOf(network.vessel(id));
  const float end = forwards ? float(spanCount(points)) : 0, step = forwards ? 0.125f : -0.125f;
  const vec4 start = evaluate(points, from);
  Arm arm{id, {}, start.w, 0};
  vec4 last = start;
  for (float u = from; arm.length < reach && std::abs(end - u) > 0.01f;) {
    u = forwards ? std::min(end, u + step) : std::max(end, u + step);
    const vec4 next = evaluate(points, u);
    arm.length += glm::distance(vec3(next), vec3(last));
    last = next;
  }
  const vec3 way = vec3(last) - vec3(start);
  arm.direction = arm.length > 0 ? glm::normalize(way + 1e-9f) : vec3(0, 1, 0);
  arm.radius = std::min(start.w, last.w);
  return arm;
}

Fork forkAt(const Network& network, const Node& node) {
  struct Start {
    VesselId vessel;
    float at;
    bool forwards;
  };
  std::vector<Start> starts;
  for (const VesselEnd& end : network.ends(node)) {
    const float spans = float(network.vessel(end.vessel).spanCount());
    starts.push_back({end.vessel, end.last ? spans : 0, !end.last});
  }
  if (node.host)
    for (const bool forwards : {true, false})
      starts.push_back({node.host->vessel, node.host->parameter, forwards});
  const auto sectionAt = [&](const Start& start) {
    return evaluate(network.pointsOf(network.vessel(start.vessel)), start.at);
  };
  float thickest = 0;
  for (const Start& start : starts) thickest = std::max(thickest, sectionAt(start).w);
  Fork fork{vec3(sectionAt(starts.front())), {}};
  for (const Start& start : starts)
    fork.arms.push_back(armAt(network, start.vessel, start.at, start.forwards, kArm * thickest));
  return fork;
}

enum class Kind { y, t, crossing };

std::optional<Kind> kindOf(const Node& node) {
  if (node.valence() == 4) return Kind::crossing;
  if (node.valence() != 3) return std::nullopt;
  return node.host ? Kind::t : Kind::y;
}

// At right angles to the two arms that lie farthest from one line.
vec3 faceOn(const Fork& fork) {
  vec3 best(0, 0, 1);
  float widest = 0;
  for (std::size_t i = 0; i < fork.arms.size(); ++i)
    for (std::size_t j = i + 1; j < fork.arms.size(); ++j) {
      const vec3 normal = glm::cross(fork.arms[i].direction, fork.arms[j].direction);
      if (glm::length(normal) > widest) widest = glm::length(normal), best = normal;
    }
  best = glm::normalize(best);
  return best.z < 0 ? -best : best;
}

// The thickest fork of a kind whose arms are all long enough, and of nearly one plane and size.
std::optional<Fork> choose(const Network& network, Kind kind) {
  std::optional<Fork> best;
  float most = 0;
  for (const Node& node : network.nodes()) {
    if (kindOf(node) != kind) continue;
    Fork fork = forkAt(network, node);
    const vec3 normal = faceOn(fork);
    float likeness = fork.thinnest() / fork.thickest();
    for (const Arm& arm : fork.arms) {
      if (arm.length < 0.6f * kArm * fork.thickest()) likeness = 0;
      likeness *= 1 - std::min(1.0f, std::abs(glm::dot(arm.direction, normal)));
    }
    // As thick as may be, unless another is much more of a picture.
    const float score = likeness * std::sqrt(fork.thinnest());
    if (score > most) most = score, best = std::move(fork);
  }
  return best;
}

std::vector<char> spansOf(const Network& network, const Fork& fork) {
  std::vector<char> spans;
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const bool meets = std::ranges::any_of(fork.arms, [&](const Arm& arm) { return arm.vessel.value == v; });
    spans.insert(spans.end(), network.vessels()[v].spanCount(), char(meets));
  }
  return spans;
}

}  // namespace

Result<PaperFigure> junctionFigure(const PaperStudy& study, gpu::Device& device) {
  PaperFigure figure{
      "Visually smooth connection of sweep surfaces: (a) Y-junction, (b) T-junction and (c) crossing.",
      {},
      Report::array(),
      {}};
  const Network& network = study.scene.network;
  Easel easel(study, device, {.network = network, .table = &study.table}, {360, 360});
  for (const auto& [kind, name] :
       {std::pair{Kind::y, "(a) Y"}, {Kind::t, "(b) T"}, {Kind::crossing, "(c) crossing"}}) {
    checkpoint();
    const auto fork = choose(network, kind);
    if (!fork) {
      figure.note += fmt::format("The network has no {}. ", name);
      continue;
    }
    Aabb box;
    box.add(fork->place, 0.7f * kArm * fork->thickest());
    easel.showOnly(spansOf(network, *fork));
    figure.panels.push_back({name, easel.draw(cameraOn(box, faceOn(*fork), easel.aspect()), pageLook())});
    Report vessels = Report::array();
    for (const Arm& arm : fork->arms) vessels.push_back(network.vessel(arm.vessel).name);
    vessels.erase(std::unique(vessels.begin(), vessels.end()), vessels.end());
    figure.facts.push_back({{"junction", name}, {"vessels", vessels}});
  }
  return figure;
}

}  // namespace vasa::cli
