/// seam-lab report: its pages from tables with known answers, and from damaged tables.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "common/base/check.h"
#include "tests/lab/commands.h"
#include "tests/lab/report/physics_section.h"
#include "tests/lab/report/report.h"
#include "tests/lab/report/sweep_section.h"
#include "tests/support/child_process.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_report_test {

/// Two methods at two latencies, three seeds each: fade errs 1, 2, 3 and 4, 5, 6 mm, strict ten
/// times that.
std::string LatencyCsv() {
  std::string text =
      "version,scene,mode,reconcile,impair,send_hz,drive,smooth,duration_s,seed,"
      "error_rms_m,stutter_mps2,rebound,handover_jump_m,floor_m,bytes_per_s,cpu_s\n";
  for (const int ms : {50, 100}) {
    for (const int seed : {1, 2, 3}) {
      const int mm = seed + (ms == 100 ? 3 : 0);
      const std::string end = ",0.00" + std::to_string(mm);
      const std::string network = "\"delay=" + std::to_string(ms) + "ms,loss=2%\",30,script,on,10,";
      text += "v,scenes/wall.toml,buffer,fade," + network + std::to_string(seed) + end +
              ",8,1,0,1e-06,2000,0.05\n";
      text += "v,scenes/wall.toml,strict,," + network + std::to_string(seed) + ",0.0" +
              std::to_string(mm) + ",80,0,0,1e-06,1000,0.02\n";
    }
  }
  return text;
}

Sweep SweepOf(const std::string& csv, const std::string& name = "latency") {
  CsvTable table = CsvTable::Parse(csv, name + ".csv");
  SweepView view = ViewSweep(table);
  return {name, "seam-lab sweep x", std::move(table), std::move(view)};
}

const TextTable& TableOf(const Section& section, const std::string& name) {
  for (const PageItem& item : section.items) {
    const auto* table = std::get_if<TextTable>(&item);
    if (table != nullptr && table->name == name) return *table;
  }
  throw OperatorError("no table " + name);
}

TEST(SweepView, FindsTheVariedValueInTheNetworksText) {
  const Sweep sweep = SweepOf(LatencyCsv());
  EXPECT_EQ(sweep.view.axis.key, "one_way_ms");
  EXPECT_FALSE(sweep.view.axis.ours);
  ASSERT_EQ(sweep.view.groups.size(), 1u);
  const SweepGroup& group = sweep.view.groups[0];
  EXPECT_EQ(group.scene, "wall");
  EXPECT_EQ(group.methods, (std::vector<std::string>{"strict", "fade"}));
  EXPECT_EQ(group.xs, (std::vector<double>{50, 100}));
  EXPECT_EQ(group.runs.at("fade").at(100).size(), 3u);
  EXPECT_NE(sweep.view.fixed.find("loss 2 %"), std::string::npos) << sweep.view.fixed;
}

TEST(SweepView, NamesASecondVariedSettingWithTheMethod) {
  std::string csv = LatencyCsv();
  const std::size_t at = csv.rfind("script,on");  // of strict, 100 ms, seed 3
  csv.replace(at, 9, "script,off");
  const SweepView view = SweepOf(csv).view;
  EXPECT_EQ(view.axis.key, "one_way_ms");
  EXPECT_EQ(view.groups[0].runs.count("strict, smooth off"), 1u);
  EXPECT_EQ(view.groups[0].runs.count("strict, smooth on"), 1u);
}

TEST(SweepView, IgnoresDifferencesBetweenTheScenesThemselves) {
  // Buffers of 1 and 5 m were tried in one scene, 5 m is set in both; substeps are the scenes' own.
  std::string csv = "scene,set,mode,reconcile,impair,drive,seed,substeps,buffer_m,error_rms_m\n";
  csv += "wall,buffer=1,buffer,fade,perfect,script,1,1,1,0.5\n";
  csv += "wall,buffer=5;gravity=2,buffer,fade,perfect,script,1,1,5,0.4\n";
  csv += "stack,buffer=5,buffer,fade,perfect,script,1,2,5,0.4\n";
  const SweepView view = SweepOf(csv).view;
  EXPECT_EQ(view.axis.key, "buffer_m");
  EXPECT_TRUE(view.axis.ours);
  ASSERT_EQ(view.groups.size(), 2u);
  EXPECT_EQ(view.groups[0].methods,
            (std::vector<std::string>{"fade, set gravity=2", "fade, set –"}));
  EXPECT_EQ(view.groups[1].xs, (std::vector<double>{5}));
}

