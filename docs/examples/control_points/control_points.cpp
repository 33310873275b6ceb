// Poses a body's vessels without drawing them. No Vulkan, no window: vasa::scene alone.
// usage: control_points BODY.glb NETWORK.vasa CLIP SECONDS VESSEL
#include <vasa/scene/frame.h>
#include <vasa/scene/scene.h>
#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc != 6) return std::fprintf(stderr, "usage: control_points BODY NETWORK CLIP SECONDS VESSEL\n"), 2;

  // A body with skeleton and clips, the vessels in it, and how they hang on it.
  vasa::SceneFile file;
  file.body = argv[1];
  file.networks = {argv[2]};
  const auto scene = vasa::loadScene(file);
  if (!scene) return std::fprintf(stderr, "%s\n", scene.error().message.c_str()), 1;
  const auto clip = vasa::findClip(scene->body, argv[3]);
  const auto subject = vasa::findSubject(*scene, argv[5]);
  if (!clip || !subject || !subject->vessel.valid())
    return std::fprintf(stderr, "there is no such clip, or no such vessel\n"), 1;

  // Pose the joints, carry the vessels along, keep their volumes, move them apart where they touch.
  vasa::FrameMaker maker(*scene, {.avoid = true});
  maker.make(*clip, std::strtof(argv[4], nullptr));

  // The vessel's B-spline: de Boor points x y z and radius, in metres.
  const vasa::Vessel& vessel = scene->network.vessel(subject->vessel);
  std::printf("# %s\n", vessel.name.c_str());
  for (const vasa::vec4& p : vasa::Network::pointsOf(vessel, maker.points()))
    std::printf("%.6f %.6f %.6f %.6f\n", p.x, p.y, p.z, p.w);

  // Whether every pair of vessels is apart is not hoped but proven.
  const vasa::AvoidReport& avoid = maker.report().avoid;
  std::fprintf(
      stderr, "%s\n",
      avoid.after.holds() ? "certified: no vessel runs through another" : "some vessels still touch");
}
