/// The engine of seam-lab's tables: files that survive any interruption, processes that harm no
/// other, and a probe with its axes.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "common/base/check.h"
#include "common/scene/scene.h"
#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/experiment/jobs.h"
#include "tests/lab/experiment/probes.h"
#include "tests/lab/experiment/result_table.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_experiment_test {

const char* const kHeader = "name,size,value";
const std::vector<std::string> kKeys = {"\"a,1\",1", "\"a \"\"2\"\"\",2", "b,3", "c,4"};

std::string LineOf(std::size_t row) { return kKeys[row] + "," + std::to_string(row * 11); }

std::string WholeTable() {
  std::string text = std::string(kHeader) + "\n";
  for (std::size_t i = 0; i < kKeys.size(); ++i) text += LineOf(i) + "\n";
  return text;
}

/// Adds all rows that are missing; returns how many.
int Complete(const std::string& path) {
  ResultTable table(path, "name,size", "value", kKeys, false);
  int added = 0;
  for (std::size_t i = 0; i < kKeys.size(); ++i) {
    if (table.Has(i)) continue;
    table.Add(i, LineOf(i));
    ++added;
  }
  EXPECT_EQ(table.count(), kKeys.size());
  return added;
}

TEST(ResultTable, ATruncatedTableIsCompletedToTheSameFile) {
  const LabWorkspace files;
  const std::string whole = WholeTable();
  for (std::size_t cut = 0; cut <= whole.size(); ++cut) {
    files.Write("t.csv", whole.substr(0, cut));
    const auto complete_lines =
        std::count(whole.begin(), whole.begin() + static_cast<long>(cut), '\n');
    EXPECT_EQ(Complete(files / "t.csv"), 4 - std::max(0L, static_cast<long>(complete_lines) - 1));
    EXPECT_EQ(files.Read("t.csv"), whole) << "cut at " << cut;
  }
  EXPECT_EQ(files.Names(), std::vector<std::string>{"t.csv"});
}

TEST(ResultTable, ARowIsThereAtOnceAndInItsPlaceWhenAllAre) {
  const LabWorkspace files;
  const std::string header = std::string(kHeader) + "\n";
  files.Write("t.csv", header + LineOf(3) + "\n" + LineOf(1) + "\n");
  {
    ResultTable table(files / "t.csv", "name,size", "value", kKeys, false);
    EXPECT_EQ(table.count(), 2u);
    table.Add(0, LineOf(0));
    EXPECT_EQ(files.Read("t.csv"), header + LineOf(1) + "\n" + LineOf(3) + "\n" + LineOf(0) + "\n");
  }
  ResultTable table(files / "t.csv", "name,size", "value", kKeys, false);
  EXPECT_EQ(files.Read("t.csv"), header + LineOf(0) + "\n" + LineOf(1) + "\n" + LineOf(3) + "\n");
  table.Add(2, LineOf(2));
  EXPECT_EQ(files.Read("t.csv"), WholeTable());
}

TEST(ResultTable, HasOneWriterAtATime) {
  const LabWorkspace files;
  const auto open = [&] { ResultTable(files / "t.csv", "name,size", "value", kKeys, false); };
  {
    ResultTable table(files / "t.csv", "name,size", "value", kKeys, false);
    std::string why;
    try {
      open();
    } catch (const OperatorError& error) {
      why = error.what();
    }
    EXPECT_NE(why.find("process " + std::to_string(getpid()) + " writes it"), std::string::npos)
        << why;
    table.Add(0, LineOf(0));
  }
  open();
  EXPECT_EQ(files.Names(), std::vector<std::string>{"t.csv"}) << "the lock goes with its holder";
  files.Write("t.csv.lock", "a host, process 1");  // killed: nobody holds it
  open();
  EXPECT_EQ(files.Names(), std::vector<std::string>{"t.csv"});
}

TEST(ResultTable, KeepsTheFileOfAnotherTable) {
  const LabWorkspace files;
  const std::string header = std::string(kHeader) + "\n";
  for (const std::string& text :
       {std::string("a letter\n"), std::string("a letter"), header + "d,5,0\n",
        header + LineOf(0) + ",1\n", header + LineOf(0) + "\n" + LineOf(0) + "\n", header + "\n"}) {
    files.Write("t.csv", text);
    EXPECT_THROW(ResultTable(files / "t.csv", "name,size", "value", kKeys, false), OperatorError)
        << text;
    EXPECT_EQ(files.Read("t.csv"), text);
    ResultTable(files / "t.csv", "name,size", "value", kKeys, true);
    EXPECT_EQ(files.Read("t.csv"), header);
  }
  EXPECT_THROW(ResultTable(files / "no/t.csv", "name,size", "value", kKeys, false), OperatorError);
}