TEST(SweepSection, TabulatesMediansAndQuartiles) {
  const TextTable table = TableOf(SweepSection(SweepOf(LatencyCsv())), "latency-wall-error");
  EXPECT_EQ(table.header, (std::vector<std::string>{"method", "50 ms", "100 ms"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[1],
            (std::vector<std::string>{"fade", "0.002 (0.001–0.003)", "0.005 (0.004–0.006)"}));
  EXPECT_NE(table.note.find("of 3 seeds"), std::string::npos);
  EXPECT_NE(table.note.find("floor: 1.0e-06 m"), std::string::npos);
}

TEST(SweepSection, DrawsEveryPresentMeasureAndListsTheZeroOnes) {
  const Section section = SweepSection(SweepOf(LatencyCsv()));
  const auto* figure = std::get_if<Figure>(&section.items[0]);
  ASSERT_NE(figure, nullptr);
  ASSERT_EQ(figure->panels.size(), 4u) << "error, stutter, rebound and traffic";
  EXPECT_NE(figure->caption.find("Zero in all runs: jump at hand-over"), std::string::npos);
  ASSERT_EQ(figure->panels[0].levels.size(), 1u);
  EXPECT_EQ(figure->panels[0].levels[0].y, 1e-6);
  const PlotCurve& fade = figure->panels[0].curves[1];
  EXPECT_EQ(fade.name, "fade");
  EXPECT_EQ(fade.points[1].x, 100);
  EXPECT_EQ(fade.points[1].y, 0.005);
  EXPECT_EQ(fade.points[1].low, 0.004);
  EXPECT_EQ(fade.points[1].high, 0.006);
}

TEST(FrontTable, NamesTheFrontAndTheDistanceOfTheOthers) {
  // At 10 and 20 Hz: a costs 100 and 200, errs 4 and 2; b costs 150 and 300, errs 6 and 3.
  std::string csv =
      "scene,mode,reconcile,impair,send_hz,drive,duration_s,seed,"
      "error_rms_m,bytes_per_s,cpu_s\n";
  for (const char* row :
       {"fade,perfect,10,script,10,1,4,100,", "fade,perfect,20,script,10,1,2,200,",
        "snap,perfect,10,script,10,1,6,150,", "snap,perfect,20,script,10,1,3,300,"}) {
    csv += std::string("cradle,buffer,") + row + "\n";
  }
  const std::vector<Sweep> sweeps = {SweepOf(csv, "rate")};
  EXPECT_TRUE(sweeps[0].view.axis.ours);
  const TextTable table = FrontTable(sweeps);
  EXPECT_EQ(table.header, (std::vector<std::string>{"front", "snap", "fade"}));
  ASSERT_EQ(table.rows.size(), 1u) << "no CPU time was measured";
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"cradle by updates: bytes/s against error",
                                                     "1.5 ×", "✓ 10, 20"}));
}

/// stock, the scene's own, and others of one case: error, failure, cost ratio.
std::string PhysicsCsv(const std::vector<std::string>& rows) {
  std::string text =
      "version,case,truth,unit,role,tick_hz,substeps,velocity_iterations,position_iterations,"
      "warm_starting,skin,continuous,welds,seconds,error,failure,penetration_m,joint_drift_m,"
      "energy_gain,jitter_mps,asleep_s,cpu_us_per_s,stock_cpu_us_per_s,cost_ratio,"
      "reference_change\n";
  for (const std::string& row : rows) text += row + '\n';
  return text;
}
std::string PhysicsRow(const std::string& name, const std::string& role, const std::string& error,
                       const std::string& failure, const std::string& ratio) {
  return "v," + name + ",formula,m," + role + ",60,1,8,3,on,,on,joint,20," + error + ",\"" +
         failure + "\",0.01,,0,0.1,,900,1000," + ratio + ",";
}

