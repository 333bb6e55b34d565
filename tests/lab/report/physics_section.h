#pragma once
/// What the report shows of the hard cases: a work-precision plot of each, the ratios of all in
/// one, and tables that leave no case out.

#include <string>
#include <vector>

#include "tests/lab/report/page.h"
#include "tests/lab/report/physics_view.h"

namespace seam {

/// The summary first, then the plots. `command` made the table.
Section PhysicsSection(const CsvTable& table, const std::string& command);

/// Cost ratio against error, every setting tried, those that failed marked.
Figure WorkPrecision(const PhysicsCase& c, const std::string& command);
/// Error ratio against cost ratio of each scene's own setting, named.
Figure PhysicsSummary(const std::vector<PhysicsCase>& cases, const std::string& command);
/// Error and cost ratio of every case, by name.
Figure PhysicsList(const std::vector<PhysicsCase>& cases, const std::string& command);
/// Stock against scene: error, ratio, cost, verdict; then what the search found.
TextTable PhysicsTable(const std::vector<PhysicsCase>& cases, const std::string& command);
TextTable PhysicsSearchTable(const std::vector<PhysicsCase>& cases, const std::string& command);
/// Penetration, joint drift, energy, jitter and rest: stock → scene.
TextTable PhysicsSideTable(const CsvTable& table, const std::vector<PhysicsCase>& cases,
                           const std::string& command);

}  // namespace seam
