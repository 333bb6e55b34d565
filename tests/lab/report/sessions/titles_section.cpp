#include "tests/lab/report/sessions/titles_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace seam {
namespace {

struct Tally {
  int kept = 0, of = 0;
};

/// Adds what is not there yet, so that the order stays the table's.
void AddOnce(std::vector<std::string>* list, const std::string& text) {
  if (std::find(list->begin(), list->end(), text) == list->end()) list->push_back(text);
}

}  // namespace

TextTable TitlesTable(const CsvTable& csv, const std::string& command) {
  std::vector<std::string> scenes, networks;
  std::map<std::pair<std::string, std::string>, Tally> tallies;
  std::map<std::string, std::string> sentences, missed;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const std::string& scene = csv.Text(row, "scene");
    const std::string& network = csv.Text(row, "network");
    const std::string& lack = csv.Text(row, "missed");
    AddOnce(&scenes, scene);
    AddOnce(&networks, network);
    Tally& tally = tallies[{scene, network}];
    ++tally.of;
    if (lack.empty()) ++tally.kept;
    sentences[scene] = csv.Text(row, "sentence");
    if (!lack.empty() && missed[scene].empty()) {
      missed[scene] = fmt::format("{}, seed {}: {}", network, csv.Text(row, "seed"), lack);
    }
  }
  TextTable table;
  table.name = "titles";
  table.title = "Does what its title says";
  table.header = {"scene", "what must be seen on every screen"};
  for (const std::string& network : networks) table.header.push_back(network);
  table.header.push_back("the first miss");
  for (const std::string& scene : scenes) {
    std::vector<std::string> row = {scene, sentences[scene]};
    for (const std::string& network : networks) {
      const Tally& tally = tallies[{scene, network}];
      row.push_back(fmt::format("{} of {}", tally.kept, tally.of));
    }
    row.push_back(missed[scene].empty() ? "–" : missed[scene]);
    table.rows.push_back(std::move(row));
  }
  table.note = "Sessions of the default method in which the server's and every client's view did.";
  table.command = command;
  table.open = true;
  return table;
}

Section TitlesSection(const CsvTable& csv, const std::string& command) {
  Section section;
  section.id = "titles";
  section.title = "What the scenes promise";
  section.intro = "One sentence and one numeric test for each large scene.";
  section.items.emplace_back(TitlesTable(csv, command));
  return section;
}

}  // namespace seam
