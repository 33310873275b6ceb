// Times the renderer over a turning camera; prints minimum and median of each stage and the last picture's
// hash.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "body/skinning.h"
#include "core/hash.h"
#include "gpu/device.h"
#include "io/gltf.h"
#include "io/png.h"
#include "network/file.h"
#include "network/measure.h"
#include "render/renderer.h"
#include "taken.h"

using namespace vasa;

namespace {

constexpr int kWarmUp = 5, kFrames = 40;
constexpr const char* kUsage =
    "usage: bench_render BODY.glb NETWORK.vasa [MxN|auto[:PIXELS][/all] [TEMPLATE_BYTES [SAMPLES [WxH [VIEW [OUT.png]]]]]]\n";

void print(const char* name, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::printf("  %-12s min %8.2f  median %8.2f ms\n", name, values.front(), values[values.size() / 2]);
}

struct Arguments {
  RenderOptions options;
  std::string picture;
  View view = View::front;
};

// "/all" at the end: nothing is culled.
void readQuads(const std::string& text, RenderOptions& options) {
  options.cull = !text.ends_with("/all");
  if (text.starts_with("auto"))
    options.pixelError = text.size() > 4 && text[4] == ':' ? std::stof(text.substr(5)) : kAutoPixelError;
  else
    std::sscanf(text.c_str(), "%ux%u", &options.shape.around, &options.shape.along);
}

Arguments argumentsOf(int argc, char** argv) {
  Arguments a;
  if (argc > 3) readQuads(argv[3], a.options);
  if (argc > 4) a.options.templateBytes = std::uint32_t(std::atoi(argv[4]));
  if (argc > 5) a.options.samples = std::uint32_t(std::atoi(argv[5]));
  if (argc > 6) std::sscanf(argv[6], "%ux%u", &a.options.width, &a.options.height);
  if (argc > 7) a.view = viewNamed(argv[7]).value_or(View::front);
  if (argc > 8) a.picture = argv[8];
  return a;
}

Camera turned(const Camera& camera, float angle) {
  Camera result = camera;
  result.position = camera.target + glm::angleAxis(angle, vec3(0, 1, 0)) * (camera.position - camera.target);
  return result;
}

// Without the timer's barriers: what a frame of what `look` shows costs, also of all cores together, which
// says more on a machine that has other work.
void timeAlone(const char* name, Renderer& renderer, RenderInput input, const Look& look) {
  const Camera camera = input.camera;
  input.look = look;
  std::vector<double> total, cores;
  for (int i = kWarmUp + kFrames; i-- > 0;) {
    input.camera = turned(camera, 0.05f * float(i));
    const std::clock_t start = std::clock();
    renderer.draw(input);
    if (i >= kFrames) continue;
    cores.push_back(1e3 * double(std::clock() - start) / CLOCKS_PER_SEC);
    total.push_back(renderer.times().total);
  }
  print(name, total);
  print("  all cores", cores);
}

void timeAlone(Renderer& renderer, const RenderInput& input) {
  Look tubes, bones, skin;
  tubes.drawBones = tubes.drawHeart = tubes.drawSkin = tubes.drawOther = false;
  bones.drawArteries = bones.drawVeins = bones.drawOtherVessels = skin.drawArteries = skin.drawVeins =
      skin.drawOtherVessels = false;
  Look none = bones;
  bones.drawSkin = skin.drawBones = skin.drawHeart = skin.drawOther = false;
  none.drawBones = none.drawHeart = none.drawOther = none.drawSkin = false;
  timeAlone("everything", renderer, input, input.look);
  timeAlone("tubes alone", renderer, input, tubes);
  timeAlone("bones alone", renderer, input, bones);
  timeAlone("skin alone", renderer, input, skin);
  timeAlone("nothing", renderer, input, none);
}

void timeFrames(Renderer& renderer, RenderInput& input) {
  const Camera camera = input.camera;
  std::vector<double> upload, tessellate, forks, draw, meshes, total;
  for (int i = kWarmUp + kFrames; i-- > 0;) {
    input.camera = turned(camera, 0.05f * float(i));
    renderer.draw(input);
    if (i >= kFrames) continue;
    const FrameTimes t = renderer.times();
    upload.push_back(t.upload), tessellate.push_back(t.tessellate), forks.push_back(t.forks),
        draw.push_back(t.draw);
    meshes.push_back(t.meshes), total.push_back(t.total);
  }
  print("upload", upload), print("tessellate", tessellate), print("forks", forks), print("draw", draw),
      print("meshes", meshes);
  print("total", total);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return std::fputs(kUsage, stderr), 2;
  const Body body = taken(readBody(argv[1]));
  const Network network = taken(readNetwork(argv[2]));
  const Arguments arguments = argumentsOf(argc, argv);
  gpu::Device device;
  Renderer renderer(device, network, body.meshes, arguments.options);
  std::printf("%s: %u sweeps, %ux%u quads, %llu triangles, templates of %u, in all %llu bytes\n",
              device.adapter().name.c_str(), renderer.sweepCount(), arguments.options.shape.around,
              arguments.options.shape.along, static_cast<unsigned long long>(renderer.triangleCount()),
              arguments.options.templateBytes, static_cast<unsigned long long>(renderer.templateBytes()));

  std::vector<quat> frames(network.sectionCount());
  networkFrames(network, network.points(), restReferences(network), frames);
  const std::vector<mat4> joints = skinMatrices(body.skeleton, restPose(body.skeleton));
  Aabb box = measure(network, network.points()).bounds;
  for (const SkinnedMesh& mesh : body.meshes) box.add(mesh.mesh.bounds());
  const float aspect = float(arguments.options.width) / float(arguments.options.height);
  RenderInput input{network.points(), frames, joints, cameraFrom(arguments.view, box, aspect), {}};
  timeFrames(renderer, input);
  std::printf("  drawn %llu triangles\n", static_cast<unsigned long long>(renderer.drawnTriangleCount()));
  std::printf("  static draw  min %8.2f ms\n", renderer.staticDraw(input, 10));
  RenderOptions untimed = arguments.options;
  untimed.timed = false;
  Renderer alone(device, network, body.meshes, untimed);
  timeAlone(alone, input);
  renderer.draw(input);
  const Image image = renderer.readBack();
  std::printf("  picture %016llx\n",
              static_cast<unsigned long long>(hashOf(std::span<const std::uint8_t>(image.rgba))));
  if (arguments.picture.empty()) return 0;
  const Result<void> written = writePng(arguments.picture, image);
  if (!written)
    return std::fprintf(stderr, "%s\n", written.error().message.c_str()), int(written.error().fault);
  return 0;
}
