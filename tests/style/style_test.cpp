/// Checks how files are written: columns, lengths, names, promises, units of messages.

#include <glob.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace style_test {

namespace fs = std::filesystem;

/// Expects that `bad` is true of no line of our C++ and LCM types.
void ExpectNoLine(const std::function<bool(const std::string&)>& bad) {
  std::string offenders;
  std::vector<Source> sources = Code();
  for (Source& source : Sources({"lcmtypes"}, {".lcm", ".awk"})) sources.push_back(source);
  for (const Source& source : sources) {
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
      if (bad(source.lines[i])) offenders += source.path + ":" + std::to_string(i + 1) + "\n";
    }
  }
  EXPECT_TRUE(offenders.empty()) << offenders;
}

TEST(Style, NoLineIsLongerThanAHundredColumns) {
  ExpectNoLine([](const std::string& line) { return Columns(line) > 100; });
}

TEST(Style, NoTabsAndNoSpacesAtTheEnd) {
  ExpectNoLine([](const std::string& line) {
    return line.find('\t') != std::string::npos || (!line.empty() && line.back() == ' ');
  });
}

TEST(Style, NoFileIsLongerThan350Lines) {
  std::string offenders;
  for (const Source& source : Code()) {
    if (source.lines.size() > 350) {
      offenders += source.path + ": " + std::to_string(source.lines.size()) + " lines\n";
    }
  }
  EXPECT_TRUE(offenders.empty()) << offenders;
}

/// Returns the names of the constants that a source defines: kName in a declaration that begins its
/// line with constexpr or const, before its value.
std::set<std::string> ConstantsIn(const Source& source) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < source.lines.size(); ++i) {
    std::string text = source.lines[i].substr(0, source.lines[i].find("//"));
    text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
    for (const char* word : {"static ", "inline "}) {
      if (text.rfind(word, 0) == 0) text.erase(0, std::string(word).size());
    }
    if (text.rfind("constexpr ", 0) != 0 && text.rfind("const ", 0) != 0) continue;
    for (std::size_t j = i + 1; text.find(';') == std::string::npos && j < source.lines.size();
         ++j) {
      text += ' ' + source.lines[j].substr(0, source.lines[j].find("//"));
    }
    int depth = 0;
    for (std::size_t at = 0; at < text.size() && text[at] != ';'; ++at) {
      if (text[at] == '(' || text[at] == '{') ++depth;
      if (text[at] == ')' || text[at] == '}') --depth;
      const bool begins = at > 0 && (text[at - 1] == ' ' || text[at - 1] == '*');
      const bool constant = text[at] == 'k' && std::isupper(text[at + 1]) != 0;
      if (depth > 0 || !begins || !constant) continue;
      std::size_t end = at;
      while (end < text.size() && (std::isalnum(text[end]) != 0 || text[end] == '_')) ++end;
      std::size_t next = end;
      if (next < text.size() && text[next] == '[') next = text.find(']', next) + 1;
      next = text.find_first_not_of(' ', next);
      const bool value = next != std::string::npos && (text[next] == '=' || text[next] == '{') &&
                         text.compare(next, 2, "==") != 0;
      if (value) names.insert(text.substr(at, end - at));
      at = end - 1;
    }
  }
  return names;
}

TEST(Style, EachConstantHasOneHome) {
  Source source;
  source.lines = {"constexpr int kOne = 1, kTwo = kOne == 1 ? 2 : 3;  // kNot = 1",
                  "  static const char* const kNames[] = {kThree, \"a\"};",
                  "constexpr Largest kFour{1, 2};",
                  "const bool same = kFive == 5;",
                  "constexpr double kSix =",
                  "    1, kSeven = 2;"};
  EXPECT_EQ(ConstantsIn(source),
            (std::set<std::string>{"kFour", "kNames", "kOne", "kSeven", "kSix", "kTwo"}));
  std::map<std::string, std::string> homes;
  std::string offenders;
  for (const Source& product : Sources(kProduct, {".h", ".cpp"})) {
    for (const std::string& name : ConstantsIn(product)) {
      const auto [home, first] = homes.emplace(name, product.path);
      if (!first) offenders += name + ": " + home->second + ", " + product.path + "\n";
    }
  }
  EXPECT_GT(homes.size(), 900u);
  EXPECT_EQ(offenders, "") << "share one of the same meaning, rename one of another";
}

