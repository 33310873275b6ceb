// One libFuzzer program: VASA_FUZZ_TARGET names the function of fuzz/targets.h.
#include "core/log.h"
#include "fuzz/targets.h"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  vasa::setLogLevel(vasa::LogLevel::quiet);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vasa::fuzz::VASA_FUZZ_TARGET({reinterpret_cast<const std::byte*>(data), size});
  return 0;
}
