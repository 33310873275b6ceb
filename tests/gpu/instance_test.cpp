#include "gpu/instance.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdlib>

#include "gpu/adapter.h"
#include "gpu/error.h"
#include "gpu/gpu_rig.h"

using namespace vasa;

namespace {

// Sets a variable for the life of the object. The loader reads these anew for each instance.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* set = std::getenv(name)) before_ = set;
    setenv(name, value, 1);
  }
  ~Variable() { before_.empty() ? unsetenv(name_) : setenv(name_, before_.c_str(), 1); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::string before_;
};

}  // namespace

TEST_CASE("without a driver the message says what to install") {
  const Variable files("VK_DRIVER_FILES", "/nonexistent/driver.json");
  const Variable oldName("VK_ICD_FILENAMES", "/nonexistent/driver.json");
  const auto adapters = gpu::attempt([] { return gpu::listAdapters(); });
  REQUIRE(!adapters.ok());
  CHECK(adapters.error().fault == Fault::noDevice);
  CHECK(adapters.error().message ==
        "no Vulkan driver is installed (vkCreateInstance: VK_ERROR_INCOMPATIBLE_DRIVER); install "
        "mesa-vulkan-drivers or your GPU's driver");
}

TEST_CASE("a driver whose device is not in this machine counts as no device") {
  // Mesa's driver for AMD's GPUs comes with the same package as the software device.
  const char* absent = "/usr/share/vulkan/icd.d/radeon_icd.x86_64.json";
  if (access(absent, R_OK) != 0) {
    MESSAGE("skipped: no driver without a device is installed");
    return;
  }
  const Variable files("VK_DRIVER_FILES", absent);
  const Variable oldName("VK_ICD_FILENAMES", absent);
  const auto adapters = gpu::attempt([] { return gpu::listAdapters(); });
  if (adapters.ok()) {
    MESSAGE("skipped: this machine has such a device");
    return;
  }
  CHECK(adapters.error().fault == Fault::noDevice);
  CHECK(adapters.error().message.find("mesa-vulkan-drivers") != std::string::npos);
}

TEST_CASE("a missing validation layer is said clearly") {
  const Variable path("VK_LAYER_PATH", "/nonexistent");
  CHECK_THROWS_WITH_AS(
      gpu::Instance({.validation = {.core = true}}),
      "VK_LAYER_KHRONOS_validation is not installed; install vulkan-validationlayers or switch "
      "validation off",
      gpu::Error);
}

TEST_CASE("the layer's switches leave the environment as it was") {
  VASA_REQUIRE_GPU(rig);
  CHECK(std::getenv("VK_LAYER_ENABLES") == nullptr);
  const Variable set("VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT");
  { const gpu::Instance instance({.validation = {.synchronization = true}}); }
  CHECK(std::string(std::getenv("VK_LAYER_ENABLES")) == "VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT");
}