TEST(Style, HeadersBeginWithAPromise) {
  std::string offenders;
  for (const Source& source : Sources(kCode, {".h"})) {
    const bool good = source.lines.size() > 1 && source.lines[0] == "#pragma once" &&
                      source.lines[1].rfind("/// ", 0) == 0;
    if (!good) offenders += source.path + "\n";
  }
  EXPECT_TRUE(offenders.empty()) << offenders;
}

TEST(Style, NamesOfFilesAreSnakeCase) {
  const Regex snake_case("[a-z0-9_/]+\\.(h|cpp)");
  std::string offenders;
  for (const Source& source : Code()) {
    if (!snake_case.Matches(source.path)) offenders += source.path + "\n";
  }
  EXPECT_TRUE(offenders.empty()) << offenders;
}

/// libm's have other bits on another processor (common/base/trig.h).
TEST(Style, SimulationsTakeTheirSinesFromTrig) {
  const Regex libm(".*std::(sin|cos)\\(.*");
  std::string offenders;
  int read = 0;
  for (const Source& source : Sources({"common/base", "common/physics", "common/scene",
                                       "common/stages", "common/sync", "common/topology"},
                                      {".h", ".cpp"})) {
    if (source.path == "common/base/trig.h") continue;
    for (const std::string& line : source.lines) {
      if (libm.Matches(line)) offenders += source.path + ": " + line + "\n";
    }
    ++read;
  }
  EXPECT_GT(read, 300);
  EXPECT_EQ(offenders, "");
}

/// Lines of a page that are too wide, without tables, code and generated text.
std::string WideLines(const Source& page, std::size_t columns) {
  std::string wide;
  bool code = false, written = false;
  for (std::size_t i = 0; i < page.lines.size(); ++i) {
    const std::string& line = page.lines[i];
    if (line.rfind("```", 0) == 0) code = !code;
    if (line.rfind("<!-- report:", 0) == 0) written = true;
    if (line.rfind("<!-- /report:", 0) == 0) written = false;
    if (code || written || line.rfind('|', 0) == 0 || line.rfind("    ", 0) == 0) continue;
    if (Columns(line) > columns) wide += page.path + ":" + std::to_string(i + 1) + "\n";
  }
  return wide;
}

/// README.md, CHANGELOG.md and docs/*.md.
std::vector<Source> Pages() {
  std::vector<Source> pages = Sources({"docs"}, {".md"});
  for (const char* name : {"README.md", "CHANGELOG.md"}) {
    Source page;
    page.path = name;
    page.lines = Lines(Root() / name);
    pages.push_back(std::move(page));
  }
  return pages;
}

TEST(Docs, EveryPageBeginsWithItsTitle) {
  std::string offenders;
  for (const Source& page : Pages()) {
    // A formatter for C++ that is let loose on a page turns "# Title" into "#Title".
    const bool titled = !page.lines.empty() && page.lines[0].rfind("# ", 0) == 0;
    if (!titled) offenders += page.path + "\n";
  }
  EXPECT_EQ(offenders, "");
}

TEST(Docs, NoLineIsLongerThan120ColumnsButInTablesAndCode) {
  std::string wide;
  for (const Source& page : Pages()) wide += WideLines(page, 120);
  EXPECT_EQ(wide, "");
  Source page;
  page.path = "a.md";
  page.lines = {"12345", "1234 6", "| 4 6 |", "    4 6", "```", "1234 6", "```", "µµµµµ"};
  EXPECT_EQ(WideLines(page, 5), "a.md:2\n");
}

