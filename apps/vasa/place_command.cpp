#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "above_zero.h"
#include "body/carry.h"
#include "body/retarget.h"
#include "commands.h"
#include "core/log.h"
#include "core/nearest_names.h"
#include "edit/replay.h"
#include "io/gltf.h"
#include "math/similarity.h"
#include "network/file.h"
#include "network/measure.h"
#include "network/reshape.h"
#include "network_output.h"
#include "report.h"
#include "scene/vessel_files.h"

// vasa place: a network that stands elsewhere moved into a body: turned, moved and scaled, by hand or by
// landmarks.
namespace vasa::cli {
namespace place_command {

struct Options {
  std::string network, body, output;
  std::vector<std::string> at, turns;
  std::vector<float> move;
  float scale = 1;
  bool rigid = false, exact = false;
};

std::optional<std::vector<float>> numbersIn(std::string_view text, std::size_t count) {
  std::vector<float> values;
  while (true) {
    const std::size_t comma = std::min(text.find(','), text.size());
    float value = 0;
    const auto [stop, fault] = std::from_chars(text.data(), text.data() + comma, value);
    if (fault != std::errc{} || stop != text.data() + comma || !std::isfinite(value)) return std::nullopt;
    values.push_back(value);
    if (comma == text.size()) break;
    text.remove_prefix(comma + 1);
  }
  return values.size() == count ? std::optional(values) : std::nullopt;
}

// "abdominal aorta:end": start, end, or a share of its way; its middle where nothing is said.
Result<vec3> placeOnVessel(const Network& network, std::span<const vec4> points, const std::string& text) {
  std::string name = text;
  float share = 0.5f;
  if (const std::size_t colon = text.rfind(':'); colon != text.npos) {
    const std::string where = text.substr(colon + 1);
    const auto number = numbersIn(where, 1);
    if (where == "start" || where == "end" || (number && (*number)[0] >= 0 && (*number)[0] <= 1)) {
      name = text.substr(0, colon);
      share = where == "start" ? 0.0f : where == "end" ? 1.0f : (*number)[0];
    }
  }
  const auto vessel = findVessel(network, name);
  if (!vessel)
    return badInput("--at \"" + text + "\": " + vessel.error().message +
                    (name == text && text.find(':') != text.npos
                         ? "; behind a colon stands start, end or a share from 0 to 1"
                         : ""));
  const Vessel& found = network.vessel(*vessel);
  return vec3(evaluate(Network::pointsOf(found, points), share * float(found.spanCount())));
}

std::optional<JointId> jointNamed(const Body& body, const HumanoidNames& parts, const std::string& name) {
  if (const JointId joint = body.skeleton.find(name); joint.valid()) return joint;
  for (std::uint32_t j = 0; j < parts.of.size(); ++j)
    if (!parts.of[j].empty() && parts.of[j] == name) return JointId{j};
  return std::nullopt;
}

// "0.1,1.2,0", a joint, or "leftUpperLeg/rightUpperLeg": halfway between two.
Result<vec3> placeInBody(const std::optional<Body>& body, const std::string& text) {
  if (const auto xyz = numbersIn(text, 3)) return vec3((*xyz)[0], (*xyz)[1], (*xyz)[2]);
  if (!body)
    return Error{Fault::usage, "--at ...=" + text +
                                   ": a joint needs its body; add --body FILE.glb, or give x,y,z in metres"};
  const HumanoidNames parts = partsOf(body->skeleton);
  vec3 sum(0);
  const std::size_t slash = text.find('/');
  for (const std::string& name :
       {text.substr(0, slash), slash == text.npos ? text : text.substr(slash + 1)}) {
    const auto joint = jointNamed(*body, parts, name);
    if (!joint) {
      std::vector<std::string> names;
      for (const Skeleton::Joint& each : body->skeleton.joints) names.push_back(each.name);
      return badInput(body->name + " has no joint '" + name + "'; " +
                      didYouMean(name, names, "vasa info --joints lists them"));
    }
    sum += 0.5f * vec3(body->skeleton.joints[joint->value].restWorld[3]);
  }
  return sum;
}

Result<quat> turnOf(const std::vector<std::string>& turns) {
  quat all(1, 0, 0, 0);
  for (const std::string& text : turns) {
    const auto degrees =
        text.size() > 2 && text[1] == ':' ? numbersIn(std::string_view(text).substr(2), 1) : std::nullopt;
    const int axis = text.empty() ? -1 : text[0] - 'x';
    if (!degrees || axis < 0 || axis > 2)
      return Error{Fault::usage, "--turn " + text + ": must be x:, y: or z: and degrees, such as x:-90"};
    vec3 about(0);
    about[axis] = 1;
    all = glm::angleAxis((*degrees)[0] * kPi / 180, about) * all;
  }
  return all;
}

struct Placing {
  Similarity by;
  float worst = 0;  // [m] of the landmarks
};

Result<Placing> placingOf(const Options& options, const Network& network, const std::optional<Body>& body) {
  const auto turn = turnOf(options.turns);
  if (!turn) return turn.error();
  const vec3 move = options.move.empty() ? vec3(0) : vec3(options.move[0], options.move[1], options.move[2]);
  Placing placing{{options.scale, *turn, vec3(0)}, 0};
  std::vector<std::pair<vec3, vec3>> pairs;
  for (const std::string& text : options.at) {
    const std::size_t sign = text.find('=');
    if (sign == text.npos)
      return Error{Fault::usage, "--at " + text + ": must be VESSEL[:start|end|0..1]=JOINT or =x,y,z"};
    const auto from = placeOnVessel(network, network.points(), text.substr(0, sign));
    if (!from) return from.error();
    const auto to = placeInBody(body, text.substr(sign + 1));
    if (!to) return to.error();
    pairs.push_back({placing.by(*from), *to});
  }
  // Landmarks turn and scale what is already turned and scaled.
  const Similarity fit = fitSimilarity(pairs, options.rigid);
  placing.by = {fit.scale * options.scale, fit.turn * *turn, fit.move + move};
  for (const auto& [from, to] : pairs) placing.worst = std::max(placing.worst, glm::distance(fit(from), to));
  return placing;
}

std::string asText(const Report& report) {
  std::string text = fmt::format(
      "placed     {} vessels: times {:.4f}, turned by {:.1f} degrees, moved by {:.1f}, {:.1f}, {:.1f} mm\n",
      report["vessels"].get<std::size_t>(), report["scale"].get<double>(),
      report["turn_degrees"].get<double>(), 1e3 * report["move_m"][0].get<double>(),
      1e3 * report["move_m"][1].get<double>(), 1e3 * report["move_m"][2].get<double>());
  if (report["landmarks"].get<std::size_t>() > 0)
    text += fmt::format("landmarks  {}, the worst {:.1f} mm off\n", report["landmarks"].get<std::size_t>(),
                        report["landmark_worst_mm"].get<double>());
  if (report.contains("outside_skin_share"))
    text +=
        fmt::format("outside    {:.2f} % of the length lies outside the skin, {:.2f} % by more than 5 mm\n",
                    100 * report["outside_skin_share"].get<double>(),
                    100 * report["outside_by_5_mm_share"].get<double>());
  return text + fmt::format("written    {}: {} bytes\n", plainText(report["file"]),
                            report["file_bytes"].get<std::size_t>());
}

Result<void> run(const Globals& globals, const Options& options) {
  if (auto writable = checkNetworkOutput(options.output); !writable) return writable.error();
  std::optional<Body> body;
  if (!options.body.empty()) {
    auto read = readBody(options.body);
    if (!read) return read.error();
    body = std::move(*read);
  }
  auto network = readVessels(options.network, body ? body->height() : 0);
  if (!network) return network.error();
  const auto placing = placingOf(options, *network, body);
  if (!placing) return placing.error();
  std::vector<vec4> points(network->points().begin(), network->points().end());
  for (vec4& p : points) p = vec4(placing->by(vec3(p)), placing->by.scale * p.w);
  const auto placed =
      reshapeNetwork(*network, points, body ? body->height() : placing->by.scale * network->bodyHeight());
  if (!placed) return badInput(options.network + ": " + placed.error().message);
  const auto bytes = writeNetwork(options.output, *placed, {.quantise = !options.exact});
  if (!bytes) return bytes.error();
  const vec3 move = placing->by.move;
  Report report{{"file", options.output},
                {"file_bytes", *bytes},
                {"vessels", placed->vessels().size()},
                {"scale", placing->by.scale},
                {"turn_degrees", 2 * std::acos(std::min(1.0f, std::abs(placing->by.turn.w))) * 180 / kPi},
                {"move_m", {move.x, move.y, move.z}},
                {"landmarks", options.at.size()},
                {"landmark_worst_mm", 1e3 * placing->worst},
                {"length_m", measure(*placed, placed->points()).length}};
  if (body) {
    const SkinReport outside = measureOutside(*placed, placed->points(), *body);
    if (outside.length > 0)
      report["outside_skin_share"] = outside.outside / outside.length,
      report["outside_by_5_mm_share"] = outside.outside5mm / outside.length;
    else
      logInfo("how much lies outside " + body->name + " is not known: it has no skin");
  }
  return globals.json ? printJson(report) : printText(asText(report));
}

}  // namespace place_command

void addPlace(CLI::App& app, Command& command) {
  using namespace place_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand(
      "place", "Move, turn and scale a network that stands elsewhere into a body, by hand or by landmarks");
  sub->footer(
      "Examples:\n"
      "  vasa place scan.vasa --turn x:-90 --move 0,1.1,0 -o placed.vasa\n"
      "  vasa place aorta.vasa --body body.glb --at 'aorta:start=chest' --at 'aorta:end=hips' -o placed.vasa\n"
      "  vasa place tree.vasa --body body.glb --at 'aorta:end=leftUpperLeg/rightUpperLeg' --at 'arch:0.5=0,1.38,0.01' --rigid -o placed.vasa\n"
      "Turns come first, in the order given, about the origin; then the scale; then landmarks, which bring a place of a vessel to a\n"
      "joint (by its name, by the part of a person that it is, or halfway between two) or to x,y,z in metres: one moves, two turn\n"
      "and scale as well, three or more turn all the way; then the move. Vessels of a whole other body are carried by vasa fit.");
  sub->add_option("NETWORK", options->network, "The network (.vasa, or anything that convert reads)")
      ->required();
  sub->add_option("-o,--output", options->output, "The network to write (.vasa)")->required();
  sub->add_option("--body", options->body, "The body that it is placed in (glTF)");
  sub->add_option(
         "--at", options->at,
         "A landmark: VESSEL[:start|end|0..1]=JOINT, =JOINT/JOINT or =x,y,z; may be given several times")
      ->take_all()
      ->allow_extra_args(false);
  sub->add_option("--turn", options->turns, "x:, y: or z: and degrees; may be given several times")
      ->take_all()
      ->allow_extra_args(false);
  sub->add_option("--scale", options->scale, "Times this size")->check(aboveZero())->capture_default_str();
  sub->add_option("--move", options->move, "x,y,z in metres")->delimiter(',')->expected(3);
  sub->add_flag("--rigid", options->rigid, "Landmarks do not change the size");
  sub->add_flag("--exact", options->exact, "Write 32-bit floats, 16 bytes a point");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
