#include <cstdio>
#include <filesystem>

#include "core/atomic_file.h"
#include "core/log.h"
#include "make_human/glb.h"
#include "make_human/human.h"
#include "network/file.h"

namespace {

vasa::Result<void> generate(const std::filesystem::path& tables, const std::filesystem::path& out) {
  using namespace vasa;
  Result<human::Human> made = human::makeHuman(tables);
  if (!made.ok()) return made.error();
  const std::vector<std::byte> body = human::writeGlb(made->rig, made->meshes, made->clips);
  if (const Result<void> written = writeFileAtomically(out / "human.glb", body); !written.ok())
    return written;
  const Result<std::size_t> network = writeNetwork(out / "human.vasa", made->vessels);
  if (!network.ok()) return network.error();
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs(
        "usage: make_human TABLES OUT\n\nMakes OUT/human.glb and OUT/human.vasa of the tables in a folder.\n",
        stderr);
    return int(vasa::Fault::usage);
  }
  const vasa::Result<void> done = generate(argv[1], argv[2]);
  if (done.ok()) return 0;
  vasa::logError(done.error().message);
  return int(done.error().fault);
}
