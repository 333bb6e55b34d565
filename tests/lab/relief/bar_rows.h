#pragma once
/// What distribution must show, as figures beside their bars: each with its precondition, without
/// which it says nothing.

#include <string>
#include <vector>

#include "tests/lab/report/text_table.h"

namespace seam {

struct BarRow {
  std::string figure;    ///< what was measured, and of what
  std::string measured;  ///< for people
  std::string must;      ///< the bar for people; "": printed, no bar
  std::string given;     ///< what had to be so, and was or was not; "": nothing
  bool valid = true;     ///< it was so
  bool met = true;       ///< the bar was held; nothing where there is none
};

/// A value of that unit ("": a ratio), at most `most`; `detail` stands behind it in brackets.
BarRow AtMost(const std::string& figure, double value, double most, const std::string& unit,
              const std::string& detail = "");
/// Printed without a bar.
BarRow Printed(const std::string& figure, const std::string& measured);

/// A line each, with the verdicts met, missed, not valid.
TextTable TableOf(const std::string& name, const std::string& title,
                  const std::vector<BarRow>& rows, const std::string& note);

}  // namespace seam
