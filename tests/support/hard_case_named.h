#pragma once
/// Finds a hard case by its name, for tests.

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "tests/lab/hard/hard_case.h"

namespace seam {

inline const HardCase& CaseNamed(std::string_view name) {
  const std::vector<HardCase>& all = HardCases();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const HardCase& hard) { return hard.name == name; });
  EXPECT_NE(found, all.end()) << name;
  return *found;
}

}  // namespace seam