/// Words in backticks that name a file or folder, and files of ours that are linked to.
std::vector<std::string> PathsIn(const std::string& line) {
  std::vector<std::string> paths;
  const auto add = [&](const std::string& text) {
    if (text.find_first_of(" =$<>(\\\"'") != std::string::npos) return;
    if (text.rfind("build/", 0) == 0 || text.rfind("out/", 0) == 0) return;  // are made
    if (text.find("://") != std::string::npos || text[0] == '#' || text[0] == '-') return;
    const Regex file(".*/.*|.*\\.(cpp|h|md|toml|lcm|sh)");
    if (file.Matches(text)) paths.push_back(text);
  };
  for (std::size_t at = line.find('`'); at != std::string::npos;) {
    const std::size_t end = line.find('`', at + 1);
    if (end == std::string::npos) break;
    add(line.substr(at + 1, end - at - 1));
    at = line.find('`', end + 1);
  }
  for (std::size_t at = line.find("]("); at != std::string::npos; at = line.find("](", at + 1)) {
    const std::size_t end = line.find(')', at);
    if (end != std::string::npos) add(line.substr(at + 2, end - at - 2));
  }
  return paths;
}

/// True if a path from `folder` or from the root exists; "*", and NAME, stand for any letters.
bool Exists(const std::string& path, const fs::path& folder) {
  std::string pattern = path.substr(0, path.find('#'));
  for (std::size_t at; (at = pattern.find("NAME")) != std::string::npos;) {
    pattern.replace(at, 4, "*");
  }
  for (const fs::path& from : {Root(), folder}) {
    glob_t found{};
    const int status = glob((from / pattern).c_str(), 0, nullptr, &found);
    globfree(&found);
    if (status == 0) return true;
  }
  return false;
}

/// "PAGE: PATH" for each path of a page (of its tables) that is not there, and how many there are.
std::pair<std::string, int> MissingPaths(const Source& page, bool tables_only) {
  std::pair<std::string, int> missing{"", 0};
  for (const std::string& line : page.lines) {
    if (tables_only && line.rfind('|', 0) != 0) continue;
    for (const std::string& path : PathsIn(line)) {
      ++missing.second;
      const bool there = Exists(path, (Root() / page.path).parent_path());
      if (!there) missing.first += page.path + ": " + path + "\n";
    }
  }
  return missing;
}

TEST(Docs, EveryPathInTheReadmesTablesContributingAndArchitectureExists) {
  for (const Source& page : Pages()) {
    const bool readme = page.path == "README.md";
    const bool all = page.path == "docs/contributing.md" || page.path == "docs/architecture.md";
    if (!readme && !all) continue;
    const auto [missing, count] = MissingPaths(page, readme);
    EXPECT_EQ(missing, "");
    EXPECT_GT(count, readme ? 10 : 20) << page.path;
  }
  Source page;
  page.path = "docs/a.md";
  page.lines = {"| `common/*/reconcile.cpp` `server/no.cpp` [a](lab.md) [b](no.md) |",
                "`make check`, `build/x/y`, `-o a/b`, `--out`, `Makefile`", "`no/NAME.h`"};
  EXPECT_EQ(MissingPaths(page, true).first,
            "docs/a.md: common/*/reconcile.cpp\ndocs/a.md: server/no.cpp\ndocs/a.md: no.md\n");
  EXPECT_EQ(MissingPaths(page, false).second, 5);
}

TEST(Docs, EachRowOfTheTableOfPlacesNamesAtMostTwoFiles) {
  std::string offenders;
  bool below = false;
  int rows = 0;
  for (const std::string& line : Lines(Root() / "docs/architecture.md")) {
    if (line.rfind("## ", 0) == 0) below = line.rfind("## Where is", 0) == 0;
    if (!below || line.rfind('|', 0) != 0) continue;
    ++rows;
    if (PathsIn(line).size() > 2) offenders += line + "\n";
  }
  EXPECT_EQ(offenders, "");
  EXPECT_GT(rows, 20);
}

