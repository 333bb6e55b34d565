#include "tests/lab/report/hurry_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tests/lab/report/method_look.h"
#include "tests/lab/report/validity.h"

namespace seam {
namespace {

/// Errors so much above the least are as good: seeds differ by more.
constexpr double kAsGood = 1.1;
/// As exact, for choosing by cost.
constexpr double kNearly = 1.25;

std::vector<std::string> MethodsOf(const std::vector<ReportCase>& cases) {
  std::vector<std::string> methods;
  for (const ReportCase& at : cases) {
    for (const CaseMethod& method : at.methods) {
      if (std::count(methods.begin(), methods.end(), method.name) > 0) continue;
      methods.push_back(method.name);
    }
  }
  std::stable_sort(methods.begin(), methods.end(),
                   [](const auto& a, const auto& b) { return MethodOrder(a) < MethodOrder(b); });
  return methods;
}

/// As they are run by default.
std::vector<ReportCase> PlainCases(const std::vector<ReportCase>& cases) {
  std::vector<ReportCase> plain;
  for (const ReportCase& at : cases) {
    if (!at.smooth || !at.set.empty() || at.methods.size() < 2) continue;
    if (at.sweep.rfind("must-", 0) != 0 || at.sweep == "must-limit") continue;
    plain.push_back(at);
  }
  return plain;
}

std::string CommandOf(const std::vector<ReportCase>& cases) {
  std::string command;
  for (const ReportCase& at : cases) {
    if (command.find(at.sweep) != std::string::npos) continue;
    command += (command.empty() ? "make report  # sweeps: " : ", ") + at.sweep;
  }
  return command;
}

/// One method at one x: what it errs and costs.
struct Offer {
  std::string method;
  double error = 0;
  std::optional<double> cpu, kbytes;