TEST(ResultTable, KeepsAFileThatIsReadEvenWithForce) {
  const LabWorkspace files;
  files.Write("s.toml", "[[part]]\nname = \"a\"\nbox = [1, 1]\n");
  const std::string before = files.Read("s.toml");
  LoadScene(files / "s.toml");
  std::filesystem::create_hard_link(files / "s.toml", files / "link");
  for (const char* name : {"s.toml", "link"}) {
    EXPECT_THROW(ResultTable(files / name, "name,size", "value", kKeys, true), OperatorError);
    EXPECT_EQ(files.Read("s.toml"), before) << name;
  }
}

TEST(ResultTable, RefusesTwoRowsOfOneKey) {
  const LabWorkspace files;
  EXPECT_THROW(ResultTable(files / "t.csv", "name", "value", {"a", "b", "a"}, true), OperatorError);
  EXPECT_TRUE(files.Names().empty());
}

TEST(Jobs, ResultsComeAsJobsEnd) {
  for (const int jobs : {1, 2, 5}) {
    std::vector<std::string> results(9);
    std::vector<std::size_t> order;
    RunJobs(
        9, jobs,
        [](std::size_t i) {
          usleep(i % 3 == 0 ? 200000 : 1000);
          return std::string(i == 4 ? 200000 : 1, static_cast<char>('a' + i));  // beyond a pipe
        },
        [&](std::size_t i, const JobResult& result) {
          EXPECT_TRUE(result.good);
          results[i] = result.text;
          order.push_back(i);
        },
        [] { return false; });
    ASSERT_EQ(order.size(), 9u);
    EXPECT_EQ(std::is_sorted(order.begin(), order.end()), jobs == 1) << "slow ones hold up nobody";
    EXPECT_EQ(results[4], std::string(200000, 'e'));
    EXPECT_EQ(results[8], "i");
  }
}

TEST(Jobs, AnErrorOrACrashOfOneHarmsNoOther) {
  std::vector<std::string> results(4);
  RunJobs(
      4, 2,
      [](std::size_t i) -> std::string {
        if (i == 1) throw OperatorError("no such thing");
        if (i == 2) raise(SIGKILL);
        return "fine";
      },
      [&](std::size_t i, const JobResult& result) {
        results[i] = (result.good ? "+" : "-") + result.text;
      },
      [] { return false; });
  EXPECT_EQ(results,
            (std::vector<std::string>{"+fine", "-no such thing", "-crashed: Killed", "+fine"}));
}

TEST(Jobs, StoppingEndsThemAndKeepsFinishedResults) {
  std::vector<std::size_t> done;
  bool stop = false;
  RunJobs(
      3, 2,
      [](std::size_t i) -> std::string {
        if (i == 1) sleep(1000);
        return "fine";
      },
      [&](std::size_t i, const JobResult& result) {
        EXPECT_TRUE(result.good);
        done.push_back(i);
      },
      [&] {
        const bool now = stop;
        stop = !done.empty();
        return now;
      });
  ASSERT_FALSE(done.empty());
  EXPECT_EQ(done[0], 0u);
  EXPECT_EQ(std::count(done.begin(), done.end(), 1u), 0);
}

TEST(Values, GiveTheHeaderAndTheTextsOfARow) {
  const Values values = {Count("runs", 3),
                         Decimals("mean", 0.25, 1),
                         Significant("error", 1e-7),
                         Significant("none", std::nullopt),
                         {"words", "a, \"b\""}};
  EXPECT_EQ(CsvColumns(values), "runs,mean,error,none,words");
  EXPECT_EQ(CsvRow(values), "3,0.2,1e-07,,\"a, \"\"b\"\"\"");
  EXPECT_EQ(CsvRow(Emptied(values)), ",,,,");
  EXPECT_EQ(CsvColumns(Judged("", values)), "valid," + CsvColumns(values));
  EXPECT_EQ(CsvRow(Judged("no contact", values)), "no contact,,,,,");
}

Experiment Squares() {
  Experiment experiment;
  experiment.key_columns = "number";
  experiment.value_columns = "square";
  experiment.keys = {"1", "2", "3"};
  experiment.measure = [](std::size_t row) -> std::string {
    if (row == 1) throw OperatorError("two is odd today");
    return std::to_string((row + 1) * (row + 1));
  };
  return experiment;
}