PhysicsCase CaseOf(const std::string& stock_error, const std::string& stock_failure,
                   const std::string& error, const std::string& failure, const std::string& ratio) {
  return ViewPhysics(
      CsvTable::Parse(PhysicsCsv({PhysicsRow("arch", "stock", stock_error, stock_failure, "1"),
                                  PhysicsRow("arch", "scene", error, failure, ratio),
                                  PhysicsRow("arch", "grid", "0.02", "", "0.5"),
                                  PhysicsRow("arch", "grid", "0.001", "fell, at 3 s", "0.2"),
                                  PhysicsRow("arch", "grid", "inf", "", "0.1"),
                                  PhysicsRow("arch", "grid", "0.0005", "", "4")}),
                      "p.csv"))[0];
}

TEST(Physics, ASettingThatFailedIsOnNoFrontAndIsNotTheCheapest) {
  const PhysicsCase c = CaseOf("0.03", "", "0.01", "", "0.9");
  ASSERT_EQ(c.all.size(), 6u);
  EXPECT_EQ(c.all[4].failure, "diverged");
  EXPECT_EQ(ParetoFront(PhysicsTrials(c.all)), (std::vector<std::size_t>{2, 1, 5}));
  EXPECT_EQ(CheapestNoWorse(c)->cost_ratio, 0.5);
  EXPECT_EQ(BestAtStocksCost(c)->error, 0.01);
  EXPECT_NEAR(ErrorRatio(*c.scene, *c.stock), 1.0 / 3, 1e-12);
}

TEST(Physics, TheVerdictComparesErrorAndCost) {
  EXPECT_EQ(Verdict(CaseOf("0.03", "", "0.01", "", "0.9")), "much better, cheaper");
  EXPECT_EQ(Verdict(CaseOf("0.03", "", "0.03", "", "0.9")), "no worse, cheaper");
  EXPECT_EQ(Verdict(CaseOf("0.03", "", "0.01", "", "1.05")), "much better, same cost");
  EXPECT_EQ(Verdict(CaseOf("0.03", "", "0.01", "", "2")), "much better, dearer");
  EXPECT_EQ(Verdict(CaseOf("0.03", "", "0.02", "", "2")), "neither");
  EXPECT_EQ(Verdict(CaseOf("0.03", "", "0.04", "", "0.5")), "worse");
  EXPECT_EQ(Verdict(CaseOf("inf", "fell", "0.04", "", "1")), "holds, stock fails");
  EXPECT_EQ(Verdict(CaseOf("0.1", "", "9", "fell", "1")), "worse: it fails");
  EXPECT_EQ(Verdict(CaseOf("0.1", "fell", "9", "fell", "1")), "both fail");
  EXPECT_EQ(Verdict(CaseOf("0", "", "0", "", "1")), "no worse, cheaper");
}

TEST(Physics, EveryCaseIsInTheTableWithItsFailure) {
  const CsvTable csv =
      CsvTable::Parse(PhysicsCsv({PhysicsRow("arch", "stock", "inf", "fell, at 2 s", "1"),
                                  PhysicsRow("arch", "scene", "0", "", "1.5"),
                                  PhysicsRow("cradle", "stock", "0.5", "", "1"),
                                  PhysicsRow("cradle", "scene", "0.5", "", "1")}),
                      "p.csv");
  const TextTable table = PhysicsTable(ViewPhysics(csv), "x");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0][3], "fell, at 2 s");
  EXPECT_EQ(table.rows[0][4], "0");
  EXPECT_EQ(table.rows[0][7], "holds, stock fails; dearer");
  EXPECT_EQ(table.rows[1][5], "1");
  const std::string script =
      GnuplotScript(WorkPrecision(ViewPhysics(csv)[0], "x"), PictureFormat::kSvg);
  EXPECT_NE(script.find("add ('0' "), std::string::npos) << "no error at all is drawn as 0";
  EXPECT_NE(script.find("add ('diverged' "), std::string::npos);
}

