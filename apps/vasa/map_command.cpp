#include <fmt/format.h>

#include <algorithm>

#include "body/retarget.h"
#include "commands.h"
#include "core/atomic_file.h"
#include "core/log.h"
#include "core/visible.h"
#include "io/bvh.h"
#include "io/gltf.h"
#include "report.h"
#include "scene/scene_file.h"

// vasa map: the pairs of joints by which a motion moves a body, to be read and mended by hand.
namespace vasa::cli {
namespace map_command {

struct Options {
  std::string body, motion, output, jointMap;
};

struct Pairing {
  JointPairs joints;
  HumanoidNames bodyParts, motionParts;
  std::string match;  // how well, or why not
  float sureness = 0;
};

Result<Pairing> pair(const Body& body, const Motion& motion, const JointMap& map) {
  auto joints = matchedJoints(motion, body, map);
  if (!joints) return joints.error();
  Pairing pairing{std::move(*joints), partsOf(body.skeleton), partsOf(motion), {}, 0};
  const auto done = retargeted(motion, body, map);
  pairing.match = done ? describeMatch(*done) : done.error().message;
  pairing.sureness = done ? done->sureness : 0;
  return pairing;
}

const TrunkShare* shareOf(const Pairing& pairing, std::uint32_t joint) {
  const auto& shares = pairing.joints.spread.shares;
  const auto found = std::ranges::find(shares, joint, &TrunkShare::joint);
  return found == shares.end() ? nullptr : &*found;
}

std::string mapText(const Body& body, const Motion& motion, const Pairing& pairing) {
  std::string text = fmt::format(
      "# {} moves {}\n# {}\n# A line a pair: motion's joint = body's joint; nothing on the right leaves the joint out.\n",
      visible(motion.name), visible(body.name), visible(pairing.match));
  const auto& joints = body.skeleton.joints;
  for (std::size_t m = 0; m < motion.joints.size(); ++m) {
    bool any = false;
    for (std::uint32_t j = 0; j < joints.size(); ++j) {
      if (pairing.joints.source[j] != m || shareOf(pairing, j)) continue;
      text += fmt::format("{} = {}", jointMapName(motion.joints[m].name), jointMapName(joints[j].name));
      text += pairing.bodyParts.of[j].empty() ? "\n" : fmt::format("  # {}\n", pairing.bodyParts.of[j]);
      any = true;
    }
    if (!any) text += fmt::format("# {} =\n", jointMapName(motion.joints[m].name));
  }
  if (!pairing.joints.spread.shares.empty())
    text +=
        "# Joints of the body's trunk, which has more or fewer than the motion's: each takes shares of two.\n";
  for (const TrunkShare& own : pairing.joints.spread.shares)
    text += fmt::format("#   {}: {:.0f} % of {}, {:.0f} % of {}\n", visible(joints[own.joint].name),
                        100 * (1 - own.share), visible(motion.joints[own.low].name), 100 * own.share,
                        visible(motion.joints[own.high].name));
  text += "# Joints of the body that follow nothing, and go with the one before them:\n";
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (pairing.joints.source[j] == JointId::kNone) text += fmt::format("#   {}\n", visible(joints[j].name));
  return text;
}

Report asReport(const Body& body, const Motion& motion, const Pairing& pairing) {
  Report report{{"pairs", Report::array()},
                {"shares", Report::array()},
                {"motion_free", Report::array()},
                {"body_free", Report::array()}};
  std::vector<bool> used(motion.joints.size());
  const auto& source = pairing.joints.source;
  for (std::uint32_t j = 0; j < source.size(); ++j) {
    const std::string& name = body.skeleton.joints[j].name;
    if (source[j] == JointId::kNone) {
      report["body_free"].push_back(name);
      continue;
    }
    if (const TrunkShare* own = shareOf(pairing, j)) {
      used[own->low] = used[own->high] = true;
      report["shares"].push_back({{"body", name},
                                  {"motion", {motion.joints[own->low].name, motion.joints[own->high].name}},
                                  {"share", own->share}});
      continue;
    }
    used[source[j]] = true;
    report["pairs"].push_back(
        {{"motion", motion.joints[source[j]].name}, {"body", name}, {"part", pairing.bodyParts.of[j]}});
  }
  for (std::size_t m = 0; m < used.size(); ++m)
    if (!used[m]) report["motion_free"].push_back(motion.joints[m].name);
  report["sureness"] = pairing.sureness;
  report["match"] = pairing.match;
  return report;
}

// A body instead of a motion: what vasa fit pairs, which asks for the new body's joints on the left.
Result<Motion> readMotion(const std::string& file) {
  if (isMotionFile(file)) return readBvh(file);
  const auto other = readBody(file);
  if (!other) return other.error();
  return standingStill(*other);
}

Result<void> run(const Globals& globals, const Options& options) {
  if (options.output == "-" && globals.json)
    return Error{Fault::usage, "-o - and --json both write to standard output; leave one of them out"};
  const auto body = readBody(options.body);
  if (!body) return body.error();
  const auto motion = readMotion(options.motion);
  if (!motion) return motion.error();
  JointMap map;
  if (!options.jointMap.empty()) {
    auto read = readJointMap(options.jointMap);
    if (!read) return read.error();
    map = std::move(*read);
  }
  const auto pairing = pair(*body, *motion, map);
  if (!pairing) return pairing.error();
  const std::string text = mapText(*body, *motion, *pairing);
  const bool toFile = !options.output.empty() && options.output != "-";
  if (toFile)
    if (const auto written = writeFileAtomically(options.output, text); !written) return written.error();
  if (globals.json) return printJson(asReport(*body, *motion, *pairing));
  if (!toFile) return printText(text);
  return printText(pairing->match + "\nwritten    " + options.output +
                   "; mend it where a pair is wrong, and give it with --joint-map\n");
}

}  // namespace map_command

void addMap(CLI::App& app, Command& command) {
  using namespace map_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand(
      "map", "Which joint of a motion moves which joint of a body, as a file to mend by hand");
  sub->footer(
      "Examples:\n"
      "  vasa map body.glb dance.bvh\n"
      "  vasa map body.glb dance.bvh -o map.txt\n"
      "  vasa render --body body.glb --network body.vasa --clip dance.bvh --joint-map map.txt -o 'out/{frame:04}.png'\n"
      "  vasa map adult.glb child.glb -o joints.txt   (for vasa fit --from adult.glb --to child.glb)\n"
      "Joints are paired by their names, by the words in them, or by the skeletons' shapes (vasa help bodies); the file says\n"
      "how sure that is.");
  sub->add_option("BODY", options->body, "A body with a skeleton (glTF)")->required();
  sub->add_option("MOTION", options->motion,
                  "A motion (.bvh), or the body that vasa fit is to carry vessels to")
      ->required();
  sub->add_option("-o,--output", options->output, "The file to write; none, or -: standard output");
  sub->add_option("--joint-map", options->jointMap, "Pairs that are known already");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
