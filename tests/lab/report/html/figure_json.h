#pragma once
/// A figure's data for the page's script, which draws it with values to hover over.

#include <string>

#include "tests/lab/report/figure.h"

namespace seam {

/// The panels as a JSON object; infinite and undefined numbers are null. Safe within a script
/// element of HTML.
std::string FigureJson(const Figure& figure);

}  // namespace seam
