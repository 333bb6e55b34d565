#pragma once
/// Reports a recording that fails while the program goes on: at once, and again at the end with
/// exit status 1.

#include <string>

#include "common/base/process.h"
#include "common/base/progress_line.h"
#include "common/base/status.h"

namespace seam {

/// Reports for one recording; pass its Sink's `trouble`.
class TroubleReport {
 public:
  /// `program` begins each line; `goes_on` describes the consequence, "the room runs on".
  TroubleReport(const char* program, const char* goes_on) : program_(program), goes_on_(goes_on) {}

  /// Prints the first trouble to stderr once, in a line of its own. Call it often.
  void Look(const Status& trouble, ProgressLine& line) {
    if (trouble.ok() || said_) return;
    said_ = true;
    line.End();
    PrintError(program_, trouble.why() + "; " + goes_on_);
  }

  /// Prints the trouble again at the end, if any, and returns the exit status, 0 or 1.
  int End(const Status& trouble) const {
    if (trouble.ok()) return 0;
    PrintError(program_, trouble.why() + "; the recording is not complete");
    return 1;
  }

 private:
  const char* program_;
  const char* goes_on_;
  bool said_ = false;
};

}  // namespace seam
