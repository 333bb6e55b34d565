#include "tests/lab/report/bars.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace seam {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
/// error_rms_m may exceed a bar of error_others_m by so much.
constexpr double kRmsShare = 1.2;

/// One line of the table. Bars are upper ones unless `least`; NaN: none, the figure is printed.
struct Bar {
  const char* scene;
  const char* drive;
  const char* impair;
  const char* column;
  double of_default;
  double of_central;
  bool least = false;
  double by_floor = 0;    ///< not 0: the default's bar is so many times floor_wire_m
  bool smooth = true;     ///< of the runs with the smoother
  bool by_limit = false;  ///< the column is divided by info_limit_m
};

constexpr const char* kOthers = "error_others_m";

const std::vector<Bar>& Bars() {
  static const std::vector<Bar> bars = {
      {"crossing", "bot", "demo", kOthers, 0.055, 0.05},
      {"crossing", "script", "demo", kOthers, 0.06, 0.05},
      {"wall", "bot", "demo", kOthers, 0.25, 0.05},
      {"stack", "script", "demo", kOthers, 0.0015, 0.005},
      {"scrum", "bot", "demo", kOthers, 0.08, 0.1},
      {"scrum", "script", "demo", kOthers, 0.08, 0.1},
      {"seesaw", "bot", "demo", kOthers, 0.08, 0.1},
      {"seesaw", "script", "demo", kOthers, 0.08, 0.1},
      {"rally", "bot", "demo", kOthers, 0.1, 0.1},
      {"rally", "script", "demo", kOthers, 0.1, 0.1},
      {"headon", "bot", "demo", kOthers, 0.08, 0.1},
      {"headon", "script", "demo", kOthers, 0.08, 0.1},
      {"heap", "bot", "4g", kOthers, 0.03, kNone},
      {"heap", "script", "4g", kOthers, 0.03, kNone},
      {"heap", "bot", "delay=200ms", kOthers, 0.08, kNone},
      {"heap", "script", "delay=200ms", kOthers, 0.08, kNone},
      {"train", "script", "demo", kOthers, 0.02, 0.02},
      {"relay", "script", "demo", kOthers, 0.015, 0.02},
      {"harbour", "script", "demo", kOthers, 0.012, 0.02},
      {"obstacle", "script", "demo", kOthers, 0.06, kNone},
      {"gas", "script", "demo", "energy_ratio_min", 0.85, 0.85, true},
      {"gas", "script", "demo", "energy_ratio_max", 1.15, 1.15},
      {"gas", "script", "demo", "hottest_ratio", 2, 2},
      {"titanic", "script", "4g", kOthers, 0.1, kNone},
      {"playground", "script", "4g", kOthers, 0.2, kNone},
      {"playground", "script", "4g", "stutter_mps2", 20, kNone},
      {"gluehouse", "script", "4g", kOthers, kNone, kNone, false, 1.2},
      {"crossing", "bot", "demo", kOthers, 2.2, 2, false, 0, false, true},
      {"crossing", "bot", "delay=200ms", kOthers, 1.5, 1.25, false, 0, false, true},
      {"wall", "bot", "demo", kOthers, 2.2, 2, false, 0, false, true},
      {"wall", "bot", "delay=200ms", kOthers, 1.5, 1.25, false, 0, false, true},
      {"headon", "bot", "demo", kOthers, 2.2, 2, false, 0, false, true},
      {"headon", "bot", "delay=200ms", kOthers, 1.5, 1.25, false, 0, false, true},
  };
  return bars;
}

const ReportCase* CaseFor(const Bar& bar, const std::vector<ReportCase>& cases) {
  for (const ReportCase& found : cases) {
    if (found.scene != bar.scene || found.drive != bar.drive || found.impair != bar.impair)
      continue;
    if (found.smooth != bar.smooth || !found.set.empty() || found.methods.size() < 2) continue;
    if (bar.by_limit != (found.sweep == "must-limit")) continue;
    return &found;
  }
  return nullptr;
}

/// What no method is expected to beat, from any sweep that has it. A floor is the scene's and its
/// drive's; the error of held inputs also depends on the network.
std::optional<double> Unbeaten(const Bar& bar, const std::vector<ReportCase>& cases,
                               const std::string& column) {
  for (const ReportCase& found : cases) {
    if (found.scene != bar.scene || found.drive != bar.drive) continue;
    if (column == "info_limit_m" && found.impair != bar.impair) continue;
    for (const CaseMethod& method : found.methods) {
      if (const auto floor = MedianOf(&method, column)) return floor;
    }
  }
  return std::nullopt;
}

