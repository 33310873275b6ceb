#pragma once
#include "core/kept.h"
#include "support/shared_data.h"

namespace vasa::test {

/// While it is there, what takes long to make of a body and its vessels (core/kept.h) is computed once for
/// all of this process's cases, as the program itself keeps it from run to run: for cases that ask for
/// something else. That results are the same with it and without, tests/cli/prepare_test.cpp shows.
class KeptOnce {
 public:
  /// @param grows  what is computed anew is kept, too; false: only what has been kept is found
  explicit KeptOnce(bool grows = true) {
    if (grows)
      setKeptFolders({.shipped = {}, .own = folder(), .engine = 1});
    else
      setKeptFolders({.shipped = {folder()}, .own = {}, .engine = 1});
  }
  ~KeptOnce() { setKeptFolders({}); }
  KeptOnce(const KeptOnce&) = delete;
  KeptOnce& operator=(const KeptOnce&) = delete;

 private:
  static const std::filesystem::path& folder() {
    static const TemporaryFolder made;
    return made.path();
  }
};

}  // namespace vasa::test
