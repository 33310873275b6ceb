#include "core/atomic_file.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "support/shared_data.h"

using namespace vasa;

TEST_CASE("a file appears whole, replacing what was there") {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  REQUIRE(writeFileAtomically(path, std::string("first")).ok());
  REQUIRE(writeFileAtomically(path, std::string("second")).ok());
  const auto bytes = readFile(path);
  REQUIRE(bytes.ok());
  CHECK(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) == "second");
  CHECK(test::filesIn(folder.path()).size() == 1);
}

TEST_CASE("a file that is not committed leaves nothing and keeps the old content") {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  REQUIRE(writeFileAtomically(path, std::string("old")).ok());
  {
    auto file = AtomicFile::create(path);
    REQUIRE(file.ok());
    REQUIRE(file->write(std::as_bytes(std::span("new", 3))).ok());
  }
  CHECK(test::filesIn(folder.path()).size() == 1);
  CHECK(readFile(path)->size() == 3);
}

TEST_CASE("a process that is killed while it writes leaves nothing, or what the next one removes") {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  std::ofstream(path) << "old";
  const pid_t child = fork();
  if (child == 0) {
    auto file = AtomicFile::create(path);
    if (file.ok() && file->write(std::as_bytes(std::span("new", 3))).ok()) raise(SIGKILL);
    _exit(1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFSIGNALED(status));
  CHECK(readFile(path)->size() == 3);
  const pid_t next = fork();
  if (next == 0) _exit(writeFileAtomically(folder.path() / "b.txt", std::string("b")).ok() ? 0 : 1);
  REQUIRE(waitpid(next, &status, 0) == next);
  CHECK(status == 0);
  CHECK(test::filesIn(folder.path()).size() == 2);
}

TEST_CASE("files in progress that nobody writes any more are removed, others are left alone") {
  test::TemporaryFolder folder;
  const auto make = [&](const char* name) {
    return open((folder.path() / name).c_str(), O_CREAT | O_WRONLY, 0600);
  };
  close(make(".vasa-1-1.part"));
  close(make("user.part"));
  const int held = make(".vasa-1-2.part");
  REQUIRE(flock(held, LOCK_EX) == 0);
  REQUIRE(writeFileAtomically(folder.path() / "a.txt", std::string("a")).ok());
  CHECK(!std::filesystem::exists(folder.path() / ".vasa-1-1.part"));
  CHECK(std::filesystem::exists(folder.path() / ".vasa-1-2.part"));
  CHECK(std::filesystem::exists(folder.path() / "user.part"));
  close(held);
}

TEST_CASE("what is replaced keeps its mode, and a link goes on leading to it") {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt", link = folder.path() / "link";
  REQUIRE(writeFileAtomically(path, std::string("old")).ok());
  REQUIRE(chmod(path.c_str(), 0640) == 0);
  std::filesystem::create_symlink("a.txt", link);
  REQUIRE(writeFileAtomically(link, std::string("newer")).ok());
  CHECK(std::filesystem::is_symlink(link));
  CHECK(readFile(path)->size() == 5);
  struct stat status {};
  REQUIRE(stat(path.c_str(), &status) == 0);
  CHECK((status.st_mode & 07777) == 0640);
}

TEST_CASE("a name may be as long as the file system allows") {
  test::TemporaryFolder folder;
  const auto path = folder.path() / std::string(255, 'n');
  for (const char* text : {"first", "second"}) CHECK(writeFileAtomically(path, std::string(text)).ok());
  CHECK(test::filesIn(folder.path()).size() == 1);
  const auto refused = writeFileAtomically(folder.path() / std::string(256, 'n'), std::string("x"));
  REQUIRE(!refused.ok());
  CHECK(refused.error().message.find("choose a shorter name") != std::string::npos);
}

TEST_CASE("a limit on file sizes is told, and nothing is left") {
  test::TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    const auto result = writeFileAtomically(folder.path() / "a.txt", std::string(5000, 'x'));
    _exit(!result.ok() && result.error().fault == Fault::io &&
                  result.error().message.find("ulimit -f") != std::string::npos
              ? 0
              : 1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(status == 0);
  CHECK(test::filesIn(folder.path()).size() == 0);
}

TEST_CASE("a full disk is told, with the remedy") {
  const auto result = writeFileAtomically("/dev/full", std::string(100000, 'x'));
  REQUIRE(!result.ok());
  CHECK(result.error().fault == Fault::io);
  CHECK(result.error().message ==
        "/dev/full: cannot write: No space left on device; free some space or write elsewhere");
}

TEST_CASE("an absent folder is told") {
  test::TemporaryFolder folder;
  const auto result = writeFileAtomically(folder.path() / "no" / "a.txt", std::string("x"));
  REQUIRE(!result.ok());
  CHECK(result.error().message.find("create the folder first") != std::string::npos);
}

TEST_CASE("reading refuses what is no regular file, at once") {
  test::TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  for (const auto& path : {pipe, folder.path(), std::filesystem::path("/dev/zero")}) {
    const auto result = readFile(path);
    REQUIRE(!result.ok());
    CHECK(result.error().fault == Fault::io);
    CHECK(result.error().message.find("is not a regular file") != std::string::npos);
  }
  CHECK(readFile(folder.path() / "absent").error().message.find("No such file") != std::string::npos);
}

TEST_CASE("a file over the limit is refused as bad input") {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "big";
  REQUIRE(writeFileAtomically(path, std::string(100, 'x')).ok());
  const auto result = readFile(path, 99);
  REQUIRE(!result.ok());
  CHECK(result.error().fault == Fault::badInput);
}
