// Writes a made-up tube network: make_tubes TUBES SEED OUT.txt
#include <charconv>
#include <cstdio>
#include <cstring>

#include "support/tube_network.h"

namespace {

bool number(const char* text, std::uint32_t& value) {
  const auto [end, fault] = std::from_chars(text, text + std::strlen(text), value);
  return fault == std::errc() && *end == 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint32_t tubes = 0, seed = 0;
  if (argc != 4 || !number(argv[1], tubes) || !number(argv[2], seed)) {
    std::fputs("usage: make_tubes TUBES SEED OUT.txt\n", stderr);
    return 2;
  }
  const auto written = vasa::writeTubeList(argv[3], vasa::test::makeTubeNetwork(tubes, seed));
  if (written) return 0;
  std::fprintf(stderr, "error: %s\n", written.error().message.c_str());
  return int(written.error().fault);
}
