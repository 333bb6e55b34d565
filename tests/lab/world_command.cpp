#include <cstdio>
#include <filesystem>
#include <fstream>

#include "common/base/check.h"
#include "common/base/nearest.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "tests/lab/commands.h"
#include "tests/lab/experiment/values.h"
#include "tests/lab/relief/benches.h"
#include "tests/lab/world/bench.h"

namespace seam {
namespace {

void WriteText(const std::string& text, const std::string& path) {
  RequirePlainFile(path);
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw OperatorError(path + ": cannot be written");
}

/// A figure that was to be measured and was not; a bench writes "–" where one does not apply.
std::string WhyNotValid(const std::vector<std::string>& row) {
  for (const std::string& field : row) {
    if (field.find("failed") != std::string::npos || field == "nan") return "a figure is missing";
  }
  return "";
}

void WriteCsv(const TextTable& table, const std::string& path) {
  const auto line = [](std::vector<std::string> fields, const std::string& valid) {
    fields.push_back(valid);
    return CsvRow(fields) + "\n";
  };
  std::string text = line(table.header, "valid");
  for (const std::vector<std::string>& row : table.rows) text += line(row, WhyNotValid(row));
  WriteText(text, path);
}

int RunBenches(const BenchCommand& command, const std::vector<Bench>& benches) {
  for (const std::string& name : command.benches) {
    std::vector<std::string> known;
    for (const Bench& bench : benches) known.emplace_back(bench.name);
    if (std::count(known.begin(), known.end(), name) == 0) {
      throw OperatorError("there is no bench '" + name + "'; " + Suggestion(name, known));
    }
  }
  if (!command.folder.empty()) std::filesystem::create_directories(command.folder);
  StopOnSignals();
  for (const Bench& bench : benches) {
    bool wanted = command.benches.empty();
    for (const std::string& name : command.benches) wanted = wanted || name == bench.name;
    if (!wanted || g_stop != 0) continue;
    const TextTable table = bench.run(command.quick);
    std::printf("%s\n\n%s\n", table.title.c_str(), Markdown(table).c_str());
    std::fflush(stdout);
    if (command.folder.empty()) continue;
    WriteCsv(table, command.folder + "/" + bench.name + ".csv");
    WriteText(Markdown(table), command.folder + "/" + bench.name + ".md");
    // What a CSV has no place for, for the report.
    WriteText(table.title + "\n" + table.note + "\n", command.folder + "/" + bench.name + ".txt");
  }
  return g_stop == 0 ? 0 : 1;
}

}  // namespace

int RunWorld(const BenchCommand& command) { return RunBenches(command, WorldBenches()); }

int RunRelief(const BenchCommand& command) { return RunBenches(command, ReliefBenches()); }

}  // namespace seam
