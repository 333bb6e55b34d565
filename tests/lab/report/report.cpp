#include "tests/lab/report/report.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "common/base/check.h"
#include "tests/lab/report/files.h"
#include "tests/lab/report/html/answers.h"
#include "tests/lab/report/hurry_section.h"
#include "tests/lab/report/joints/exact_joints.h"
#include "tests/lab/report/physics_section.h"
#include "tests/lab/report/sessions/around_section.h"
#include "tests/lab/report/sessions/fairness_section.h"
#include "tests/lab/report/sessions/titles_section.h"
#include "tests/lab/report/sweep_section.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

/// Throws OperatorError for a folder that cannot be read.
std::vector<fs::path> FilesOf(const fs::path& folder, const std::string& extension) {
  std::error_code error;
  std::vector<fs::path> files = FilesIn(folder, extension, &error);
  if (error) throw OperatorError(folder.string() + ": " + error.message());
  return files;
}

TextTable OverheadTable(const CsvTable& csv, const std::string& command) {
  csv.Require({"scene", "bodies", "raw_us_per_step", "core_us_per_step", "ratio"});
  TextTable table;
  table.name = "overhead";
  table.title = "A step of the core beside raw Box2D with the same bodies";
  table.header = {"scene", "bodies", "raw Box2D (µs a step)", "core (µs a step)", "ratio"};
  std::vector<double> ratios;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const auto digits = [&](const char* column) {
      const auto value = csv.Number(row, column);
      return value ? Digits(*value) : std::string("–");
    };
    if (const auto ratio = csv.Number(row, "ratio")) ratios.push_back(*ratio);
    table.rows.push_back({fs::path(csv.Text(row, "scene")).stem().string(), csv.Text(row, "bodies"),
                          digits("raw_us_per_step"), digits("core_us_per_step"), digits("ratio")});
  }
  table.note = "Median (quartiles) of the ratios: " + Digits(FindQuartiles(ratios)) + ".";
  table.command = command;
  table.open = true;
  return table;
}

/// What the report itself took, step by step.
TextTable TimesTable(const CsvTable& csv) {
  csv.Require({"step", "seconds"});
  TextTable table;
  table.name = "times";
  table.title = "What this report took";
  table.header = {"step", "seconds"};
  double sum = 0;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    sum += csv.Number(row, "seconds").value_or(0);
    table.rows.push_back({csv.Text(row, "step"), csv.Text(row, "seconds")});
  }
  table.note = fmt::format("{:.0f} minutes in all, on the machine of the run.", sum / 60);
  table.command = "make report FORCE=1";
  table.open = true;
  return table;
}

Section CostSection(const std::vector<Sweep>& sweeps, const fs::path& data) {
  Section section;
  section.id = "cost";
  section.title = "What the runtime costs";
  if (fs::exists(data / "times.csv")) {
    section.items.emplace_back(TimesTable(CsvTable::Load((data / "times.csv").string())));
  }
  const fs::path overhead = data / "overhead.csv";
  if (fs::exists(overhead)) {
    section.items.emplace_back(OverheadTable(CsvTable::Load(overhead.string()),
                                             "seam-lab overhead -o " + overhead.string()));
  }
  if (!sweeps.empty()) {
    TextTable speed = SpeedTable(sweeps);
    speed.open = true;
    section.items.emplace_back(std::move(speed));
  }
  return section;
}

/// Of the hard cases' table, with the overhead's where it is there.
Section JointsSection(const fs::path& data, const std::string& folder) {
  const fs::path physics = data / "physics.csv", overhead = data / "overhead.csv";
  std::optional<CsvTable> beside;
  if (fs::exists(overhead)) beside = CsvTable::Load(overhead.string());
  return ExactJointsSection(
      CsvTable::Load(physics.string()), beside ? &*beside : nullptr,
      fmt::format("seam-lab physics -o {} && seam-lab report {}", physics.string(), folder));
}

void AddSweeps(const std::vector<Sweep>& sweeps, std::vector<Section>* sections) {
  if (sweeps.empty()) return;
  Section network;
  network.id = "network";
  network.title = "Over a network: each method against what the network does";
  network.intro =
      "Real server and clients over a simulated network. A point is the median over seeds, its bar "
      "the quartiles (nearest rank). Scripted drives repeat; bots press throttle and brake at "
      "random, seeded, which the other side cannot know. The floor is the oracle against itself "
      "with one body moved by a micrometre.";
  TextTable fronts = FrontTable(sweeps);
  fronts.open = true;
  if (!fronts.rows.empty()) network.items.emplace_back(std::move(fronts));
  sections->push_back(std::move(network));
  for (const Sweep& sweep : sweeps) sections->push_back(SweepSection(sweep));
}

}  // namespace