TEST(ReportPage, TextOfADataFileIsEscapedForHtml) {
  EXPECT_EQ(EscapeHtml("<b a=\"1\">&'"), "&lt;b a=&quot;1&quot;&gt;&amp;&#39;");
  TextTable table;
  table.header = {"case", "what|ever"};
  table.rows = {{"<script>", "a|b"}};
  EXPECT_EQ(Html(table).find("<script>"), std::string::npos);
  EXPECT_NE(Markdown(table).find("| \\<script> | a\\|b |"), std::string::npos) << Markdown(table);
}

TEST(FillIn, ReplacesOnlyItsMarkedPlaces) {
  TextTable table;
  table.name = "speed";
  table.header = {"scene", "×"};
  table.rows = {{"wall", "61"}};
  table.command = "make report";
  const std::string page =
      "# R\n<!-- report:speed -->\nold\n<!-- /report:speed -->\nmine\n"
      "<!-- report:none -->\nkept\n<!-- /report:none -->\n";
  std::vector<std::string> missing;
  const std::string filled = FillIn(page, "r.md", {&table}, &missing);
  EXPECT_EQ(filled,
            "# R\n<!-- report:speed -->\n| scene | × |\n|---|---:|\n| wall | 61 |\n\n"
            "    make report\n<!-- /report:speed -->\nmine\n"
            "<!-- report:none -->\nkept\n<!-- /report:none -->\n");
  EXPECT_EQ(missing, (std::vector<std::string>{"none"}));
  EXPECT_EQ(FillIn(filled, "r.md", {&table}, &missing), filled) << "again: the same";
  EXPECT_THROW(FillIn("<!-- report:speed -->\nold\n", "r.md", {&table}, &missing), OperatorError);
}

TEST(Report, WritesAPageWithoutDeadLinks) {
  const LabWorkspace files;
  std::filesystem::create_directories(files / "data");
  files.Write("data/latency.csv", LatencyCsv());
  files.Write("data/physics.csv", PhysicsCsv({PhysicsRow("arch", "stock", "0.2", "", "1"),
                                              PhysicsRow("arch", "scene", "0", "", "1.5")}));
  files.Write("data/overhead.csv",
              "scene,bodies,raw_us_per_step,core_us_per_step,ratio\n"
              "scenes/wall.toml,33,10,10.4,1.04\n");
  files.Write("results.md", "<!-- report:overhead --><!-- /report:overhead -->\n");
  ChildProcess run({LabProgram(), "report", files / "data", "-o", files / ".", "--markdown",
                    files / "results.md"});
  ASSERT_TRUE(run.Wait(60));
  ASSERT_EQ(run.exit_status(), 0) << run.output();
  EXPECT_NE(files.Read("results.md").find("| wall | 33 | 10 | 10.4 | 1.04 |"), std::string::npos);
  const std::string page = files.Read("index.html");
  std::size_t links = 0;
  for (const std::string& mark : {std::string("href=\""), std::string("src=\"")}) {
    for (std::size_t at = page.find(mark); at != std::string::npos; at = page.find(mark, at + 1)) {
      const std::size_t begin = at + mark.size();
      const std::string link = page.substr(begin, page.find('"', begin) - begin);
      if (link[0] == '#') continue;
      ++links;
      EXPECT_TRUE(std::filesystem::exists(files / link)) << link;
    }
  }
  EXPECT_GT(links, 10u);
  const std::size_t svg = page.find("http://www.w3.org/2000/svg");  // a name, not an address
  EXPECT_EQ(page.find("http"), svg) << "it needs no network";
  EXPECT_EQ(page.find("http", svg + 1), std::string::npos);
  EXPECT_EQ(page.find("<script src"), std::string::npos);
  EXPECT_NE(files.Read("tables/answers.md").find("| 50 ms, 2 % loss | fade | 0.002 |"),
            std::string::npos)
      << files.Read("tables/answers.md");
  const std::string plot = files.Read("plots/latency-wall-curves.svg");
  EXPECT_NE(plot.find("one-way latency (ms)"), std::string::npos) << "gnuplot drew it";
  EXPECT_NE(plot.find("</svg>"), std::string::npos);
}

