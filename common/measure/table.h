#pragma once
/// Measures as text: lines of a CSV file, and a table for people.

#include <string>
#include <vector>

#include "common/measure/measure.h"

namespace seam {

/// One measured recording.
struct MeasuredRun {
  std::string run;  ///< its name in the table
  Room room;        ///< the recording's
  Measures measures;
  std::string lacks;               ///< LackOf the recording: its figures are of the rest
  std::string valid;               ///< empty, or the reason for omitting the figures (WhyNotValid)
  std::int64_t gaps = 0;           ///< messages missing by their sequence numbers
  std::int64_t skipped_bytes = 0;  ///< damaged bytes of the log
};

/// Returns the column names, without a line end:
/// scene,run,mode,reconcile,impair,seed,error_others_m,error_own_m,path_error_rms_m,view_age_ms,
/// response_own_ms,response_other_ms,seen,error_rms_m,error_p95_m,error_max_m,stutter_mps2,
/// backsteps,rebound,bytes_per_s,cpu_us_per_s,inputs_late,error_served_m,overlap_p99_m,
/// stutter_shown_mps2,valid
/// In mode central, the column reconcile holds the clients' prediction: own or all.
std::string CsvHeader();

/// Returns a field by RFC 4180: text with commas, quotes or line ends is put in quotes.
std::string CsvField(const std::string& text);

/// Returns one line of values, without a line end; empty where a column does not apply. Numbers
/// have six significant digits.
std::string CsvLine(const MeasuredRun& run);

/// Formats the same columns as an aligned table, with a line of names and a line per run. `more`:
/// appends the further measures, a paragraph per run.
std::string FormatTable(const std::vector<MeasuredRun>& runs, bool more);

/// Formats the further measures of a run, a paragraph.
std::string FormatMore(const MeasuredRun& run);

}  // namespace seam
