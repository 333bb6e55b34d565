#include "tests/lab/report/html/answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "common/base/json_text.h"
#include "common/net/impair.h"

namespace seam {
namespace {

using Place = std::tuple<double, double>;  ///< latency, loss

std::optional<double> Median(const Sweep& sweep, const char* id,
                             const std::vector<std::size_t>& rows) {
  const auto q = QuartilesOf(sweep.table, MeasureNamed(id), rows);
  return q ? std::optional<double>(q->median) : std::nullopt;
}

double NetworkOf(const Sweep& sweep, std::size_t row, const char* column, double otherwise) {
  const auto number = sweep.table.Number(row, column);
  return number ? *number : otherwise;
}

Answer AnswerOf(const Sweep& sweep, const SweepGroup& group, const std::string& method,
                const std::vector<std::size_t>& rows, double error) {
  const ImpairProfile profile = FindProfile(sweep.table.Text(rows.front(), "impair"));
  Answer answer;
  answer.scene = group.scene + (group.drive == "bot" ? ", bots" : "");
  const auto latency_ms = static_cast<double>(profile.delay_us) * 1e-3;
  answer.one_way_ms = NetworkOf(sweep, rows.front(), "one_way_ms", latency_ms);
  const double loss = NetworkOf(sweep, rows.front(), "loss_percent", 100 * MeanLoss(profile));
  answer.loss_percent = std::round(10 * loss) / 10;
  answer.method = method;
  answer.error_m = error;
  answer.cpu_ms_per_s = Median(sweep, "cpu", rows);
  answer.kbytes_per_s = Median(sweep, "bytes", rows);
  answer.response_ms = Median(sweep, "response-own", rows);
  return answer;
}

std::string Json(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{:.5g}", *value) : "null";
}

std::string AnswersJson(const std::vector<Answer>& answers) {
  std::string rows;
  for (const Answer& a : answers) {
    rows +=
        fmt::format("{}[{},{:g},{:g},{},{},{},{},{}]", rows.empty() ? "" : ",\n", JsonText(a.scene),
                    a.one_way_ms, a.loss_percent, JsonText(a.method), Json(a.error_m),
                    Json(a.cpu_ms_per_s), Json(a.kbytes_per_s), Json(a.response_ms));
  }
  return "[" + rows + "]";
}

/// Of one network: each method's errors as multiples of the least of their scene.
struct Standing {
  double log_ratios = 0;
  int scenes = 0;
  std::vector<double> errors, cpu, kbytes;
  double Ratio() const { return std::exp(log_ratios / scenes); }
};

double MiddleOf(std::vector<double> values) {
  const auto q = FindQuartiles(values);
  return q ? q->median : std::nan("");
}

/// The least error that is still told apart: a micrometre; so that zero has a logarithm.
constexpr double kLeast_m = 1e-6;

/// Without those of scenes in which less than half as many methods ran as in another: they say
/// nothing of the others.
std::vector<const Answer*> WhereMostRan(const std::vector<const Answer*>& answers) {
  std::map<std::string, int> methods;  // by scene
  int most = 0;
  for (const Answer* a : answers) most = std::max(most, ++methods[a->scene]);
  std::vector<const Answer*> kept;
  for (const Answer* a : answers) {
    if (2 * methods[a->scene] >= most) kept.push_back(a);
  }
  return kept;
}

std::map<std::string, Standing> StandingsOf(const std::vector<const Answer*>& answers) {
  std::map<std::string, double> least;
  std::map<std::string, int> methods;
  for (const Answer* a : answers) {
    const auto [found, fresh] = least.emplace(a->scene, std::max(a->error_m, kLeast_m));
    if (!fresh) found->second = std::min(found->second, std::max(a->error_m, kLeast_m));
    ++methods[a->method];
  }
  std::map<std::string, Standing> standings;
  for (const Answer* a : answers) {
    if (methods[a->method] < static_cast<int>(least.size())) continue;  // not run in all scenes
    Standing& standing = standings[a->method];
    standing.log_ratios += std::log(std::max(a->error_m, kLeast_m) / least[a->scene]);
    ++standing.scenes;
    standing.errors.push_back(a->error_m);
    if (a->cpu_ms_per_s) standing.cpu.push_back(*a->cpu_ms_per_s);
    if (a->kbytes_per_s) standing.kbytes.push_back(*a->kbytes_per_s);
  }
  return standings;
}

TextTable AnswersTable(const std::vector<Answer>& answers) {
  std::map<Place, std::vector<const Answer*>> places;
  for (const Answer& a : answers) places[{a.one_way_ms, a.loss_percent}].push_back(&a);
  TextTable table;
  table.name = "answers";
  table.title = "For each network that was measured: what to use";
  table.header = {"network, each way", "use",         "error (m)", "CPU (ms per s)",
                  "traffic (kB/s)",    "scenes tried"};
  for (const auto& [place, here] : places) {
    const auto standings = StandingsOf(WhereMostRan(here));
    if (standings.size() < 2) continue;
    const auto best = std::min_element(
        standings.begin(), standings.end(),
        [](const auto& a, const auto& b) { return a.second.Ratio() < b.second.Ratio(); });
    const Standing& s = best->second;
    const auto digits = [](const std::vector<double>& values) {
      return values.empty() ? "–" : Digits(MiddleOf(values));
    };
    table.rows.push_back(
        {fmt::format("{:g} ms, {:g} % loss", std::get<0>(place), std::get<1>(place)), best->first,
         digits(s.errors), digits(s.cpu), digits(s.kbytes), std::to_string(s.scenes)});
  }
  table.note =
      "The method whose errors, as multiples of the least of each scene, have the least geometric "
      "mean; of methods that ran in all scenes of that network in which at least half as many "
      "methods ran as in another. Medians over seeds and scenes.";
  table.command = "make report";
  table.open = true;
  return table;
}

}  // namespace

std::vector<Answer> FindAnswers(const std::vector<Sweep>& sweeps) {
  std::vector<Answer> answers;
  std::map<std::tuple<std::string, Place, std::string>, bool> known;
  for (const Sweep& sweep : sweeps) {
    if (sweep.view.axis.key != "one_way_ms" && sweep.view.axis.key != "loss_percent") continue;
    const std::string error_id = sweep.table.Has("error_others_m") ? "others" : "error";
    for (const SweepGroup& group : sweep.view.groups) {
      for (const std::string& method : group.methods) {
        // A name with a comma says what else was varied: no method of its own.
        if (method == "oracle" || method.find(',') != std::string::npos) continue;
        for (const auto& [x, rows] : group.runs.at(method)) {
          const auto error = Median(sweep, error_id.c_str(), rows);
          if (!error || !std::isfinite(*error)) continue;
          Answer answer = AnswerOf(sweep, group, method, rows, *error);
          const Place place{answer.one_way_ms, answer.loss_percent};
          if (!known.emplace(std::tuple{answer.scene, place, method}, true).second) continue;
          answers.push_back(std::move(answer));
        }
      }
    }
  }
  return answers;
}

Section AnswersSection(const std::vector<Sweep>& sweeps) {
  Section section;
  const std::vector<Answer> answers = FindAnswers(sweeps);
  section.id = "answers";
  section.title = "What to use";
  section.intro =
      "Say what your network does: the methods that were measured on the nearest network, the most "
      "exact first, with what they cost.";
  if (answers.empty()) return section;
  section.items.emplace_back(Answers{AnswersJson(answers)});
  TextTable table = AnswersTable(answers);
  if (!table.rows.empty()) section.items.emplace_back(std::move(table));
  return section;
}

}  // namespace seam
