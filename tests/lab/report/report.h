#pragma once
/// From a folder of CSV tables, whatever is in it, to the sections of the report.

#include <string>
#include <vector>

#include "tests/lab/report/page.h"

namespace seam {

struct ReportInput {
  std::string data;    ///< folder of *.csv: sweeps, physics.csv, overhead.csv
  std::string sweeps;  ///< folder of the sweeps' files, for the commands shown
  std::string out;     ///< where renders/ may be, with pictures to show
};

/// Reads all tables. A file that is not there leaves its section out; one that is damaged or of
/// another kind is an error. Throws OperatorError.
std::vector<Section> BuildReport(const ReportInput& input);

/// The tables of all sections, in order.
std::vector<const TextTable*> Tables(const std::vector<Section>& sections);
std::vector<const Figure*> Figures(const std::vector<Section>& sections);

/// renders/NAME.png and the frames in renders/NAME/, each with its command in NAME.txt.
/// Frames open a contact sheet, renders/NAME.html.
Section RendersSection(const std::string& out);
/// A table for each FOLDER/NAME.csv, as `seam-lab world -o FOLDER` leaves them; no items where
/// there is no such folder.
Section WorldSection(const std::string& folder);
/// The same of `seam-lab relief`.
Section ReliefSection(const std::string& folder);
/// frame_00000.png, ... as far as they go without a hole.
std::vector<std::string> FramesOf(const std::string& folder);

}  // namespace seam