TEST(Report, ADamagedTableIsOneLineAndNothingIsWritten) {
  const LabWorkspace files;
  std::filesystem::create_directories(files / "data");
  files.Write("data/latency.csv", LatencyCsv() + "v,scenes/wall.toml,buf");
  ChildProcess run({LabProgram(), "report", files / "data", "-o", files / "out"});
  ASSERT_TRUE(run.Wait(20));
  EXPECT_EQ(run.exit_status(), 2);
  EXPECT_EQ(run.output(), "seam-lab: " + (files / "data/latency.csv") +
                              ":14: the line has no end: its writer was interrupted, or still "
                              "writes\n");
  EXPECT_FALSE(std::filesystem::exists(files / "out"));
  ChildProcess nothing({LabProgram(), "report", files / "nowhere", "-o", files / "out"});
  ASSERT_TRUE(nothing.Wait(20));
  EXPECT_EQ(nothing.exit_status(), 2);
}

TEST(Report, TablesOfWorldCostsAreCopiedUnchanged) {
  const LabWorkspace files;
  std::filesystem::create_directory(files / "world");
  files.Write("world/water.csv", "method,error (m)\nexact,0.01\n\"voxel, 4\",0.5\n");
  files.Write("world/water.txt", "Draught of boats\nOne run.\n");
  files.Write("world/bare.csv", "a\n1\n");
  const Section section = WorldSection(files / "world");
  ASSERT_EQ(section.items.size(), 2u);
  EXPECT_EQ(std::get<TextTable>(section.items[0]).title, "bare");
  const TextTable& water = std::get<TextTable>(section.items[1]);
  EXPECT_EQ(water.name, "world-water");
  EXPECT_EQ(water.title, "Draught of boats");
  EXPECT_EQ(water.note, "One run.");
  EXPECT_EQ(water.rows,
            (std::vector<std::vector<std::string>>{{"exact", "0.01"}, {"voxel, 4", "0.5"}}));
  EXPECT_TRUE(WorldSection(files / "nowhere").items.empty());
}

TEST(Report, AnInputDelayIsPaidForWithTheOwnResponse) {
  std::string csv =
      "scene,set,mode,reconcile,impair,drive,seed,input_delay_ticks,error_rms_m,error_others_m,"
      "response_own_ms,cpu_s,duration_s\n";
  for (const char* predict : {"own", "all"}) {
    for (const int delay : {0, 4}) {
      csv += "s.toml,input_delay=" + std::to_string(delay) + ",central," + predict +
             ",demo,bot,1," + std::to_string(delay) + ",0.1,0.2," +
             std::to_string(16 * (delay + 1)) + ",1,6\n";
    }
  }
  Sweep sweep{"input-delay", "make report", CsvTable::Parse(csv, "a.csv"), {}};
  sweep.view = ViewSweep(sweep.table);
  EXPECT_EQ(sweep.view.axis.key, "input_delay_ticks");
  ASSERT_EQ(sweep.view.groups.size(), 1u);
  EXPECT_EQ(sweep.view.groups[0].methods, (std::vector<std::string>{"central/own", "central/all"}));
  bool found = false;
  for (const auto& item : SweepSection(sweep).items) {
    const Figure* figure = std::get_if<Figure>(&item);
    if (figure == nullptr || figure->name.find("fronts") == std::string::npos) continue;
    found = true;
    ASSERT_EQ(figure->panels.size(), 2u);
    EXPECT_EQ(figure->panels[0].x.label, MeasureNamed("response-own").Label());
    EXPECT_EQ(figure->panels[0].y.label, MeasureNamed("others").Label());
  }
  EXPECT_TRUE(found);
  EXPECT_TRUE(FrontTable({sweep}).rows.empty()) << "it is no matter of CPU or bytes";
}

}  // namespace lab_report_test
}  // namespace seam