std::vector<Section> BuildReport(const ReportInput& input) {
  std::vector<Sweep> sweeps;
  std::vector<CaseTable> case_tables;
  const fs::path data = input.data;
  for (const fs::path& path : FilesOf(data, ".csv")) {
    const std::string name = path.stem().string();
    if (name == "physics" || name == "overhead") continue;
    if (name == "fairness" || name == "titles" || name == "before" || name == "times") continue;
    const std::string command = fmt::format("seam-lab sweep {} -o {} && seam-lab report {}",
                                            (fs::path(input.sweeps) / (name + ".toml")).string(),
                                            path.string(), input.data);
    CsvTable table = CsvTable::Load(path.string());
    const bool bars = name.rfind("must-", 0) == 0 || name == "changes";
    if (bars || name.rfind("floors", 0) == 0) case_tables.push_back({name, command, table});
    if (bars) continue;
    SweepView view = ViewSweep(table);
    if (!view.groups.empty()) {
      sweeps.push_back({name, command, std::move(table), std::move(view)});
    }
  }
  std::optional<Before> before;
  if (fs::exists(data / "before.csv")) before = {CsvTable::Load((data / "before.csv").string())};
  const std::vector<ReportCase> cases = FindCases(case_tables);
  std::vector<Section> sections;
  Section answers = AnswersSection(sweeps);
  if (!answers.items.empty()) sections.push_back(std::move(answers));
  Section hurry = HurrySection(sweeps, cases, before ? &*before : nullptr);
  if (!hurry.items.empty()) sections.push_back(std::move(hurry));
  Section every = CasesSection(cases);
  if (!every.items.empty()) sections.push_back(std::move(every));
  Section cost = CostSection(sweeps, data);
  if (!cost.items.empty()) sections.push_back(std::move(cost));
  Section world = WorldSection((data / "world").string());
  if (!world.items.empty()) sections.push_back(std::move(world));
  Section relief = ReliefSection((data / "relief").string());
  if (!relief.items.empty()) sections.push_back(std::move(relief));
  const fs::path titles = data / "titles.csv";
  if (fs::exists(titles)) {
    sections.push_back(
        TitlesSection(CsvTable::Load(titles.string()), "seam-lab titles -o " + titles.string()));
  }
  Section around = AroundSection((data / "around").string());
  if (!around.items.empty()) sections.push_back(std::move(around));
  Section renders = RendersSection(input.out);
  if (!renders.items.empty()) sections.push_back(std::move(renders));
  const fs::path physics = data / "physics.csv";
  if (fs::exists(physics)) {
    sections.push_back(PhysicsSection(
        CsvTable::Load(physics.string()),
        fmt::format("seam-lab physics -o {} && seam-lab report {}", physics.string(), input.data)));
    sections.push_back(JointsSection(data, input.data));
    if (sections.back().items.empty()) sections.pop_back();
  }
  const fs::path fairness = data / "fairness.csv";
  if (fs::exists(fairness)) {
    sections.push_back(FairnessSection(CsvTable::Load(fairness.string()),
                                       "seam-lab fairness -o " + fairness.string()));
  }
  AddSweeps(sweeps, &sections);
  if (sections.empty()) throw OperatorError(input.data + ": has no tables (*.csv) to report");
  return sections;
}

std::vector<const TextTable*> Tables(const std::vector<Section>& sections) {
  std::vector<const TextTable*> tables;
  for (const Section& section : sections) {
    for (const PageItem& item : section.items) {
      if (const auto* table = std::get_if<TextTable>(&item)) tables.push_back(table);
    }
  }
  return tables;
}

std::vector<const Figure*> Figures(const std::vector<Section>& sections) {
  std::vector<const Figure*> figures;
  for (const Section& section : sections) {
    for (const PageItem& item : section.items) {
      if (const auto* figure = std::get_if<Figure>(&item)) figures.push_back(figure);
    }
  }
  return figures;
}

}  // namespace seam
