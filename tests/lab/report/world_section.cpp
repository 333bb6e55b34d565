#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/report/files.h"
#include "tests/lab/report/report.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

/// NAME.csv, and title and note from NAME.txt.
TextTable LoadBench(const fs::path& csv_path, const std::string& command) {
  const CsvTable csv = CsvTable::Load(csv_path.string());
  TextTable table;
  table.name = command + "-" + csv_path.stem().string();
  table.title = csv_path.stem().string();
  table.header = csv.header();
  const auto valid = std::find(table.header.begin(), table.header.end(), "valid");
  if (valid != table.header.end()) table.header.erase(valid);
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    std::vector<std::string> fields;
    for (const std::string& column : table.header) fields.push_back(csv.Text(row, column));
    const std::string& reason = csv.Text(row, "valid");
    if (!reason.empty() && fields.size() > 1) {
      std::fill(fields.begin() + 1, fields.end(), "–");
      fields[1] = "not valid: " + reason;
    }
    table.rows.push_back(std::move(fields));
  }
  std::ifstream words(fs::path(csv_path).replace_extension(".txt"));
  std::string line;
  if (std::getline(words, line) && !line.empty()) table.title = line;
  while (std::getline(words, line)) table.note += (table.note.empty() ? "" : " ") + line;
  table.command = "seam-lab " + command + " " + csv_path.stem().string();
  table.open = true;
  return table;
}

void AddBenches(const std::string& folder, const std::string& command, Section* section) {
  std::error_code error;  // a folder that is not there has none
  for (const fs::path& file : FilesIn(folder, ".csv", &error)) {
    section->items.emplace_back(LoadBench(file, command));
  }
}

}  // namespace

Section WorldSection(const std::string& folder) {
  Section section;
  section.id = "world";
  section.title = "What a scene may contain, beside its baseline";
  section.intro =
      "Each table is one run: the feature and what it is compared with take turns, and ratios are "
      "medians over pairs of turns. Errors are against mathematics.";
  AddBenches(folder, "world", &section);
  return section;
}

Section ReliefSection(const std::string& folder) {
  Section section;
  section.id = "relief";
  section.title = "What distribution takes off the server";
  section.intro =
      "Each figure beside what it must be, and what had to be so that it says anything. Times are "
      "of the machine of the run; ratios are of sessions in turn.";
  AddBenches(folder, "relief", &section);
  return section;
}

}  // namespace seam
