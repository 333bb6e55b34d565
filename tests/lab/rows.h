#pragma once
/// Makes the missing rows of a table in separate processes and adds each when it is done.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/lab/sweep_table.h"

namespace seam {

struct RowMaker {
  /// The line of a row, made in another process.
  std::function<std::string(std::size_t row)> make;
  /// The line of a row whose maker failed with `why`; nullopt: it gets none. May be empty.
  std::function<std::optional<std::string>(std::size_t row, const std::string& why)> rescue;
};

/// Outcome for a table.
struct RowsDone {
  std::size_t added = 0, failed = 0;
};

/// Returns `wanted`, or the number of cores if that is 0.
int JobsOr(int wanted);

/// Returns the rows of 0..rows-1 that the table does not have.
std::vector<std::size_t> MissingRows(const SweepTable& table, std::size_t rows);

/// Makes the rows of `todo`, with a progress line unless `quiet`; failures are named on stderr by
/// their key. Ends early on a signal (StopOnSignals).
RowsDone MakeRows(const std::vector<std::string>& keys, const std::vector<std::size_t>& todo,
                  const RowMaker& maker, int jobs, bool quiet, SweepTable* table);

/// Prints a summary in one line. Returns the exit status: 0 if no row is missing.
int PrintRows(const std::string& path, const SweepTable& table, std::size_t rows,
              const RowsDone& done);

}  // namespace seam
