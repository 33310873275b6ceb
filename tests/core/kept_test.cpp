#include "core/kept.h"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <mutex>
#include <numeric>
#include <thread>

#include "core/isolated.h"
#include "core/parallel.h"
#include "support/shared_data.h"

using namespace vasa;

namespace {

namespace fs = std::filesystem;

// Folders for one test; the process keeps nothing before and after.
struct Keeping {
  explicit Keeping(KeptFolders folders) { setKeptFolders(std::move(folders)); }
  ~Keeping() { setKeptFolders({}); }
};

std::vector<std::byte> bytesOf(std::size_t count, int first = 1) {
  std::vector<std::byte> bytes(count);
  for (std::size_t k = 0; k < count; ++k) bytes[k] = std::byte((int(k) + first) & 255);
  return bytes;
}

std::uintmax_t sizeOf(const fs::path& folder) {
  std::uintmax_t sum = 0;
  for (const fs::path& file : test::filesIn(folder)) sum += fs::file_size(file);
  return sum;
}

void change(const fs::path& path, std::streamoff at) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(at);
  const char before = char(file.get());
  file.seekp(at);
  file.put(char(before ^ 1));
}

}  // namespace

TEST_CASE("what is kept is found again, by kind, key and engine") {
  const test::TemporaryFolder folder;
  const Keeping keeping({.shipped = {}, .own = folder.path() / "new" / "vasa", .engine = 7});
  CHECK_FALSE(findKept("things", 1));
  keep("things", 1, bytesOf(1000));
  keep("things", 2, {});
  REQUIRE(keptAll().ok());
  CHECK(findKept("things", 1) == bytesOf(1000));
  CHECK(findKept("things", 2) == std::vector<std::byte>{});
  CHECK_FALSE(findKept("others", 1));
  CHECK_FALSE(findKept("things", 3));
  keep("things", 1, bytesOf(10));
  CHECK(findKept("things", 1) == bytesOf(10));
  CHECK(test::filesIn(folder.path() / "new" / "vasa").size() == 2);
  setKeptFolders({.shipped = {}, .own = folder.path() / "new" / "vasa", .engine = 8});
  CHECK_FALSE(findKept("things", 1));
}

TEST_CASE("a program that names no folder keeps nothing") {
  setKeptFolders({});
  keep("things", 1, bytesOf(10));
  CHECK_FALSE(findKept("things", 1));
  CHECK(keptAll().ok());
}

TEST_CASE("what ships is found, and never written") {
  const test::TemporaryFolder folder;
  {
    const Keeping making({.shipped = {}, .own = folder.path() / "ships", .engine = 7});
    keep("things", 1, bytesOf(100));
  }
  const Keeping keeping({.shipped = {folder.path() / "nowhere", folder.path() / "ships"},
                         .own = folder.path() / "own",
                         .engine = 7});
  CHECK(findKept("things", 1) == bytesOf(100));
  CHECK_FALSE(fs::exists(folder.path() / "own"));
  keep("things", 2, bytesOf(100));
  CHECK(test::filesIn(folder.path() / "ships").size() == 1);
  CHECK(test::filesIn(folder.path() / "own").size() == 1);
}

TEST_CASE("a damaged, cut, longer or foreign file is not found, and is renewed") {
  const test::TemporaryFolder folder;
  const Keeping keeping({.shipped = {}, .own = folder.path(), .engine = 7});
  keep("things", 1, bytesOf(1000));
  const fs::path file = test::filesIn(folder.path()).front();
  const std::uintmax_t whole = fs::file_size(file);
  const auto renewed = [&] {
    const bool lost = !findKept("things", 1);
    keep("things", 1, bytesOf(1000));
    return lost && findKept("things", 1) == bytesOf(1000);
  };
  // Its engine, key, hash and size, and what it holds.
  for (const std::streamoff at : {0, 8, 16, 24, 31, 32, 500, 1031}) {
    CAPTURE(at);
    change(file, at);
    CHECK(renewed());
  }
  for (const std::uintmax_t size :
       {std::uintmax_t(0), std::uintmax_t(5), std::uintmax_t(32), whole - 1, whole + 1}) {
    CAPTURE(size);
    fs::resize_file(file, size);
    CHECK(renewed());
  }
  std::ofstream(file, std::ios::trunc) << "a file of somebody else's, by the same name";
  CHECK(renewed());
  fs::remove(file);
  fs::create_directory(file);
  CHECK_FALSE(findKept("things", 1));
  fs::remove(file);
  REQUIRE(mkfifo(file.c_str(), 0600) == 0);  // nobody writes: who reads waits for ever
  CHECK_FALSE(findKept("things", 1));
}

