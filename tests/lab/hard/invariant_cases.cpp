#include "tests/lab/hard/hard_case.h"

namespace seam {

std::vector<HardCase> InvariantCases() { return {}; }

}  // namespace seam