TEST(LabExperiment, ARunThatFailsLeavesNoRowUnlessItIsRescued) {
  const LabWorkspace files;
  TableFlags flags;
  flags.table = files / "t.csv";
  flags.quiet = true;
  flags.jobs = 1;
  Experiment experiment = Squares();
  EXPECT_EQ(CompleteTable(experiment, flags), 1);
  EXPECT_EQ(files.Read("t.csv"), "number,square\n1,1\n3,9\n");
  experiment.rescue = [](std::size_t, const std::string& why) { return why; };
  EXPECT_EQ(CompleteTable(experiment, flags), 0);
  EXPECT_EQ(files.Read("t.csv"), "number,square\n1,1\n2,two is odd today\n3,9\n");
}

/// A probe that runs nothing: its value tells the session that it was to run.
Probe Teller() {
  Probe probe;
  probe.command = "tell";
  probe.key = {"scene", "method", "network", "seed", "players"};
  probe.axes = {PlayersAxis(), SeedAxis(), NetworkAxis(), MethodAxis()};
  probe.columns = {{"told", ""}};
  probe.measure = [](const ProbeRun& run) {
    const SessionSettings& s = run.settings;
    return Values{{"told", s.mode + "/" + s.reconcile + s.predict + " " + s.impair + " " +
                               std::to_string(s.seed) + " of " + s.scene}};
  };
  return probe;
}

ProbeOptions TellerOptions(const LabWorkspace& files) {
  ProbeOptions options;
  options.scenes = {"crossing", "wall"};
  options.methods = {"strict", "central/own", "buffer/fade"};
  options.networks = {"demo", "loss=1%,jitter=10ms"};
  options.seeds = 2;
  options.output.table = files / "t.csv";
  options.output.quiet = true;
  return options;
}

TEST(LabProbe, RunsEveryCombinationScenesSlowest) {
  const LabWorkspace files;
  const ProbeOptions options = TellerOptions(files);
  ASSERT_EQ(RunProbe(Teller(), options), 0);
  const CsvTable csv = CsvTable::Load(options.output.table);
  EXPECT_EQ(csv.header(),
            (std::vector<std::string>{"scene", "method", "network", "seed", "players", "told"}));
  ASSERT_EQ(csv.rows(), 24u);
  EXPECT_EQ(csv.Text(0, "told"), "strict/ demo 1 of scenes/crossing.toml");
  EXPECT_EQ(csv.Text(1, "told"), "central/own demo 1 of scenes/crossing.toml");
  EXPECT_EQ(csv.Text(5, "told"), "buffer/fade loss=1%,jitter=10ms 1 of scenes/crossing.toml");
  EXPECT_EQ(csv.Text(6, "seed"), "2");
  EXPECT_EQ(csv.Text(23, "scene"), "wall");
  EXPECT_EQ(csv.Text(23, "network"), "loss=1%,jitter=10ms");
}

TEST(LabProbe, ChecksAllRunsBeforeItWrites) {
  const LabWorkspace files;
  for (const char* method : {"buffer/none-such", "strict/fade"}) {
    ProbeOptions options = TellerOptions(files);
    options.methods.push_back(method);
    EXPECT_THROW(RunProbe(Teller(), options), OperatorError) << method;
  }
  ProbeOptions options = TellerOptions(files);
  options.players = 3;
  EXPECT_THROW(RunProbe(Teller(), options), OperatorError) << "crossing has two";
  EXPECT_TRUE(files.Names().empty());
}

TEST(LabProbe, EachOfTheRegisterHasItsKeyAndItsColumns) {
  EXPECT_GE(Probes().size(), 4u);
  for (const Probe& probe : Probes()) {
    const auto has = [&](const std::string& column) {
      return std::count(probe.key.begin(), probe.key.end(), column) == 1;
    };
    for (const char* column : {"version", "scene", "scene_hash"}) {
      EXPECT_TRUE(has(column)) << probe.command << ": " << column;
    }
    for (const ProbeAxis& axis : probe.axes) {
      EXPECT_TRUE(has(axis.column)) << probe.command << ": " << axis.column;
    }
    EXPECT_EQ(probe.key.size(), 3 + probe.axes.size()) << probe.command;
    EXPECT_EQ(probe.columns.at(0).column, "valid") << probe.command;
  }
}

}  // namespace lab_experiment_test
}  // namespace seam
