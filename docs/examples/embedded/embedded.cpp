// Draws vessels on a Vulkan device that belongs to another program, which reads the picture itself.
// usage: embedded BODY.glb NETWORK.vasa CLIP SECONDS OUT.ppm
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>

#include <vasa/gpu/device.h>
#include <vasa/gpu/image.h>
#include <vasa/render/renderer.h>
#include <vasa/scene/frame.h>
#include <vasa/scene/scene.h>

#include "host.h"

namespace {

constexpr std::uint32_t kWidth = 480, kHeight = 640;

int draw(Host& host, char** argv) {
  vasa::SceneFile file;
  file.body = argv[1];
  file.networks = {argv[2]};
  const auto scene = vasa::loadScene(file);
  if (!scene) return std::fprintf(stderr, "%s\n", scene.error().message.c_str()), 1;
  const auto clip = vasa::findClip(scene->body, argv[3]);
  if (!clip) return std::fprintf(stderr, "%s\n", clip.error().message.c_str()), 1;

  // The host's device, in vasa's hands until the end of this function.
  vasa::gpu::Device device(
      {host.instance, host.physical, host.device, host.queue, host.queueFamily, host.enabled});
  vasa::Renderer renderer(device, scene->network, scene->body.meshes, {.width = kWidth, .height = kHeight});

  vasa::FrameMaker maker(*scene, {.avoid = true});
  maker.make(*clip, std::strtof(argv[4], nullptr));
  const vasa::Camera camera =
      vasa::cameraFrom(vasa::View::front, vasa::motionBounds(*scene, *clip), float(kWidth) / kHeight);
  renderer.draw({.points = maker.points(),
                 .knotFrames = maker.knotFrames(),
                 .jointMatrices = maker.jointMatrices(),
                 .camera = camera,
                 .look = {}});

  // What was drawn is an image of the host's device like any other.
  const std::vector<std::uint8_t> pixels = host.read(renderer.picture().handle(), kWidth, kHeight);
  std::ofstream out(argv[5], std::ios::binary);
  out << "P6 " << kWidth << ' ' << kHeight << " 255\n";
  for (std::size_t i = 0; i < pixels.size(); i += 4) out.write(reinterpret_cast<const char*>(&pixels[i]), 3);
  return out.flush() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) return std::fprintf(stderr, "usage: embedded BODY NETWORK CLIP SECONDS OUT.ppm\n"), 2;
  try {
    Host host;
    return draw(host, argv);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
}
