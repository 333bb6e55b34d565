#pragma once
/// The first page of the report, for a reader in a hurry: which method for which latency and scene,
/// at what cost, and the floors.

#include <vector>

#include "tests/lab/report/bars.h"
#include "tests/lab/report/page.h"
#include "tests/lab/report/sweep_section.h"

namespace seam {

/// `cases` of the sweeps must-*, changes and floors-*; `before` may be null. Tables without rows
/// are left out.
Section HurrySection(const std::vector<Sweep>& sweeps, const std::vector<ReportCase>& cases,
                     const Before* before);
/// The measures of the first page, the headline first.
std::vector<SweepMeasure> FirstMeasures();
/// Every method in each case: all measures.
Section CasesSection(const std::vector<ReportCase>& cases);

/// Every case's error_others_m, a column for each method; ✓ marks what is within a tenth of the
/// least.
TextTable GlanceTable(const std::vector<ReportCase>& cases);
/// The same for six cases and the methods that one would choose from, for a page with little room.
TextTable ShortTable(const std::vector<ReportCase>& cases);
/// Every method's figures, in the middle of the cases that all methods ran.
TextTable MethodsTable(const std::vector<ReportCase>& cases);
/// A row for each scene and latency: the most exact method, the cheapest that is nearly as exact,
/// the default, `central`.
TextTable WhichTable(const std::vector<Sweep>& sweeps);

}  // namespace seam
