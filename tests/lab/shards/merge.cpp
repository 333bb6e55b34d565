#include "tests/lab/shards/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>
#include <vector>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/base/progress_count.h"
#include "common/base/random.h"
#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/experiment/jobs.h"
#include "tests/lab/experiment/key_index.h"
#include "tests/lab/experiment/shard.h"
#include "tests/lab/experiment/values.h"

namespace seam {
namespace {

using Fields = std::vector<std::string>;

/// A whole table as it grows: for each row of the experiment its fields.
class Merged {
 public:
  Merged(const Experiment& experiment, const std::set<std::string>& times)
      : header_(CsvFields(experiment.key_columns + ',' + experiment.value_columns)),
        key_columns_(CsvFields(experiment.key_columns).size()),
        times_(times),
        texts_(experiment.texts),
        filled_(experiment.filled),
        lines_(experiment.keys.size()),
        from_(experiment.keys.size()),
        keys_(experiment.keys),
        rows_(CsvFields(experiment.key_columns)) {
    for (std::size_t i = 0; i < keys_.size(); ++i) rows_.Add(CsvFields(keys_[i]), i);
  }

  /// Adds the rows of a table. Throws OperatorError, which names file and line.
  void Add(const CsvTable& table) {
    if (table.header() != header_) {
      throw OperatorError(table.path() + ": has other columns than this program's sweeps");
    }
    for (std::size_t row = 0; row < table.rows(); ++row) AddRow(table, row);
  }
  /// The rows as CSV; empty: missing.
  const std::vector<std::string>& lines() const { return lines_; }
  std::vector<std::size_t> Missing() const {
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (lines_[i].empty()) missing.push_back(i);
    }
    return missing;
  }
  /// Returns the first column, but for times, in which the two rows differ; "": none.
  std::string Difference(const std::string& line_a, const std::string& line_b) const {
    const Fields a = CsvFields(line_a), b = CsvFields(line_b);
    for (std::size_t c = 0; c < header_.size(); ++c) {
      if (a[c] != b[c] && times_.count(header_[c]) == 0) return header_[c];
    }
    return "";
  }

 private:
  void AddRow(const CsvTable& table, std::size_t row) {
    Fields fields;
    for (const std::string& column : header_) fields.push_back(table.Text(row, column));
    const std::string where = fmt::format("{}: row {}", table.path(), row + 1);
    const std::optional<std::size_t> found = rows_.Find(KeyOf(fields));
    if (!found) throw OperatorError(where + WhyForeign(fields));
    RequireValues(table, row, where);
    std::string& there = lines_[*found];
    const Fields key = CsvFields(keys_[*found]);  // the scene may have another folder here
    std::copy(key.begin(), key.end(), fields.begin());
    const std::string line = CsvRow(fields);
    if (there.empty()) {
      there = line;
      from_[*found] = where;
      return;
    }
    const std::string column = Difference(there, line);
    if (column.empty()) return;
    throw OperatorError(where + " and " + from_[*found] + " are the same run, but differ in " +
                        column + ": something is not deterministic");
  }
  /// Throws OperatorError for a value that no run has: not a number, or nothing where all have one.
  void RequireValues(const CsvTable& table, std::size_t row, const std::string& where) const {
    for (std::size_t c = key_columns_; c < header_.size(); ++c) {
      const std::string& column = header_[c];
      if (texts_.count(column) == 0) (void)table.Number(row, column);
      if (filled_.count(column) > 0 && table.Text(row, column).empty()) {
        throw OperatorError(where + " has nothing in " + column);
      }
    }
  }
  Fields KeyOf(const Fields& fields) const {
    return Fields(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(key_columns_));
  }
  /// Returns why no row of the experiment has the key: another build, by name, or another sweep.
  std::string WhyForeign(const Fields& fields) const {
    const Fields ours = CsvFields(keys_.front());
    for (std::size_t c = 0; c < key_columns_; ++c) {
      const bool build =
          header_[c] == "version" || header_[c] == "commit" || header_[c] == "numerics";
      if (build && fields[c] != ours[c]) {
        return fmt::format(" has the {} {}, and this program {}", header_[c], fields[c], ours[c]);
      }
    }
    return " is not of this sweep";
  }

