#include "core/log.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdio>

using namespace vasa;

namespace {

// What is said to standard error meanwhile.
template <class Act>
std::string saidBy(Act act) {
  std::FILE* file = std::tmpfile();
  REQUIRE(file);
  std::fflush(stderr);
  const int before = dup(STDERR_FILENO);
  dup2(fileno(file), STDERR_FILENO);
  act();
  std::fflush(stderr);
  dup2(before, STDERR_FILENO);
  close(before);
  std::rewind(file);
  std::string text(1000, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  return text;
}

}  // namespace

TEST_CASE("held warnings are said at the end, once, or not at all") {
  CHECK(saidBy([] {
          HeldWarnings outer;
          logWarning("first");
          {
            HeldWarnings inner;
            logWarning("second");
            logInfo("meanwhile");
          }
          logWarning("third");
        }) == "meanwhile\nwarning: first\nwarning: second\nwarning: third\n");
  CHECK(saidBy([] {
          HeldWarnings held;
          logWarning("of a first reading");
          held.drop();
          logWarning("of the second");
        }) == "warning: of the second\n");
}
