#pragma once
/// Options of seam-export: flags, checked.

#include <string>
#include <vector>

#include "common/record/time_range.h"

namespace seam {

class Command;

enum class ExportFormat { kCsv, kJson, kMcap, kTrace };

struct ExportOptions {
  std::string log;
  bool csv = false, json = false, mcap = false, trace = false;  ///< at most one
  std::string out;                                              ///< "" or "-": stdout
  std::string events, metrics;  ///< files for these tables; "": none
  bool force = false;                                           ///< replace a file at `out`
  std::string oracle;               ///< a log made in mode oracle; "": computed
  std::string room;                 ///< "": the first of the log
  std::string session;              ///< by number or id; "": the last
  TimeRange range;                  ///< exported part of the session
  std::vector<std::string> bodies;  ///< names; empty: all
  std::vector<std::string> views;   ///< names of players, or server; empty: all

  /// Requires CheckExportOptions.
  ExportFormat format() const;
  /// True if there is a format besides the tables.
  bool HasFormat() const { return csv || json || mcap || trace; }
};

void DefineExportOptions(Command* app, ExportOptions* options);
/// Throws OperatorError for contradictory options.
void CheckExportOptions(const ExportOptions& options);

}  // namespace seam