  const Fields header_;
  const std::size_t key_columns_;
  const std::set<std::string>& times_;
  const std::set<std::string> texts_, filled_;
  std::vector<std::string> lines_;  // by row; empty: missing
  std::vector<std::string> from_;   // by row: file and row
  const std::vector<std::string>& keys_;
  KeyIndex rows_;
};

/// Returns N if every name ends with ".I-of-N.csv" with the same N; else 0.
std::size_t ShardsOf(const std::vector<std::string>& tables) {
  std::size_t all = 0;
  for (const std::string& path : tables) {
    const std::size_t of = path.rfind("-of-");
    std::size_t count = 0;
    int end = 0;
    if (of == std::string::npos) return 0;
    if (std::sscanf(path.c_str() + of, "-of-%5zu.csv%n", &count, &end) != 1 || end == 0) return 0;
    if (all != 0 && count != all) return 0;
    all = count;
  }
  return all;
}

/// Names the shards that have the missing rows.
std::string ShardsToRun(const Experiment& experiment, const std::vector<std::size_t>& missing,
                        std::size_t count) {
  const Fields columns = CsvFields(experiment.key_columns);
  std::set<std::size_t> shards;
  for (const std::size_t row : missing) {
    shards.insert(ShardOf(columns, experiment.keys[row], count));
  }
  std::string text;
  for (const std::size_t shard : shards) text += fmt::format(" {}/{}", shard, count);
  return text;
}

void WriteWhole(const std::string& path, const Experiment& experiment, const Merged& merged) {
  std::string text = experiment.key_columns + ',' + experiment.value_columns + '\n';
  for (const std::string& line : merged.lines()) {
    if (!line.empty()) text += line + '\n';
  }
  const std::string draft = path + ".part";
  std::FILE* file = OpenPlainFile(draft, FileUse::kReplace);
  bool good = file != nullptr;
  if (good) {
    good = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    good = std::fclose(file) == 0 && good;
    good = good && std::rename(draft.c_str(), path.c_str()) == 0;
  }
  if (good) return;
  const std::string why = std::strerror(errno);
  std::remove(draft.c_str());
  throw OperatorError(path + ": cannot be written: " + why);
}

/// Returns so many of `rows`, drawn without repetition, ascending.
std::vector<std::size_t> Drawn(std::vector<std::size_t> rows, std::size_t count,
                               std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(rows[i], rows[i + random.Next() % (rows.size() - i)]);
  }
  rows.resize(count);
  std::sort(rows.begin(), rows.end());
  return rows;
}

}  // namespace

int MergeTables(const Experiment& experiment, const std::set<std::string>& times,
                const MergeCommand& command) {
  RequireOutput(command.whole, command.force, command.tables);
  Merged merged(experiment, times);
  for (const std::string& path : command.tables) merged.Add(CsvTable::Load(path));
  const std::vector<std::size_t> missing = merged.Missing();
  const std::size_t all = experiment.keys.size();
  if (!missing.empty()) {
    const std::size_t count = ShardsOf(command.tables);
    std::fprintf(stderr, "seam-lab: %zu of %zu rows are missing%s%s\n", missing.size(), all,
                 count > 0 ? "; run --shard" : ", the first: ",
                 count > 0 ? ShardsToRun(experiment, missing, count).c_str()
                           : experiment.keys[missing.front()].c_str());
    if (!command.partial) return 1;
  }
  WriteWhole(command.whole, experiment, merged);
  std::printf("%s: %zu of %zu rows\n", command.whole.c_str(), all - missing.size(), all);
  return missing.empty() ? 0 : 1;
}

int VerifyTable(const Experiment& experiment, const std::set<std::string>& times,
                const VerifyCommand& command) {
  Merged merged(experiment, times);
  merged.Add(CsvTable::Load(command.table));
  std::vector<std::size_t> there;
  for (std::size_t i = 0; i < experiment.keys.size(); ++i) {
    if (!merged.lines()[i].empty()) there.push_back(i);
  }
  if (there.empty()) throw OperatorError(command.table + ": has no row to run again");
  const double share = std::ceil(static_cast<double>(there.size()) * command.share_percent / 100);
  const std::vector<std::size_t> rows =
      Drawn(there, static_cast<std::size_t>(share), static_cast<std::uint64_t>(command.seed));
  ProgressCount progress("running again", "runs", static_cast<std::int64_t>(rows.size()),
                         command.quiet);
  std::size_t same = 0, done = 0;
  StopOnSignals();
  RunJobs(
      rows.size(), JobsOr(command.jobs), [&](std::size_t i) { return experiment.measure(rows[i]); },
      [&](std::size_t i, const JobResult& result) {
        progress(static_cast<std::int64_t>(++done));
        const std::string& key = experiment.keys[rows[i]];
        const std::string column =
            result.good ? merged.Difference(merged.lines()[rows[i]], key + ',' + result.text)
                        : result.text;
        if (column.empty()) {
          ++same;
          return;
        }
        progress.End();
        std::fprintf(stderr, "seam-lab: differs in %s: %s\n", column.c_str(), key.c_str());
      },
      [] { return g_stop != 0; });
  std::printf("%s: %zu of %zu rows run again are the same\n", command.table.c_str(), same,
              rows.size());
  return same == rows.size() ? 0 : 1;
}

}  // namespace seam