TEST_CASE("the folder's bound holds: what nobody has used for longest goes first, and other files stay") {
  const test::TemporaryFolder folder;
  const Keeping keeping({.shipped = {}, .own = folder.path(), .engine = 7, .most = 4 * 1032});
  std::ofstream(folder.path() / "view.json") << std::string(5000, ' ');
  const auto age = [&](std::uint64_t key, int hours) {
    for (const fs::path& file : test::filesIn(folder.path()))
      if (file.filename().string().starts_with("things-000000000000000" + std::to_string(key)))
        fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours));
  };
  for (const std::uint64_t key : {1, 2, 3, 4}) keep("things", key, bytesOf(1000));
  age(1, 4), age(2, 3), age(3, 2), age(4, 1);
  CHECK(findKept("things", 1));  // used now
  keep("things", 5, bytesOf(1000));
  CHECK(findKept("things", 1));
  CHECK_FALSE(findKept("things", 2));
  for (const std::uint64_t key : {3, 4, 5}) CHECK(findKept("things", key));
  for (std::uint64_t key = 10; key < 30; ++key) {
    keep("things", key, bytesOf(10 * key));
    CHECK(sizeOf(folder.path()) <= 5000 + 4 * 1032);
    CHECK(findKept("things", key));
  }
  keep("things", 99, bytesOf(5000));  // more than all of it: nothing goes for it
  CHECK_FALSE(findKept("things", 99));
  CHECK(findKept("things", 29));
  CHECK(keptAll().error().message.find("more than the 4128") != std::string::npos);
  CHECK(fs::exists(folder.path() / "view.json"));
}

TEST_CASE("where nothing can be written the program goes on, and says why when it is asked") {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "no folder";
  const Keeping keeping({.shipped = {}, .own = folder.path() / "file" / "vasa", .engine = 7});
  keep("things", 1, bytesOf(10));
  CHECK_FALSE(findKept("things", 1));
  REQUIRE_FALSE(keptAll().ok());
  CHECK(keptAll().error().fault == Fault::io);
  setKeptFolders({.shipped = {}, .own = "/dev/full/vasa", .engine = 7});
  CHECK(keptAll().ok());
}

TEST_CASE("threads that keep and find the same at once get it whole or not at all") {
  const test::TemporaryFolder folder;
  const Keeping keeping({.shipped = {}, .own = folder.path(), .engine = 7, .most = 20'000});
  std::atomic<int> wrong = 0, found = 0;
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread)
    threads.emplace_back([&, thread] {
      for (int round = 0; round < 50; ++round) {
        const std::uint64_t key = std::uint64_t(round + thread) % 5;
        keep("things", key, bytesOf(6000, int(key)));
        if (const auto kept = findKept("things", key)) ++found, wrong += *kept != bytesOf(6000, int(key));
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
  CHECK(found > 0);
  CHECK(sizeOf(folder.path()) <= 20'000);
}

TEST_CASE("a loop in what is done once takes up no round of the loop around it") {
  for (int attempt = 0; attempt < 20; ++attempt) {
    std::once_flag once;
    std::vector<int> sums(64);
    parallelFor(sums.size(), 1, [&](std::size_t i) {
      std::call_once(once, [] {
        isolated([] {
          std::vector<int> squares(64);
          parallelFor(squares.size(), 1, [&](std::size_t k) {
            std::this_thread::sleep_for(std::chrono::microseconds(20));
            squares[k] = int(k * k);
          });
        });
      });
      sums[i] = int(i);
    });
    CHECK(std::accumulate(sums.begin(), sums.end(), 0) == 63 * 32);
  }
}
