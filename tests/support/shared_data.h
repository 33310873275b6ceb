#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vasa::test {

/// The folder of real anatomy beside the checkout (../shared/data, or $VASA_SHARED_DATA), if it is there.
std::optional<std::filesystem::path> sharedData();

/// The project's own root.
std::filesystem::path sourceDirectory();

/// All bytes of a file, none where it cannot be read.
std::string contentOf(const std::filesystem::path& file);

/// What a folder holds, in no order.
std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder);

/// A fresh, empty folder for one test's files, removed when the object goes.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace vasa::test

/// Leaves the test case with a message where the real data is absent; `var` is the folder otherwise.
#define VASA_REQUIRE_SHARED_DATA(var)                 \
  const auto var##Found = ::vasa::test::sharedData(); \
  if (!var##Found) {                                  \
    MESSAGE("skipped: shared data not present");      \
    return;                                           \
  }                                                   \
  const std::filesystem::path var = *var##Found
