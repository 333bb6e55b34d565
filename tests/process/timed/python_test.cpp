/// The Python module: logs, worlds and sessions (check_seam.py), its program, and the examples of
/// docs/examples.

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace python_test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// A recording that all tests read.
class PythonModule : public ::testing::Test {
 protected:
  static std::string Folder() {
    return fs::absolute(fs::path(BuiltProgram("seam")).parent_path() / "python").string();
  }

  static void SetUpTestSuite() {
    made_ = std::make_unique<Workspace>();
    Program lab({BuiltProgram("seam-lab"), "run", "crossing", "--seed", "3", "--no-floor",
                 "--duration", "3", "-o", Log()},
                Root().string());
    ASSERT_TRUE(lab.Wait(60) && lab.status() == 0) << lab.Story();
    Program exported({BuiltProgram("seam-export"), Log(), "--csv", "-o", *made_ / "views.csv"});
    ASSERT_TRUE(exported.Wait(60) && exported.status() == 0) << exported.Story();
    Program cut({BuiltProgram("seam-log"), "cut", Log(), "--from", "1", "-o", *made_ / "cut.lcm"});
    ASSERT_TRUE(cut.Wait(60) && cut.status() == 0) << cut.Story();
  }
  static void TearDownTestSuite() { made_.reset(); }

  void SetUp() override {
    if (!fs::exists(Folder() + "/seam/_seam.so")) {
      GTEST_SKIP() << "the module is not built: `make python` needs python3-numpy and pybind11-dev";
    }
  }

  static std::string Log() { return *made_ / "crossing.lcm"; }

  static std::unique_ptr<Program> Python(Words words) {
    words.insert(words.begin(), {"env", "PYTHONPATH=" + Folder(), "/usr/bin/python3", "-X", "dev"});
    auto program = std::make_unique<Program>(words, Root().string());
    EXPECT_TRUE(program->Wait(120)) << "hangs";
    return program;
  }

  static void Check(const std::string& cases) {
    CheckAs({"tests/process/check_seam.py", Log(), *made_ / "views.csv", cases});
  }
  static void CheckAs(const Words& words) {
    const auto run = Python(words);
    EXPECT_EQ(run->status(), 0) << run->Story();
    EXPECT_NE(run->errors().find("\nOK"), std::string::npos) << run->Story();
  }

  inline static std::unique_ptr<Workspace> made_;
};

TEST_F(PythonModule, ReadsLogsAsArrays) { Check("ReadsLogs"); }
TEST_F(PythonModule, StepsScenes) { Check("StepsScenes"); }
TEST_F(PythonModule, RunsSessionsOfTwoClients) { Check("RunsSessions"); }

TEST_F(PythonModule, KnowsTheLcmTypesAsLcmGenMakesThem) { Check("KnowsLcmTypes"); }
TEST_F(PythonModule, JoinsServersAndDrives) { Check("JoinsServers"); }

TEST_F(PythonModule, ThreadsShareAnObjectAndItTakesOneCallAtATime) {
  CheckAs({"tests/process/check_shared.py", Log(), "SharesObjects"});
}
TEST_F(PythonModule, AHandlerThatRaisesLosesItsOwnMessageAlone) {
  CheckAs({"tests/process/check_shared.py", Log(), "HandlesMessages"});
}
TEST_F(PythonModule, AnErrorThatIsNotKnownHasNoNumber) {
  CheckAs({"tests/process/check_shared.py", *made_ / "cut.lcm", "Measures"});
}

TEST_F(PythonModule, EachExampleRunsAndPrintsWhatItSays) {
  const auto error = Python({"docs/examples/error_over_time.py", Log()});
  EXPECT_EQ(error->status(), 0) << error->Story();
  EXPECT_NE(error->output().find("peer 2    1 s  "), std::string::npos) << error->Story();
  EXPECT_EQ(error->output().find("nan"), std::string::npos) << error->Story();
  const auto step = Python({"docs/examples/step_a_scene.py"});
  EXPECT_EQ(step->status(), 0) << step->Story();
  EXPECT_NE(step->output().find("the same bits: True"), std::string::npos) << step->Story();
  const auto session = Python({"docs/examples/two_clients.py"});
  EXPECT_EQ(session->status(), 0) << session->Story();
  EXPECT_NE(session->output().find("error of others "), std::string::npos) << session->Story();
  int examples = 0;
  for (const auto& file : fs::directory_iterator(Root() / "docs/examples")) {
    examples += file.path().extension() == ".py" ? 1 : 0;
  }
  // The examples of robots, which need the bus, are run by tests/process/timed/lcm_test.cpp.
  EXPECT_EQ(examples, 3 + 2) << "each example is run by a test";
}

