#include "tests/lab/experiment/shard.h"

#include <glob.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>

#include "common/base/bytes.h"
#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/experiment/key_index.h"
#include "tests/lab/experiment/values.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

bool DiffersByBuild(const std::string& column) {
  return column == "version" || column == "commit" || column == "numerics";
}

std::vector<std::string> FilesLike(const std::string& pattern) {
  glob_t found{};
  const int error = glob(pattern.c_str(), 0, nullptr, &found);
  std::vector<std::string> files(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  if (error != 0 && error != GLOB_NOMATCH) throw OperatorError("--have " + pattern + ": no folder");
  return files;
}

/// Adds the rows of the experiment that are in a table.
void AddRowsOf(const CsvTable& table, const std::vector<std::string>& columns,
               const KeyIndex& index, std::set<std::size_t>* rows) {
  table.Require(columns);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<std::string> key;
    for (const std::string& column : columns) key.push_back(table.Text(row, column));
    if (const auto found = index.Find(key)) rows->insert(*found);
  }
}

/// The same of a file; a last line that is half written is no row.
void AddWholeRowsOf(const std::string& path, const std::vector<std::string>& columns,
                    const KeyIndex& index, std::set<std::size_t>* rows) {
  const std::string text = ReadPlainFile(path, kTableBytesMax);
  const std::size_t end = text.rfind('\n');
  if (end != std::string::npos) {
    AddRowsOf(CsvTable::Parse(text.substr(0, end + 1), path), columns, index, rows);
  }
}

/// Returns the rows of the experiment that others have: those in the tables of --have without those
/// in `own`.
std::set<std::size_t> RowsHad(const std::string& have, const std::string& own, bool force,
                              const Experiment& experiment,
                              const std::vector<std::string>& columns) {
  KeyIndex index(columns);
  for (std::size_t row = 0; row < experiment.keys.size(); ++row) {
    index.Add(CsvFields(experiment.keys[row]), row);
  }
  std::error_code unknown;
  std::set<std::size_t> had, done;
  for (const std::string& path : FilesLike(have)) {
    if (fs::equivalent(path, own, unknown)) continue;
    AddWholeRowsOf(path, columns, index, &had);
  }
  if (force || !fs::exists(own, unknown)) return had;
  AddWholeRowsOf(own, columns, index, &done);
  for (const std::size_t row : done) had.erase(row);
  return had;
}

}  // namespace

std::size_t ShardOf(const std::vector<std::string>& columns, const std::string& key,
                    std::size_t count) {
  std::vector<std::string> fields = CsvFields(key);
  SEAM_ASSERT(fields.size() == columns.size() && count > 0);
  std::vector<std::string> counted;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (DiffersByBuild(columns[i])) continue;
    const bool path = columns[i] == "scene";
    counted.push_back(path ? fields[i].substr(fields[i].rfind('/') + 1) : fields[i]);
  }
  const std::string text = CsvRow(counted);
  return static_cast<std::size_t>(Fnv1a(text.data(), text.size()) % count);
}

Shard ParseShard(const std::string& text) {
  Shard shard;
  int end = 0;
  const bool read =
      std::sscanf(text.c_str(), "%5zu/%5zu%n", &shard.index, &shard.count, &end) == 2 &&
      static_cast<std::size_t>(end) == text.size();
  if (!read || shard.count < 1 || shard.index >= shard.count) {
    throw OperatorError("--shard " + text + ": must be I/N, with I from 0 to N - 1");
  }
  return shard;
}

Experiment WithRows(const Experiment& experiment, const std::vector<std::size_t>& rows) {
  Experiment part = experiment;
  part.keys.clear();
  for (const std::size_t row : rows) part.keys.push_back(experiment.keys[row]);
  part.measure = [measure = experiment.measure, rows](std::size_t i) { return measure(rows[i]); };
  if (experiment.rescue) {
    part.rescue = [rescue = experiment.rescue, rows](std::size_t i, const std::string& why) {
      return rescue(rows[i], why);
    };
  }
  return part;
}

int CompleteShard(const Experiment& experiment, const TableFlags& flags, const std::string& name) {
  const std::vector<std::string> columns = CsvFields(experiment.key_columns);
  const Shard shard = flags.shard.empty() ? Shard() : ParseShard(flags.shard);
  TableFlags own = flags;
  if (!flags.shard.empty()) {
    if (mkdir(flags.table.c_str(), 0777) != 0 && errno != EEXIST) {
      throw OperatorError(flags.table + ": cannot be made: " + std::strerror(errno));
    }
    own.table += "/" + name + "." + std::to_string(shard.index) + "-of-" +
                 std::to_string(shard.count) + ".csv";
  }
  std::set<std::size_t> had;
  if (!flags.have.empty()) had = RowsHad(flags.have, own.table, flags.force, experiment, columns);
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < experiment.keys.size(); ++row) {
    const std::string& key = experiment.keys[row];
    if (ShardOf(columns, key, shard.count) != shard.index) continue;
    if (had.count(row) == 0) rows.push_back(row);
  }
  return CompleteTable(WithRows(experiment, rows), own);
}

}  // namespace seam
