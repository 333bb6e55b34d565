#pragma once
/// One table of the tables of many processes, and rows of a table run again.

#include <set>
#include <string>

#include "tests/lab/commands.h"
#include "tests/lab/experiment/experiment.h"

namespace seam {

/// RunMerge for any experiment. `times`: columns that differ from run to run.
int MergeTables(const Experiment& experiment, const std::set<std::string>& times,
                const MergeCommand& command);

/// RunVerify for any experiment.
int VerifyTable(const Experiment& experiment, const std::set<std::string>& times,
                const VerifyCommand& command);

}  // namespace seam
