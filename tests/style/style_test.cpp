/// How files are written: columns, lengths, names, promises, units of messages.

#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace {

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

TEST(LcmTypes, TheHardeningRefusesWhatItDoesNotUnderstand) {
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
  EXPECT_FALSE(Hardens(decoder + "    tlen = __double_decode_array(buf, 0, 8, &this->d, 1);\n"));
}

}  // namespace
}  // namespace seam
