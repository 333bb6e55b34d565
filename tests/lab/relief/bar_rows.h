#pragma once
/// Figures of distribution beside their bars (limits), each with a precondition: a figure is valid
/// only if that holds.

#include <string>
#include <vector>

#include "tests/lab/report/text_table.h"

namespace seam {

struct BarRow {
  std::string figure;    ///< the quantity and its subject
  std::string measured;  ///< for people
  std::string must;      ///< the bar for people; "": printed, no bar
  std::string given;     ///< the precondition and its value; "": none
  bool valid = true;     ///< the precondition held
  bool met = true;       ///< the bar was held; meaningless without a bar
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
