#pragma once
/// Style and script of the report's page: the files of tests/lab/report/html/, copied into the
/// program when it is built.

#include <string>

namespace seam {

std::string ReportStyle();
/// Curves to hover over, the first answer, chapters.
std::string ReportScript();

}  // namespace seam
