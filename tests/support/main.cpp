#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
// --reporters=processor: the processor seconds of each case and of the programs that it starts. Wall seconds
// (--duration) say little on a machine that does other things, too.
#include <doctest/doctest.h>
#include <sys/resource.h>

#include <cstdio>

namespace {

double processorSeconds() {
  double seconds = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    getrusage(who, &used);
    for (const timeval& time : {used.ru_utime, used.ru_stime})
      seconds += double(time.tv_sec) + 1e-6 * double(time.tv_usec);
  }
  return seconds;
}

struct ProcessorReporter : doctest::IReporter {
  explicit ProcessorReporter(const doctest::ContextOptions&) {}
  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_run_end(const doctest::TestRunStats&) override {}
  void test_case_start(const doctest::TestCaseData& started) override {
    case_ = &started;
    before_ = processorSeconds();
  }
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_end(const doctest::CurrentTestCaseStats&) override {
    std::printf("%8.2f s  %s\n", processorSeconds() - before_, case_->m_name);
    std::fflush(stdout);
  }
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}

 private:
  const doctest::TestCaseData* case_ = nullptr;
  double before_ = 0;
};

REGISTER_REPORTER("processor", 1, ProcessorReporter);

}  // namespace
