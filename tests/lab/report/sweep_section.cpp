#include "tests/lab/report/sweep_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "tests/lab/report/dots.h"
#include "tests/lab/report/method_look.h"
#include "tests/lab/report/validity.h"

namespace seam {
namespace {

std::string Where(const SweepGroup& group) {
  return group.scene + (group.drive == "bot" ? ", bots drive" : "");
}

std::string Name(const Sweep& sweep, const SweepGroup& group, const std::string& what) {
  std::string name = sweep.name + '-' + group.scene;
  if (group.drive != "script") name += '-' + group.drive;
  return name + '-' + what;
}

std::string AxisText(const SweepAxis& axis, double x) {
  return fmt::format("{:g}{}{}", x, axis.unit.empty() ? "" : " ", axis.unit);
}

/// Least and most runs behind a point of this group.
std::string Counts(const SweepGroup& group) {
  std::size_t least = SIZE_MAX, most = 0;
  for (const auto& method : group.runs) {
    for (const auto& point : method.second) {
      least = std::min(least, point.second.size());
      most = std::max(most, point.second.size());
    }
  }
  return least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
}

PlotPanel MeasurePanel(const Sweep& sweep, const SweepGroup& group, const SweepMeasure& measure) {
  PlotPanel panel;
  panel.x.label = sweep.view.axis.name +
                  (sweep.view.axis.unit.empty() ? "" : " (" + sweep.view.axis.unit + ")");
  panel.x.tics = group.xs.size() <= 8 ? group.xs : std::vector<double>();
  panel.y.label = measure.Label();
  panel.y.log = measure.log;
  for (const std::string& method : group.methods) {
    PlotCurve curve;
    curve.name = method;
    curve.look = MethodLook(method);
    for (const auto& point : group.runs.at(method)) {
      const auto q = QuartilesOf(sweep.table, measure, point.second);
      if (q) curve.points.push_back({point.first, q->median, q->low, q->high});
    }
    if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
  }
  return panel;
}

/// Draws the error of held inputs as a curve, because it depends on the network.
void AddLimit(const Sweep& sweep, const SweepGroup& group, PlotPanel* panel) {
  PlotCurve curve;
  curve.name = "inputs held";
  curve.look = {"#000000", "(1,2)", 2.2, 0, 0};
  for (const double x : group.xs) {
    std::vector<std::size_t> rows;
    for (const auto& method : group.runs) {
      const auto found = method.second.find(x);
      if (found != method.second.end()) {
        rows.insert(rows.end(), found->second.begin(), found->second.end());
      }
    }
    const auto q = QuartilesOf(sweep.table, MeasureNamed("info-limit"), rows);
    if (q) curve.points.push_back({x, q->median, q->low, q->high});
  }
  if (!curve.points.empty()) panel->curves.push_back(std::move(curve));
}

/// A single point here and there is in the tables.
bool HasCurves(const PlotPanel& panel) {
  return std::any_of(panel.curves.begin(), panel.curves.end(),
                     [](const PlotCurve& curve) { return curve.points.size() > 1; });
}

/// Something above zero somewhere.
bool HasSubstance(const PlotPanel& panel) {
  for (const PlotCurve& curve : panel.curves) {
    for (const PlotPoint& point : curve.points) {
      if (point.y != 0 || point.high != 0) return true;
    }
  }
  return false;
}

Figure CurvesOf(const Sweep& sweep, const SweepGroup& group) {
  Figure figure;
  figure.name = Name(sweep, group, "curves");
  figure.title = fmt::format("{}: against {}", Where(group), sweep.view.axis.name);
  figure.command = sweep.command;
  std::string nothing;
  for (const SweepMeasure& measure : SweepMeasures()) {
    PlotPanel panel = MeasurePanel(sweep, group, measure);
    if (!HasCurves(panel)) continue;
    if (!HasSubstance(panel)) {
      nothing += (nothing.empty() ? "" : ", ") + measure.name;
      continue;
    }
    if (measure.id == HeadlineOf(sweep).id) {
      AddLimit(sweep, group, &panel);
      for (const SweepMeasure& measured : FloorMeasures()) {
        if (measured.id == "info-limit") continue;
        const auto floor = QuartilesOf(sweep.table, measured, group);
        if (floor) panel.levels.push_back({floor->median, measured.name});
      }
    }
    if (measure.id == "penetration") {
      const auto oracle = QuartilesOf(sweep.table, OraclesPenetration(), group);
      if (oracle && oracle->median > 0) panel.levels.push_back({oracle->median, "oracle's own"});
    }
    if (measure.id == "rebound") panel.levels.push_back({1, "right"});
    figure.panels.push_back(std::move(panel));
  }
  const int count = static_cast<int>(figure.panels.size());
  figure.columns = count == 4 ? 2 : std::clamp(count, 1, 3);
  figure.panel_width_px = std::min(1200 / figure.columns, 600);
  figure.caption = fmt::format("Medians of {} seeds with quartiles. {}.", Counts(group),
                               sweep.view.fixed.empty() ? "" : "Network: " + sweep.view.fixed);
  if (!nothing.empty()) figure.caption += " Zero in all runs: " + nothing + ".";
  return figure;
}

/// One measure, by method and x.
TextTable AlongTable(const Sweep& sweep, const SweepGroup& group, const SweepMeasure& measure) {
  TextTable table;
  table.name = Name(sweep, group, measure.id);
  table.title =
      fmt::format("{}: {} against {}", Where(group), measure.Label(), sweep.view.axis.name);
  table.header = {"method"};
  for (const double x : group.xs) table.header.push_back(AxisText(sweep.view.axis, x));
  for (const std::string& method : group.methods) {
    std::vector<std::string> row = {method};
    for (const double x : group.xs) {
      const auto& points = group.runs.at(method);
      const auto found = points.find(x);
      if (found == points.end()) {
        row.push_back("–");
        continue;
      }
      row.push_back(WithValidity(Digits(QuartilesOf(sweep.table, measure, found->second)),
                                 FindValidity(sweep.table, found->second)));
    }
    table.rows.push_back(std::move(row));
  }
  table.note = fmt::format("{}, median (quartiles) of {} seeds. ", measure.Label(), Counts(group));
  for (const SweepMeasure& floor : FloorMeasures()) {
    const auto q = QuartilesOf(sweep.table, floor, group);
    if (q && measure.id == HeadlineOf(sweep).id) {
      table.note += fmt::format("{}: {} m. ", floor.name, Digits(q->median));
    }
  }
  table.note += sweep.view.fixed;
  table.command = sweep.command;
  return table;
}

/// All measures in the middle of the axis.
TextTable MeasuresTable(const Sweep& sweep, const SweepGroup& group) {
  const double x = group.xs[group.xs.size() / 2];
  TextTable table;
  table.name = Name(sweep, group, "measures");
  table.title = fmt::format("{}: all measures at {} {}", Where(group), sweep.view.axis.name,
                            AxisText(sweep.view.axis, x));
  std::vector<SweepMeasure> measures = SweepMeasures();
  measures.push_back(CpuMeasure());
  table.header = {"method"};
  for (const SweepMeasure& measure : measures) table.header.push_back(measure.Label());
  for (const std::string& method : group.methods) {
    const auto found = group.runs.at(method).find(x);
    if (found == group.runs.at(method).end()) continue;
    std::vector<std::string> row = {method};
    const Validity validity = FindValidity(sweep.table, found->second);
    for (const SweepMeasure& measure : measures) {
      const auto q = QuartilesOf(sweep.table, measure, found->second);
      const bool first = row.size() == 1;  // said once
      row.push_back(first ? WithValidity(q ? Digits(q->median) : "–", validity)
                          : (q ? Digits(q->median) : "–"));
    }
    table.rows.push_back(std::move(row));
  }
  table.note = fmt::format("{} {}; medians of {} seeds. {}", sweep.view.axis.name,
                           AxisText(sweep.view.axis, x), Counts(group), sweep.view.fixed);
  table.command = sweep.command;
  return table;
}

PlotPanel FrontPanel(const Sweep& sweep, const SweepGroup& group, const SweepMeasure& cost,
                     const SweepMeasure& error) {
  const std::vector<MethodTrial> trials = Trials(sweep, group, cost, error);
  PlotPanel panel;
  panel.x.label = cost.Label();
  panel.x.log = cost.id != "response-own";  // it may be 0
  panel.y.label = error.Label();
  panel.y.log = true;
  std::vector<CostError> all;
  for (const MethodTrial& t : trials) all.push_back(t.trial);
  PlotCurve front;
  front.name = "front";
  front.look = {"#f3c9a9", "solid", 7, 0, 0};  // a broad pale band behind the points
  for (const std::size_t i : ParetoFront(all)) {
    const CostError& t = all[i];
    // A front is a staircase: until the next point is paid for, one has the last.
    if (!front.points.empty()) {
      const double before = front.points.back().y;
      front.points.push_back({t.cost, before, before, before});
    }
    front.points.push_back({t.cost, t.error, t.error, t.error});
    panel.notes.push_back({t.cost, t.error, AxisText(sweep.view.axis, trials[i].x), false, -11});
  }
  panel.curves.push_back(std::move(front));
  for (const std::string& method : group.methods) {
    PlotCurve curve;
    curve.name = method;
    curve.look = MethodLook(method);
    curve.look.width = std::min(curve.look.width, 1.0);
    for (const MethodTrial& t : trials) {
      if (t.method != method) continue;
      curve.points.push_back({t.trial.cost, t.trial.error, t.trial.error, t.trial.error});
    }
    if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
  }
  return panel;
}

std::vector<std::string> PricesOf(const Sweep& sweep) {
  if (DelaysInputs(sweep)) return {"response-own"};
  if (sweep.view.axis.key == "smooth") return {"stutter"};
  return {"cpu", "bytes"};
}

Figure FrontsOf(const Sweep& sweep, const SweepGroup& group) {
  Figure figure;
  figure.name = Name(sweep, group, "fronts");
  figure.title = fmt::format("{}: what a better result costs", Where(group));
  figure.columns = 2;
  figure.panel_width_px = 560;
  figure.panel_height_px = 400;
  // A delay of inputs is paid for with the own response, a quick smoother with stutter.
  using Ids = std::vector<std::string>;
  const bool delay = DelaysInputs(sweep);
  const std::string headline = HeadlineOf(sweep).id;
  for (const std::string& error : Ids{headline, delay ? "error" : "seam"}) {
    for (const std::string& cost : PricesOf(sweep)) {
      PlotPanel panel = FrontPanel(sweep, group, MeasureNamed(cost), MeasureNamed(error));
      if (panel.curves.size() > 1) figure.panels.push_back(std::move(panel));
    }
  }
  figure.caption = fmt::format(
      "Each method at each {} (medians of {} seeds), joined in that order; the pale band is the "
      "front, than which nothing tried is cheaper and better; its points are labelled. {}.",
      sweep.view.axis.name, Counts(group), sweep.view.fixed);
  figure.command = sweep.command;
  return figure;
}

}  // namespace

const SweepMeasure& HeadlineOf(const Sweep& sweep) {
  return MeasureNamed(sweep.table.Has("error_others_m") ? "others" : "error");
}

bool DelaysInputs(const Sweep& sweep) { return sweep.view.axis.key == "input_delay_ticks"; }

std::vector<MethodTrial> Trials(const Sweep& sweep, const SweepGroup& group,
                                const SweepMeasure& cost, const SweepMeasure& error_measure) {
  std::vector<MethodTrial> trials;
  for (const std::string& method : group.methods) {
    for (const auto& point : group.runs.at(method)) {
      const auto price = QuartilesOf(sweep.table, cost, point.second);
      const auto error = QuartilesOf(sweep.table, error_measure, point.second);
      if (!price || !error) continue;
      trials.push_back({method, point.first, {price->median, error->median}});
    }
  }
  return trials;
}

Section SweepSection(const Sweep& sweep) {
  Section section;
  section.id = sweep.name;
  section.title = "Against " + sweep.view.axis.name + " (" + sweep.name + ")";
  section.part_of_last = true;
  for (const SweepGroup& group : sweep.view.groups) {
    const std::size_t first = section.items.size();
    const bool along = group.xs.size() > 1;  // a curve of one point says less than its table
    if (along) section.items.emplace_back(CurvesOf(sweep, group));
    Figure fronts = FrontsOf(sweep, group);
    const bool any = sweep.view.axis.ours && !fronts.panels.empty();
    if (any) section.items.emplace_back(std::move(fronts));
    Figure dots = DotsOf(sweep, group);
    if (!dots.panels.empty()) section.items.emplace_back(std::move(dots));
    const SweepMeasure& headline = HeadlineOf(sweep);
    section.items.emplace_back(AlongTable(sweep, group, headline));
    if (DelaysInputs(sweep)) {
      section.items.emplace_back(AlongTable(sweep, group, MeasureNamed("response-own")));
    }
    if (headline.id != "error") {
      section.items.emplace_back(AlongTable(sweep, group, MeasureNamed("error")));
    }
    if (QuartilesOf(sweep.table, MeasureNamed("seam"), group)) {
      section.items.emplace_back(AlongTable(sweep, group, MeasureNamed("seam")));
    }
    if (QuartilesOf(sweep.table, LimitMeasure(), group)) {
      section.items.emplace_back(AlongTable(sweep, group, LimitMeasure()));
    }
    section.items.emplace_back(MeasuresTable(sweep, group));
    for (std::size_t i = first; i < section.items.size(); ++i) {
      if (auto* figure = std::get_if<Figure>(&section.items[i])) figure->scene = group.scene;
      if (auto* table = std::get_if<TextTable>(&section.items[i])) table->scene = group.scene;
    }
  }
  return section;
}

}  // namespace seam
