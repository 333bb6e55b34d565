#pragma once
/// A recording that fails while a program goes on: said at once, again at the end, exit status 1.

#include <string>

#include "common/base/process.h"
#include "common/base/progress_line.h"
#include "common/base/status.h"

namespace seam {

/// For one recording; `trouble` is its Sink's.
class TroubleReport {
 public:
  /// `program`: begins each line. `goes_on`: what happens in spite of it, "the room runs on".
  TroubleReport(const char* program, const char* goes_on) : program_(program), goes_on_(goes_on) {}

  /// Says the first trouble on stderr, in a line of its own, when it is first seen. Call often.
  void Look(const Status& trouble, ProgressLine& line) {
    if (trouble.ok() || said_) return;
    said_ = true;
    line.End();
    PrintError(program_, trouble.why() + "; " + goes_on_);
  }

  /// At the end: says it again, if there is one, and returns the program's exit status, 0 or 1.
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
