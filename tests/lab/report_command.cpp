#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <thread>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "tests/lab/commands.h"
#include "tests/lab/report/gnuplot.h"
#include "tests/lab/report/report.h"
#include "tests/lab/report/validity.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

void WriteText(const fs::path& path, const std::string& text) {
  RequirePlainFile(path.string());
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw OperatorError(path.string() + ": cannot be written: " + std::strerror(errno));
}

std::string ReadText(const fs::path& path) { return ReadPlainFile(path.string(), kTableBytesMax); }

/// A folder without the files that an earlier run left there.
fs::path FreshFolder(const fs::path& folder, const std::set<std::string>& extensions) {
  std::error_code error;
  fs::create_directories(folder, error);
  std::vector<fs::path> old;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
    if (extensions.count(i->path().extension().string()) > 0) old.push_back(i->path());
  }
  for (const fs::path& path : old) {
    if (!error) fs::remove(path, error);
  }
  if (error) throw OperatorError(folder.string() + ": " + error.message());
  return folder;
}

void WriteTables(const std::vector<const TextTable*>& tables, const fs::path& out) {
  const fs::path folder = FreshFolder(out / "tables", {".md"});
  std::string all = "# Tables of the report\n";
  for (const TextTable* table : tables) {
    const std::string text = Markdown(*table);
    WriteText(folder / (table->name + ".md"), text);
    all += fmt::format("\n## {}\n\n`{}`\n\n{}", table->title, table->name, text);
  }
  WriteText(out / "tables.md", all);
}

void DrawFigures(const std::vector<const Figure*>& figures, const fs::path& out,
                 PictureFormat format) {
  const fs::path folder = FreshFolder(out / "plots", {".gp", ".svg", ".png"});
  std::vector<std::string> scripts;
  for (const Figure* figure : figures) {
    scripts.push_back(figure->name + ".gp");
    WriteText(folder / scripts.back(), GnuplotScript(*figure, format));
  }
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  RunGnuplot(folder.string(), scripts, cores);
}

/// Pages of frames, beside their folders.
void WriteContactSheets(const Section& renders, const fs::path& out) {
  for (const PageItem& item : renders.items) {
    const auto* thumbnail = std::get_if<Thumbnail>(&item);
    if (thumbnail == nullptr || thumbnail->link == thumbnail->file) continue;
    const std::string& name = thumbnail->title;
    std::vector<std::string> files = FramesOf((out / "renders" / name).string());
    for (std::string& file : files) file = name + '/' + file;
    WriteText(out / thumbnail->link, HtmlContactSheet(name, thumbnail->command, files));
  }
}

}  // namespace

int RunReport(const ReportCommand& command) {
  const std::vector<Section> sections = BuildReport({command.data, command.sweeps, command.out});
  const std::vector<const TextTable*> tables = Tables(sections);
  const std::vector<const Figure*> figures = Figures(sections);
  const fs::path out = command.out;
  std::vector<std::string> missing;
  std::string filled;
  if (!command.markdown.empty()) {
    filled = FillIn(ReadText(command.markdown), command.markdown, tables, &missing);
  }
  RequireGnuplot();  // the last of what can be wrong before anything is written
  const PictureFormat format = command.png ? PictureFormat::kPng : PictureFormat::kSvg;
  WriteTables(tables, out);
  DrawFigures(figures, out, format);
  for (const Section& section : sections) {
    if (section.id == "renders") WriteContactSheets(section, out);
  }
  WriteText(out / "index.html",
            HtmlPage(sections, format, fs::path(command.data).lexically_relative(out).string()));
  if (!command.markdown.empty()) WriteText(command.markdown, filled);
  std::printf("%s: %zu figures, %zu tables\n", (out / "index.html").c_str(), figures.size(),
              tables.size());
  for (const std::string& name : missing) {
    std::printf("%s: %s: not among the tables, left as it was\n", command.markdown.c_str(),
                name.c_str());
  }
  const std::vector<std::string> not_valid = TablesNotValid(command.data);
  for (const std::string& line : not_valid) std::fprintf(stderr, "%s\n", line.c_str());
  return not_valid.empty() ? 0 : 1;
}

}  // namespace seam