std::optional<double> Value(const Bar& bar, const ReportCase& at, const char* method) {
  if (bar.by_limit) return MedianOf(at.Find(method), LimitMeasure());
  return MedianOf(at.Find(method), bar.column);
}

bool Holds(const Bar& bar, double limit, const std::optional<double>& value) {
  if (std::isnan(limit)) return true;
  return value && (bar.least ? *value >= limit : *value <= limit);
}

std::string BarText(const Bar& bar, double limit) {
  if (std::isnan(limit)) return "printed";
  return (bar.least ? "≥ " : "≤ ") + Digits(limit);
}

std::string Named(const Bar& bar, const ReportCase& at) {
  if (bar.by_limit) return at.Name() + ", smoother off: × inputs held";
  if (bar.column == std::string(kOthers)) return at.Name();
  return at.Name() + ": " + bar.column;
}

std::string Verdict(bool own, bool rms, bool central) {
  if (own && rms && central) return "held";
  std::string who;
  if (!own) who = "default";
  if (own && !rms) who = "default's error_rms_m";
  if (!central) who += who.empty() ? kCentralMethod : fmt::format(", {}", kCentralMethod);
  return "missed: " + who;
}

}  // namespace

std::optional<double> Before::Find(const ReportCase& at, const std::string& reconcile,
                                   const std::string& column) const {
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.Text(row, "scene") == at.scene && table.Text(row, "drive") == at.drive &&
        table.Text(row, "impair") == at.impair && table.Text(row, "reconcile") == reconcile) {
      return table.Number(row, column);
    }
  }
  return std::nullopt;
}

TextTable BarTable(const std::vector<ReportCase>& cases, const Before* before) {
  TextTable table;
  table.name = "must";
  table.title = "Held or missed: every bar, from these runs";
  table.header = {
      "scene",   "before",      "before, error_rms_m", "default", "default, error_rms_m",
      "central", "bar default", "bar central",         "verdict"};
  const auto text = [](const std::optional<double>& v) {
    return v ? Digits(*v) : std::string("–");
  };
  std::size_t held = 0;
  for (const Bar& bar : Bars()) {
    const ReportCase* at = CaseFor(bar, cases);
    if (at == nullptr) continue;
    const bool others = bar.column == std::string(kOthers) && !bar.by_limit;
    const auto own = Value(bar, *at, kDefaultMethod), central = Value(bar, *at, kCentralMethod);
    const auto rms = MedianOf(at->Find(kDefaultMethod), "error_rms_m");
    double limit = bar.of_default;
    const auto floor = Unbeaten(bar, cases, "floor_wire_m");
    if (bar.by_floor > 0 && floor) limit = bar.by_floor * *floor;
    const bool rms_held = !others || std::isnan(limit) || (rms && *rms <= kRmsShare * limit);
    std::string verdict =
        Verdict(Holds(bar, limit, own), rms_held, Holds(bar, bar.of_central, central));
    held += verdict == "held" ? 1 : 0;
    const auto known = Unbeaten(bar, cases, "info_limit_m");
    if (verdict != "held" && others && known && *known > limit)
      verdict += "; inputs held miss it too";
    const auto was = [&](const char* column) {
      return before == nullptr || bar.by_limit ? std::nullopt
                                               : before->Find(*at, "retrospect", column);
    };
    std::string bar_text = BarText(bar, limit);
    if (others && floor) bar_text += " (floor_wire_m " + Digits(*floor) + ")";
    if (others && known) bar_text += " (inputs held " + Digits(*known) + ")";
    table.rows.push_back({Named(bar, *at), text(was(bar.column)),
                          others ? text(was("error_rms_m")) : "–",
                          CellOf(at->Find(kDefaultMethod), own), others ? text(rms) : "–",
                          CellOf(at->Find(kCentralMethod), central), bar_text,
                          BarText(bar, bar.of_central), verdict});
    if (table.command.find(at->sweep) == std::string::npos) {
      table.command += (table.command.empty() ? "make report  # sweeps: " : ", ") + at->sweep;
    }
  }
  table.note = fmt::format(
      "{} of {} bars held. error_others_m in m unless said otherwise, medians over seeds, demo "
      "network unless said; default: {}, central: {}. The default's error_rms_m may exceed its bar "
      "by 20 %. Inputs held miss it too: exact physics with the others' inputs held is above the "
      "default's bar. Before: "
      "retrospect, the default of commit f0a5095, its recordings measured with "
      "the present measure (tests/lab/sweeps/before.csv).",
      held, table.rows.size(), kDefaultMethod, kCentralMethod);
  table.open = true;
  return table;
}

}  // namespace seam
