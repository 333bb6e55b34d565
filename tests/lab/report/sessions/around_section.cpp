#include "tests/lab/report/sessions/around_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/report/files.h"
#include "tests/lab/report/method_look.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

Figure AroundFigure(const fs::path& file) {
  const CsvTable table = CsvTable::Load(file.string());
  table.Require({"run", "event", "event_s", "after_s", "error_m"});
  Figure figure;
  figure.scene = file.stem().string();
  figure.name = "around-" + figure.scene;
  figure.panel_width_px = 560;
  figure.panel_height_px = 360;
  PlotPanel panel;
  panel.y = {"error, RMS of all views (m)", true, {}, "failed", "0", {}};
  std::string event = "event";
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string& run = table.Text(row, "run");
    event = table.Text(row, "event");
    const auto same = [&](const PlotCurve& curve) { return curve.name == run; };
    auto curve = std::find_if(panel.curves.begin(), panel.curves.end(), same);
    if (curve == panel.curves.end()) {
      panel.curves.push_back({run, MethodLook(run), {}});
      panel.curves.back().look.point = 0;
      curve = panel.curves.end() - 1;
    }
    const double at = table.Number(row, "after_s").value_or(0);
    const double error = table.Number(row, "error_m").value_or(0);
    curve->points.push_back({at, error, error, error});
  }
  panel.x.label = "time after the " + event + " (s)";
  panel.uprights.push_back({0, event});
  figure.title = fmt::format("{}: error around the {}", figure.scene, event);
  figure.caption = fmt::format(
      "One run of each method on one network; 0 s is the {} of each run. The error is against the "
      "oracle, at the tick that a view shows.",
      event);
  figure.command = "seam-measure out/report/renders/" + figure.scene + "-*.lcm --around " +
                   event.substr(event.rfind(' ') + 1) + " --around-csv " + file.string();
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace

Section AroundSection(const std::string& folder) {
  Section section;
  section.id = "around";
  section.title = "One event: the methods' errors over each other";
  section.intro = "How an error begins, how large it gets and how it ends, by tick.";
  std::error_code error;  // a folder that is not there has none
  for (const fs::path& file : FilesIn(folder, ".csv", &error)) {
    section.items.emplace_back(AroundFigure(file));
  }
  return section;
}

}  // namespace seam
