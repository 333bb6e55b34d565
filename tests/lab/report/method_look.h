#pragma once
/// The colour, dash and marker of each method, the same in every figure of the report, and the
/// order in which they are listed.

#include <string>
#include <vector>

#include "tests/lab/report/figure.h"

namespace seam {

/// "strict", "fade", or with what else was varied: "fade, smooth off". Methods that are not in the
/// table get one of three spare looks by their name.
Look MethodLook(const std::string& method);

/// Those of the table, in its order.
std::vector<std::string> KnownMethods();

/// Less for those listed first; unknown ones last.
int MethodOrder(const std::string& method);

}  // namespace seam