TEST_F(PythonModule, ThePrintedMeasuresAreThoseOfSeamMeasure) {
  const auto shown = Python({"-m", "seam", Log()});
  EXPECT_EQ(shown->status(), 0) << shown->Story();
  Program measured({BuiltProgram("seam-measure"), Log(), "--csv", *made_ / "measures.csv"});
  ASSERT_TRUE(measured.Wait(60) && measured.status() == 0) << measured.Story();
  const std::string table = measured.output();
  for (const char* name : {"error_others_m", "stutter_mps2", "bytes_per_s", "seen"}) {
    const std::string text = shown->output();
    const std::size_t at = text.find("  " + std::string(name) + " ");
    ASSERT_NE(at, std::string::npos) << name << "\n" << text;
    const std::size_t begin = text.find_first_not_of(' ', at + 2 + std::string(name).size());
    const std::string number = text.substr(begin, text.find('\n', begin) - begin);
    EXPECT_NE(table.find(" " + number + " "), std::string::npos) << name << " " << number << "\n"
                                                                 << table;
  }
}

TEST_F(PythonModule, ALogWithoutItsBeginningHasMeasuresWithoutErrors) {
  const auto run = Python({"-m", "seam", *made_ / "cut.lcm"});
  EXPECT_EQ(run->status(), 0) << run->Story();
  EXPECT_NE(run->output().find("not valid: the log begins at tick "), std::string::npos)
      << run->Story();
  EXPECT_NE(run->output().find("\n  bytes_per_s "), std::string::npos) << run->Story();
  EXPECT_NE(run->output().find("\n  no oracle: the log begins at tick "), std::string::npos)
      << run->Story();
  EXPECT_EQ(run->output().find("error_others_m"), std::string::npos) << "there is no such number";
}

TEST_F(PythonModule, NamesTheDamagedPartsAsSeamMeasureDoes) {
  const std::string damaged = *made_ / "damaged.lcm";
  fs::copy_file(Log(), damaged);
  std::FILE* file = std::fopen(damaged.c_str(), "r+b");
  ASSERT_NE(file, nullptr);
  std::fseek(file, static_cast<long>(fs::file_size(damaged) / 2), SEEK_SET);
  const std::string zeros(64, 0);
  EXPECT_EQ(std::fwrite(zeros.data(), 1, zeros.size(), file), zeros.size());
  std::fclose(file);
  Program measured({BuiltProgram("seam-measure"), damaged});
  ASSERT_TRUE(measured.Wait(60));
  EXPECT_EQ(measured.status(), 1) << measured.Story();
  for (const Words& words :
       {Words{"-m", "seam", damaged}, Words{"-m", "seam", "--error", damaged}}) {
    const auto run = Python(words);
    EXPECT_EQ(run->status(), 1) << run->Story();
    const std::string says = "python3 -m seam: warning: " + damaged + ": ticks ";
    EXPECT_EQ(run->errors().rfind(says, 0), 0u) << run->Story();
    const std::string line = run->errors().substr(std::string("python3 -m seam").size());
    EXPECT_NE(measured.errors().find(line.substr(0, line.find('\n'))), std::string::npos)
        << measured.Story() << run->Story();
  }
}

TEST_F(PythonModule, AMissingLogIsOneLineAndStatusTwo) {
  const auto run = Python({"-m", "seam", "/nowhere/x.lcm"});
  EXPECT_EQ(run->status(), 2);
  EXPECT_EQ(run->errors().rfind("python3 -m seam: /nowhere/x.lcm: ", 0), 0u) << run->Story();
  EXPECT_EQ(run->errors().find("Traceback"), std::string::npos) << run->Story();
}

}  // namespace python_test
}  // namespace seam
