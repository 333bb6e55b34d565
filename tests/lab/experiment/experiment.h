#pragma once
/// A table of runs. Each row has a key, which identifies the run, and the values measured of it.
/// Makes the rows that are missing, each in a process of its own.

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/base/command_line.h"
#include "tests/lab/experiment/result_table.h"

namespace seam {

struct Experiment {
  std::string key_columns;        ///< names, with commas between
  std::string value_columns;      ///< the same of the values behind the key
  std::set<std::string> texts;    ///< columns of values that are no numbers
  std::set<std::string> filled;   ///< columns that are empty in no row
  std::vector<std::string> keys;  ///< of each row, as CSV
  /// Returns the values of a row as CSV. Called in another process.
  std::function<std::string(std::size_t row)> measure;
  /// Returns the values of a row whose process failed with `why`; nullopt: it gets no row. May be
  /// empty.
  std::function<std::optional<std::string>(std::size_t row, const std::string& why)> rescue;
};

/// The flags of each command that makes a table.
struct TableFlags {
  std::string table;   ///< CSV file to write or complete
  int jobs = 0;        ///< runs at a time; 0: as many as there are cores
  bool force = false;  ///< begin the table anew
  bool quiet = false;  ///< no progress line
  std::string shard;   ///< "I/N": one shard of the rows (shard.h), and `table` is a folder; "": all
  std::string have;    ///< pattern of tables whose rows are left out; "": none
};

/// Adds -o, which says where the table goes.
Flag AddTableFlag(Command& command, TableFlags& flags);
/// Adds --jobs, --force and --quiet.
void AddRunFlags(Command& command, TableFlags& flags,
                 const char* jobs = "runs at a time (default: one a core)");

/// Returns `wanted`, or the number of cores if it is 0.
int JobsOr(int wanted);

/// Opens the table and takes over the rows of an earlier run. Throws OperatorError, as ResultTable
/// does.
std::unique_ptr<ResultTable> OpenTable(const Experiment& experiment, const TableFlags& flags);

/// Returns the rows that the table does not have, in ascending order.
std::vector<std::size_t> MissingRows(const ResultTable& table, std::size_t rows);

struct RowsDone {
  std::size_t added = 0, failed = 0;
};

/// Makes the missing rows, with a progress line unless `quiet`. Names failures on stderr by their
/// key. Ends early on a signal (StopOnSignals).
RowsDone MakeRows(const Experiment& experiment, const TableFlags& flags, ResultTable* table);

/// Prints one line with the number of rows. Returns the exit status: 0 when no row is missing.
int PrintRows(const TableFlags& flags, const ResultTable& table, std::size_t rows,
              const RowsDone& done);

/// Opens, completes and closes the table. Returns the exit status.
int CompleteTable(const Experiment& experiment, const TableFlags& flags);

}  // namespace seam
