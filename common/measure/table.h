#pragma once
/// Measures as text: lines of a CSV file, and a table for people.

#include <string>
#include <vector>

#include "common/measure/measure.h"

namespace seam {

/// One measured recording.
struct MeasuredRun {
  std::string run;  ///< what to call it
  Room room;        ///< of the recording
  Measures measures;
  std::string valid;               ///< empty, or why the figures are left out (WhyNotValid)
  std::int64_t gaps = 0;           ///< messages missing by their sequence numbers
  std::int64_t skipped_bytes = 0;  ///< damaged bytes of the log
};

/// The column names, without a line end:
/// scene,run,mode,reconcile,impair,seed,error_others_m,error_own_m,path_error_rms_m,view_age_ms,
/// response_own_ms,response_other_ms,seen,error_rms_m,error_p95_m,error_max_m,stutter_mps2,
/// backsteps,rebound,bytes_per_s,cpu_us_per_s,valid
/// In mode central, reconcile says what is predicted: own or all.
std::string CsvHeader();

/// A field as RFC 4180 wants it: text with commas, quotes or line ends gets quotes around it.
std::string CsvField(const std::string& text);

/// One line of values, without a line end; empty where a column does not apply. Six significant
/// digits.
std::string CsvLine(const MeasuredRun& run);

/// The same columns, aligned, a line per run and one of names. `more`: then the further measures,
/// a paragraph per run.
std::string FormatTable(const std::vector<MeasuredRun>& runs, bool more);

}  // namespace seam
