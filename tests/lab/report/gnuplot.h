#pragma once
/// Runs gnuplot, which draws the figures, on scripts in a folder.

#include <string>
#include <vector>

namespace seam {

/// Throws OperatorError when there is no gnuplot.
void RequireGnuplot();

/// Runs it in `folder` on `scripts`, `jobs` processes side by side. Throws OperatorError with the
/// first line it complained of.
void RunGnuplot(const std::string& folder, const std::vector<std::string>& scripts, int jobs);

}  // namespace seam