  std::string Words() const {
    return fmt::format("{} {}{}{}", method, Digits(error), cpu ? ", " + Digits(*cpu) + " ms/s" : "",
                       kbytes ? ", " + Digits(*kbytes) + " kB/s" : "");
  }
};

std::vector<Offer> OffersAt(const Sweep& sweep, const SweepGroup& group, double x) {
  std::vector<Offer> offers;
  const auto median = [&](const std::vector<std::size_t>& rows, const char* id) {
    const auto q = QuartilesOf(sweep.table, MeasureNamed(id), rows);
    return q ? std::optional<double>(q->median) : std::nullopt;
  };
  for (const std::string& method : group.methods) {
    const auto found = group.runs.at(method).find(x);
    if (found == group.runs.at(method).end()) continue;
    const auto error = median(found->second, "others");
    if (!error) continue;
    offers.push_back(
        {method, *error, median(found->second, "cpu"), median(found->second, "bytes")});
  }
  return offers;
}

std::vector<std::string> WhichRow(const std::vector<Offer>& offers) {
  const auto least =
      std::min_element(offers.begin(), offers.end(),
                       [](const Offer& a, const Offer& b) { return a.error < b.error; });
  const Offer* cheapest = &*least;
  for (const Offer& offer : offers) {
    if (offer.error > kNearly * least->error || !offer.cpu || !cheapest->cpu) continue;
    if (*offer.cpu < *cheapest->cpu) cheapest = &offer;
  }
  std::vector<std::string> row = {least->Words(),
                                  cheapest == &*least ? "the same" : cheapest->Words()};
  for (const char* method : {kDefaultMethod, kCentralMethod}) {
    const auto found = std::find_if(offers.begin(), offers.end(),
                                    [&](const Offer& offer) { return offer.method == method; });
    row.push_back(found == offers.end() ? "–" : found->Words().substr(found->method.size() + 1));
  }
  return row;
}

/// error_others_m, a row for each case.
TextTable ErrorTable(const std::vector<ReportCase>& cases,
                     const std::vector<std::string>& methods) {
  TextTable table;
  table.header = {"scene"};
  table.header.insert(table.header.end(), methods.begin(), methods.end());
  for (const ReportCase& at : cases) {
    std::optional<double> least;
    for (const std::string& name : methods) {
      const auto error = MedianOf(at.Find(name), "error_others_m");
      if (error && (!least || *error < *least)) least = error;
    }
    std::vector<std::string> row = {at.Name()};
    for (const std::string& name : methods) {
      const CaseMethod* method = at.Find(name);
      const auto error = MedianOf(method, "error_others_m");
      const bool good = error && least && *error <= kAsGood * *least;
      row.push_back((good ? "✓ " : "") + CellOf(method, error));
    }
    table.rows.push_back(std::move(row));
  }
  table.note =
      "Medians over seeds, m; ✓: within a tenth of the least in that row. Demo network unless "
      "said. Runs that are not valid are left out, and counted where there are any.";
  table.command = CommandOf(cases);
  table.open = true;
  return table;
}

}  // namespace

std::vector<SweepMeasure> FirstMeasures() {
  std::vector<SweepMeasure> measures;
  for (const char* id : {"others", "own", "path", "age", "response-own", "response-other", "seen",
                         "error", "stutter", "cpu", "server-cpu", "bytes"}) {
    measures.push_back(MeasureNamed(id));
  }
  return measures;
}

TextTable GlanceTable(const std::vector<ReportCase>& all) {
  const std::vector<ReportCase> cases = PlainCases(all);
  TextTable table = ErrorTable(cases, MethodsOf(cases));
  table.name = "glance";
  table.title = "error_others_m: what clients see of the others' bodies, by scene and method";
  return table;
}

TextTable ShortTable(const std::vector<ReportCase>& all) {
  // One of each kind: a vehicle, a wall, a heap, a ball between two players, two large worlds.
  static const std::vector<std::string> names = {"crossing, bots", "wall, bots",  "heap, bots, 4g",
                                                 "rally, bots",    "titanic, 4g", "playground, 4g"};
  std::vector<ReportCase> cases = PlainCases(all);
  cases.erase(std::remove_if(cases.begin(), cases.end(),
                             [](const ReportCase& at) {
                               return std::count(names.begin(), names.end(), at.Name()) == 0;
                             }),
              cases.end());
  TextTable table =
      ErrorTable(cases, {"strict", kCentralMethod, "fade", "retrospect", kDefaultMethod});
  table.name = "short";
  table.title = "error_others_m of five methods";
  return table;
}

TextTable MethodsTable(const std::vector<ReportCase>& all) {
  std::vector<ReportCase> cases = PlainCases(all);
  const std::size_t most = MethodsOf(cases).size();
  cases.erase(std::remove_if(cases.begin(), cases.end(),
                             [&](const ReportCase& at) { return at.methods.size() < most; }),
              cases.end());
  TextTable table;
  table.name = "methods";
  table.title = "Every method: its error and its price";
  table.header = {"method"};
  for (const SweepMeasure& measure : FirstMeasures()) table.header.push_back(measure.Label());
  std::string names;
  for (const ReportCase& at : cases) names += (names.empty() ? "" : "; ") + at.Name();
  for (const std::string& name : MethodsOf(cases)) {
    std::vector<std::string> row = {name};
    for (const SweepMeasure& measure : FirstMeasures()) {
      std::vector<double> medians;
      for (const ReportCase& at : cases) {
        if (const auto median = MedianOf(at.Find(name), measure)) medians.push_back(*median);
      }
      const auto q = FindQuartiles(medians);
      row.push_back(q ? Digits(q->median) : "–");
    }
    table.rows.push_back(std::move(row));
  }
  table.note = "The middle one of the medians of these cases, demo network: " + names + ".";
  table.command = CommandOf(cases);
  table.open = true;
  return table;
}

TextTable WhichTable(const std::vector<Sweep>& sweeps) {
  TextTable table;
  table.name = "which";
  table.title = "Which method for which latency and scene, at what cost";
  table.header = {"scene, one way",
                  "most exact",
                  "cheapest within a quarter of it",
                  std::string("default (") + kDefaultMethod + ")",
                  kCentralMethod,
                  "inputs held (m)"};
  for (const Sweep& sweep : sweeps) {
    if (sweep.view.axis.key != "one_way_ms") continue;
    bool any = false;
    for (const SweepGroup& group : sweep.view.groups) {
      if (group.xs.size() < 2) continue;
      for (const double x : group.xs) {
        const std::vector<Offer> offers = OffersAt(sweep, group, x);
        if (x <= 0 || offers.size() < 2) continue;
        std::vector<std::string> row = {
            fmt::format("{}{}, {:g} ms", group.scene, group.drive == "bot" ? ", bots" : "", x)};
        for (std::string& field : WhichRow(offers)) row.push_back(std::move(field));
        std::optional<double> limit;
        for (const auto& method : group.runs) {
          const auto found = method.second.find(x);
          if (limit || found == method.second.end()) continue;
          const auto q = QuartilesOf(sweep.table, MeasureNamed("info-limit"), found->second);
          if (q) limit = q->median;
        }
        row.push_back(DigitsOrDash(limit));
        table.rows.push_back(std::move(row));
        any = true;
      }
    }
    if (!any) continue;
    table.command += (table.command.empty() ? "make report  # sweeps: " : ", ") + sweep.name;
  }
  table.note =
      "Each: error_others_m (m), CPU of server and clients (ms per s), traffic of a client (kB/s); "
      "medians over seeds. Inputs held: exact physics from exact states of the recorded age, "
      "the others' inputs held. That is a guess and not a bound.";
  table.open = true;
  return table;
}

Section HurrySection(const std::vector<Sweep>& sweeps, const std::vector<ReportCase>& cases,
                     const Before* before) {
  Section section;
  section.id = "hurry";
  section.title = "For a reader in a hurry";
  section.intro =
      "error_others_m is the headline: RMS of the largest displacement of a point of a body, as "
      "clients see the bodies of others. First which method is most exact where, and what that "
      "costs; then every method scene by scene; the floors of chaos and of held inputs; and which "
      "of the project's "
      "own bars are held.";
  std::vector<TextTable> tables = {WhichTable(sweeps),        MethodsTable(cases),
                                   GlanceTable(cases),        FloorTable(sweeps),
                                   BarTable(cases, before),   StutterTable(cases, before),
                                   ChangeTable(cases, before)};
  for (TextTable& table : tables) {
    if (table.rows.empty()) continue;
    table.open = true;
    section.items.emplace_back(std::move(table));
  }
  TextTable six = ShortTable(cases);
  six.open = false;
  if (!six.rows.empty()) section.items.emplace_back(std::move(six));
  return section;
}

}  // namespace seam
