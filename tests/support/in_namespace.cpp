#include "tests/support/in_namespace.h"

#include <cstdlib>
#include <filesystem>
#include <map>

#include "tests/support/program.h"

namespace seam {
namespace {

constexpr const char* kInside = "SEAM_TEST_SUITE_IN_NAMESPACE";
/// Longest that a suite may take, s; normal 20 to 80, on a busy machine three times that.
constexpr double kSuiteSecondsMax = 600;

/// Output of a suite's run inside, or the reason that there was none.
struct SuiteRun {
  std::string text;
  std::string skip_reason;
  std::string story;  ///< of a run that did not end well
};

SuiteRun RunInside(const ::testing::TestSuite& suite, const std::string& network) {
  SuiteRun run;
  Program probe({"unshare", "-rn", "sh", "-c", network});
  if (!probe.Wait(20) || probe.status() != 0) {
    run.skip_reason = "no network namespace of its own: " + probe.errors();
    return run;
  }
  std::string filter = "--gtest_filter=";
  for (int i = 0; i < suite.total_test_count(); ++i) {
    const ::testing::TestInfo& test = *suite.GetTestInfo(i);
    if (test.should_run()) filter += std::string(suite.name()) + "." + test.name() + ":";
  }
  // The filter says which tests; a part of them (tests/run.sh) is no longer to be taken.
  Program inside(
      {"unshare", "-rn", "env", "-u", "GTEST_TOTAL_SHARDS", "-u", "GTEST_SHARD_INDEX",
       std::string(kInside) + "=1", "LCM_DEFAULT_URL=", "sh", "-c", network + "; exec \"$@\"", "sh",
       std::filesystem::read_symlink("/proc/self/exe").string(), filter, "--gtest_color=no"});
  const bool ended = inside.Wait(kSuiteSecondsMax);
  run.text = inside.output();
  if (!ended || (inside.status() != 0 && inside.status() != 1)) {
    run.story = (ended ? "" : "hangs; ") + inside.Story();
  }
  return run;
}

}  // namespace

bool InNamespace::Enter(const std::string& network) {
  if (std::getenv(kInside) != nullptr) return true;
  const auto& suite = *::testing::UnitTest::GetInstance()->current_test_suite();
  static std::map<std::string, SuiteRun> runs;
  if (runs.count(suite.name()) == 0) runs[suite.name()] = RunInside(suite, network);
  const SuiteRun& run = runs[suite.name()];
  skip_reason_ = run.skip_reason;
  if (!skip_reason_.empty()) return false;

  const std::string test = std::string(suite.name()) + "." +
                           ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::size_t begin = run.text.find("[ RUN      ] " + test + "\n");
  const std::size_t ok = run.text.find("[       OK ] " + test + " (", begin);
  const std::size_t skipped = run.text.find("[  SKIPPED ] " + test + " (", begin);
  if (begin != std::string::npos && ok != std::string::npos) return false;
  std::size_t end = run.text.find("[ RUN      ] ", begin == std::string::npos ? 0 : begin + 1);
  const std::string words =
      begin == std::string::npos ? "it did not run" : run.text.substr(begin, end - begin);
  if (begin != std::string::npos && skipped != std::string::npos) {
    skip_reason_ = words;
  } else {
    ADD_FAILURE() << words << run.story;
  }
  return false;
}

}  // namespace seam
