#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/base/progress_count.h"
#include "tests/lab/commands.h"
#include "tests/lab/experiment/experiment.h"
#include "tests/lab/gait/gains_text.h"
#include "tests/lab/gait/gait_tune.h"

namespace seam {
namespace {

struct Row {
  std::string group;
  int good = 0, count = 0;
  std::vector<double> figures;
  double median() {
    std::sort(figures.begin(), figures.end());
    return figures.empty() ? 0 : figures[figures.size() / 2];
  }
};

std::vector<Row> RowsOf(const std::vector<GaitTrial>& trials) {
  std::vector<Row> rows;
  const auto add = [&](const std::string& group, const GaitTrial& trial) {
    auto row =
        std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.group == group; });
    if (row == rows.end()) row = rows.insert(rows.end(), Row{group, 0, 0, {}});
    row->good += trial.good ? 1 : 0;
    ++row->count;
    row->figures.push_back(trial.figure);
  };
  for (const GaitTrial& trial : trials) add("all", trial);
  for (const GaitTrial& trial : trials) add(trial.group, trial);
  std::sort(rows.begin() + 1, rows.end(),
            [](const Row& a, const Row& b) { return a.group < b.group; });
  return rows;
}

/// Good trials and the median figure of each group, with the gains built in and with the new ones.
void PrintTable(const char* title, const GaitFile& file, const StartRange& starts,
                const CharacterGains& after, int jobs) {
  std::vector<Row> before_rows = RowsOf(RunTrials(file, CharacterGains{}, starts, jobs));
  std::vector<Row> after_rows = RowsOf(RunTrials(file, after, starts, jobs));
  std::printf("%s, starts %d to %d: good, and median %s\n%-22s %12s %10s %12s %10s\n", title,
              starts.from, starts.from + starts.count - 1,
              FindAbility(file.ability)->figure.c_str(), "", "before", "", "after", "");
  for (std::size_t i = 0; i < before_rows.size(); ++i) {
    Row &b = before_rows[i], &a = after_rows[i];
    std::printf("%-22s %5d of %-4d %9.3f %6d of %-4d %9.3f\n", b.group.c_str(), b.good, b.count,
                b.median(), a.good, a.count, a.median());
  }
}

void PrintChanges(const GaitFile& file, const CharacterGains& gains) {
  CharacterGains before, after = gains;
  for (const SearchedGain& gain : file.gains) {
    std::printf("  %-18s %10.5g -> %.5g\n", gain.name.c_str(),
                static_cast<double>(*FindGain(&before, gain.name)),
                static_cast<double>(*FindGain(&after, gain.name)));
  }
}

void WriteText(const std::string& path, const std::string& text) {
  std::FILE* out = OpenPlainFile(path, FileUse::kReplace);
  const bool wrote = out != nullptr && std::fwrite(text.data(), 1, text.size(), out) == text.size();
  const bool closed = out != nullptr && std::fclose(out) == 0;
  if (!wrote || !closed) throw OperatorError(path + ": cannot be written");
}

}  // namespace

int RunTuneGait(const TuneGaitCommand& command) {
  GaitFile file = ReadGaitFile(command.objective);
  if (command.generations >= 0) file.generations = command.generations;
  if (command.seed >= 0) file.seed = command.seed;
  std::string text;
  if (!command.output.empty()) {  // a file that cannot take them is said before the search
    text = ReadPlainFile(command.output, 1 << 20);
    WithGains(text, CharacterGains{});
  }
  const int jobs = JobsOr(command.jobs);
  StopOnSignals();
  std::printf("%s: %zu gains, %d training starts, %d samples a generation\n", file.ability.c_str(),
              file.gains.size(), file.train.count, file.lambda);
  ProgressCount progress("searching", "generations", file.generations);
  const GaitResult result = TuneGait(file, jobs, [&progress](const GaitGeneration& g) {
    progress.End();
    std::printf("generation %3d: best %.4f, median %.4f, sigma %.3f\n", g.number, g.best, g.median,
                g.sigma);
    std::fflush(stdout);
    progress(g.number);
  });
  progress.End();
  std::printf("training cost %.4f -> %.4f\n", result.before, result.after);
  PrintChanges(file, result.gains);
  if (!result.complete) return 1;
  PrintTable("training", file, file.train, result.gains, jobs);
  PrintTable("held out", file, file.held_out, result.gains, jobs);
  if (g_stop != 0) return 1;
  if (!command.output.empty()) {
    WriteText(command.output, WithGains(text, result.gains));
    std::printf("%s written\n", command.output.c_str());
  }
  return 0;
}

}  // namespace seam
