/// Every case in full: all measures of all methods.

#include <fmt/format.h>

#include <algorithm>

#include "tests/lab/report/hurry_section.h"

namespace seam {
Section CasesSection(const std::vector<ReportCase>& all) {
  Section section;
  section.id = "cases";
  section.title = "Every method, scene by scene";
  std::vector<SweepMeasure> measures = FirstMeasures();
  for (const char* id : {"seam", "rebound", "penetration", "gap"}) {
    measures.push_back(MeasureNamed(id));
  }
  for (const ReportCase& at : all) {
    if (at.sweep.rfind("floors", 0) == 0 || at.sweep == "changes") continue;
    TextTable table;
    table.name =
        fmt::format("case-{}-{}-{}{}{}", at.scene, at.drive, at.impair,
                    at.smooth ? "" : "-smooth-off", at.sweep == "must-limit" ? "-limit" : "");
    std::replace(table.name.begin(), table.name.end(), '=', '-');
    table.title = at.Name() + (at.smooth ? "" : ", smoother off");
    table.header = {"method"};
    for (const SweepMeasure& measure : measures) table.header.push_back(measure.Label());
    const bool limit = at.sweep == "must-limit", energy = at.scene == "gas";
    if (limit) table.header.push_back(LimitMeasure().Label());
    for (const char* column : {"energy_ratio_min", "energy_ratio_max", "hottest_ratio"}) {
      if (energy) table.header.push_back(column);
    }
    for (const CaseMethod& method : at.methods) {
      std::vector<std::string> row = {method.name};
      for (const SweepMeasure& measure : measures) {
        const auto median = MedianOf(&method, measure);
        row.push_back(row.size() == 1 ? CellOf(&method, median) : DigitsOrDash(median));
      }
      if (limit) row.push_back(DigitsOrDash(MedianOf(&method, LimitMeasure())));
      for (const char* column : {"energy_ratio_min", "energy_ratio_max", "hottest_ratio"}) {
        if (energy) row.push_back(DigitsOrDash(MedianOf(&method, column)));
      }
      table.rows.push_back(std::move(row));
    }
    std::size_t seeds = 0;
    for (const CaseMethod& method : at.methods) seeds = std::max(seeds, method.runs.size());
    table.note = fmt::format("Medians of {} seeds. Network: {}.", seeds, at.impair);
    table.command = at.command;
    section.items.emplace_back(std::move(table));
  }
  return section;
}

}  // namespace seam
