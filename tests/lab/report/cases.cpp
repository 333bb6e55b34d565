#include "tests/lab/report/cases.h"

#include <algorithm>
#include <filesystem>

#include "tests/lab/report/method_look.h"
#include "tests/lab/report/text_table.h"
#include "tests/lab/report/validity.h"

namespace seam {
namespace {

ReportCase* CaseOf(const CaseTable& table, std::size_t row, std::vector<ReportCase>* cases) {
  ReportCase key;
  key.scene = std::filesystem::path(table.table.Text(row, "scene")).stem().string();
  key.drive = table.table.Text(row, "drive");
  key.impair = table.table.Text(row, "impair");
  key.smooth = table.table.Text(row, "smooth") != "off";
  key.set = table.table.Text(row, "set");
  key.sweep = table.name;
  key.command = table.command;
  for (ReportCase& known : *cases) {
    if (known.sweep == key.sweep && known.scene == key.scene && known.drive == key.drive &&
        known.impair == key.impair && known.smooth == key.smooth && known.set == key.set) {
      return &known;
    }
  }
  cases->push_back(std::move(key));
  return &cases->back();
}

std::vector<CaseRun>* RunsOf(const std::string& method, ReportCase* at) {
  for (CaseMethod& known : at->methods) {
    if (known.name == method) return &known.runs;
  }
  at->methods.push_back({method, {}});
  return &at->methods.back().runs;
}

}  // namespace

std::string CaseName(const std::string& scene, const std::string& drive,
                     const std::string& impair) {
  return scene + (drive == "bot" ? ", bots" : "") + (impair == "demo" ? "" : ", " + impair);
}

std::string ReportCase::Name() const { return CaseName(scene, drive, impair); }

const CaseMethod* ReportCase::Find(const std::string& method) const {
  for (const CaseMethod& known : methods) {
    if (known.name == method) return &known;
  }
  return nullptr;
}

std::vector<ReportCase> FindCases(const std::vector<CaseTable>& tables) {
  std::vector<ReportCase> cases;
  for (const CaseTable& table : tables) {
    table.table.Require({"scene", "mode", "reconcile", "impair", "drive", "seed", "error_rms_m"});
    for (std::size_t row = 0; row < table.table.rows(); ++row) {
      ReportCase* found = CaseOf(table, row, &cases);
      const std::string name = MethodName(table.table, row);
      RunsOf(name, found)->push_back({&table.table, row});
    }
  }
  for (ReportCase& found : cases) {
    std::stable_sort(found.methods.begin(), found.methods.end(),
                     [](const CaseMethod& a, const CaseMethod& b) {
                       return MethodOrder(a.name) < MethodOrder(b.name);
                     });
  }
  return cases;
}

std::optional<double> MedianOf(const CaseMethod* method, const SweepMeasure& measure) {
  if (method == nullptr) return std::nullopt;
  std::vector<double> values;
  for (const CaseRun& run : method->runs) {
    if (const auto value = measure.value(*run.table, run.row)) values.push_back(*value);
  }
  const std::optional<Quartiles> quartiles = FindQuartiles(std::move(values));
  if (!quartiles) return std::nullopt;
  return quartiles->median;
}

std::optional<double> MedianOf(const CaseMethod* method, const std::string& column) {
  SweepMeasure measure;
  measure.value = [&column](const CsvTable& table, std::size_t row) {
    return table.Number(row, column);
  };
  return MedianOf(method, measure);
}

std::string CellOf(const CaseMethod* method, const std::optional<double>& value) {
  if (method == nullptr) return "–";
  Validity validity;
  for (const CaseRun& run : method->runs) {
    const Validity one = FindValidity(*run.table, {run.row});
    validity.rows += one.rows;
    if (one.invalid > 0 && validity.invalid++ == 0) validity.reason = one.reason;
  }
  return WithValidity(value ? Digits(*value) : "–", validity);
}

}  // namespace seam