TEST(LcmTypes, EveryFieldHasACommentWithItsUnit) {
  const Regex field(R"( +[a-z][a-z0-9_]* +[a-z][a-z0-9_]*(\[[a-z]+\])?;.*)");
  const Regex commented(R"([^;]*; *// .{8,})");
  std::string offenders;
  std::size_t fields = 0;
  for (const Source& source : Sources({"lcmtypes"}, {".lcm"})) {
    for (const std::string& line : source.lines) {
      if (!field.Matches(line)) continue;
      ++fields;
      if (!commented.Matches(line)) offenders += source.path + ": " + line + "\n";
    }
    EXPECT_GT(source.lines.size(), 5u) << source.path;
    EXPECT_EQ(source.lines[0], "package seam;") << source.path;
  }
  EXPECT_GT(fields, 100u);
  EXPECT_TRUE(offenders.empty()) << offenders;
}

/// Runs harden.awk on `header` with every awk that is installed: true when all accept it.
bool Hardens(const std::string& header) {
  const fs::path path = fs::path(::testing::TempDir()) / ("harden-" + std::to_string(getpid()));
  std::ofstream(path) << header;
  std::size_t accepted = 0, refused = 0;
  for (const char* awk : {"awk", "mawk", "gawk", "original-awk"}) {
    ChildProcess run({awk, "-f", (Root() / "lcmtypes/harden.awk").string(), path.string()});
    EXPECT_TRUE(run.Wait(20));
    if (run.exit_status() == 127) continue;  // not installed
    if (run.exit_status() == 0) ++accepted;
    if (run.exit_status() != 1) continue;
    ++refused;
    EXPECT_NE(run.output().find("harden.awk: "), std::string::npos) << run.output();
  }
  fs::remove(path);
  EXPECT_GE(accepted + refused, 1u);
  EXPECT_TRUE(accepted == 0 || refused == 0) << "the awks disagree";
  return accepted > 0;
}

TEST(LcmTypes, TheHardeningRefusesUnknownCode) {
  const std::string decoder = "int a_t::_decodeNoHash(const void *buf, int offset, int maxlen)\n";
  const std::string check = "    if(__s_len__ > maxlen - pos) return -1;\n";
  const std::string assign =
      "    this->s.assign(((const char*)buf) + offset + pos, __s_len__ - 1);\n";
  EXPECT_TRUE(Hardens(decoder));
  EXPECT_TRUE(Hardens(decoder + "        this->x.resize(this->count);\n"));
  EXPECT_TRUE(Hardens(decoder + check + assign));
  EXPECT_FALSE(Hardens("")) << "no decoder";
  EXPECT_FALSE(Hardens(decoder + "        this->x.resize(count);\n"));
  EXPECT_FALSE(Hardens(decoder + "        this->x[a0].resize(this->count);\n"));
  EXPECT_FALSE(Hardens(decoder + "        this->x.reserve(this->count);\n"));
  EXPECT_FALSE(Hardens(decoder + assign)) << "a string without the stock check";
  EXPECT_FALSE(Hardens(decoder + check + assign + assign)) << "one check, two strings";
  const std::string reals = "    tlen = __double_decode_array(buf, offset + pos, maxlen - pos, ";
  EXPECT_TRUE(Hardens(decoder + reals + "&this->d, 1);\n"));
  EXPECT_TRUE(Hardens(decoder + reals + "&this->d[0], this->count);\n"));
  EXPECT_FALSE(Hardens(decoder + reals + "&this->d, 2);\n"));
  EXPECT_FALSE(Hardens(decoder + "    tlen = __double_decode_array(buf, 0, 8, &this->d, 1);\n"));
}

}  // namespace style_test
}  // namespace seam
