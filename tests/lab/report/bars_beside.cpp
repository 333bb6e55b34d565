/// The default beside what was there before, and beside what it would be without one of its parts.

#include <fmt/format.h>

#include <algorithm>

#include "tests/lab/report/bars.h"

namespace seam {
namespace {

/// The least of three methods of before.
std::optional<double> LowestStutter(const ReportCase& at, const Before& before) {
  std::optional<double> lowest;
  for (const char* method : {"fade", "retrospect", "resimulate"}) {
    const auto value = before.Find(at, method, "stutter_mps2");
    if (value && (!lowest || *value < *lowest)) lowest = value;
  }
  return lowest;
}

/// Cases as they are run by default: with the smoother, nothing set, several methods.
bool IsPlain(const ReportCase& at) {
  return at.smooth && at.set.empty() && at.methods.size() > 1 && at.sweep != "must-limit";
}

std::string Ratio(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b && *b > 0 ? Digits(*a / *b) : "–";
}

/// The same case with something set in the scene.
const ReportCase* With(const ReportCase& at, const std::string& set,
                       const std::vector<ReportCase>& cases) {
  for (const ReportCase& found : cases) {
    if (found.scene == at.scene && found.drive == at.drive && found.impair == at.impair &&
        found.set == set) {
      return &found;
    }
  }
  return nullptr;
}

void AddSweep(const ReportCase& at, TextTable* table) {
  if (table->command.find(at.sweep) != std::string::npos) return;
  table->command += (table->command.empty() ? "make report  # sweeps: " : ", ") + at.sweep;
}

}  // namespace

TextTable StutterTable(const std::vector<ReportCase>& cases, const Before* before) {
  TextTable table;
  table.name = "must-stutter";
  table.title = "Stutter, what is noticed, and CPU, beside what was";
  table.header = {"scene",
                  "stutter before, lowest of three (m/s²)",
                  "stutter, default",
                  "stutter, central",
                  "verdict",
                  "seen before",
                  "seen, strict",
                  "seen, default",
                  "seen, central",
                  "CPU, default by retrospect"};
  std::size_t held = 0, judged = 0;
  for (const ReportCase& at : cases) {
    if (!IsPlain(at) || at.Find(kDefaultMethod) == nullptr) continue;
    const auto lowest = before == nullptr ? std::nullopt : LowestStutter(at, *before);
    const CaseMethod* own = at.Find(kDefaultMethod);
    const auto stutter = MedianOf(own, "stutter_mps2");
    const bool holds = lowest && stutter && *stutter <= *lowest;
    if (lowest && stutter) ++judged;
    held += holds ? 1 : 0;
    const auto seen = [&](const char* method) {
      return DigitsOrDash(MedianOf(at.Find(method), "seen"));
    };
    table.rows.push_back(
        {at.Name(), DigitsOrDash(lowest), CellOf(own, stutter),
         DigitsOrDash(MedianOf(at.Find(kCentralMethod), "stutter_mps2")),
         lowest && stutter ? (holds ? "held" : "missed") : "–",
         before == nullptr ? "–" : DigitsOrDash(before->Find(at, "retrospect", "seen")),
         seen("strict"), seen(kDefaultMethod), seen(kCentralMethod),
         Ratio(MedianOf(own, CpuMeasure()), MedianOf(at.Find("retrospect"), CpuMeasure()))});
    AddSweep(at, &table);
  }
  table.note = fmt::format(
      "{} of {} held: stutter at most the lowest of fade, retrospect and resimulate of commit "
      "f0a5095 in that row. Medians over seeds. CPU of server and clients together.",
      held, judged);
  table.open = true;
  return table;
}

TextTable ChangeTable(const std::vector<ReportCase>& cases, const Before* before) {
  TextTable table;
  table.name = "changes";
  table.title = "What each change did to error_others_m";
  table.header = {"scene",      "before: fade",       "before: retrospect", "before: resimulate",
                  "retrospect", "rollback, follow=0", "rollback",           "central/own",
                  "central/all"};
  for (const ReportCase& at : cases) {
    if (!IsPlain(at) || at.Find(kDefaultMethod) == nullptr) continue;
    std::vector<std::string> row = {at.Name()};
    for (const char* method : {"fade", "retrospect", "resimulate"}) {
      row.push_back(before == nullptr ? "–"
                                      : DigitsOrDash(before->Find(at, method, "error_others_m")));
    }
    if (before != nullptr && std::count(row.begin() + 1, row.end(), "–") == 3) continue;
    const auto cell = [&](const ReportCase* where, const char* method) {
      const CaseMethod* found = where == nullptr ? nullptr : where->Find(method);
      row.push_back(CellOf(found, MedianOf(found, "error_others_m")));
    };
    cell(&at, "retrospect");
    cell(With(at, "follow=0", cases), kDefaultMethod);
    cell(&at, kDefaultMethod);
    cell(&at, "central/own");
    cell(&at, kCentralMethod);
    table.rows.push_back(std::move(row));
    AddSweep(at, &table);
  }
  table.note =
      "Medians over seeds, m. Before: commit f0a5095, its recordings measured with the present "
      "measure. The same methods now: zones by predicted boxes, joints shut in views, hand-over "
      "with release. Then going back where it is needed (rollback), first within the buffer zone "
      "alone (follow=0), then with what moves towards it.";
  table.open = true;
  return table;
}

}  // namespace seam
