/// Enforces the table of DESIGN: who may include whom, which file opens the door to which library,
/// and the sizes that keep files readable. Reads the sources of the repository.

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <regex.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/child_process.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

/// A POSIX extended regular expression. (std::regex does not compile without warnings everywhere.)
class Regex {
 public:
  explicit Regex(const std::string& text) {
    EXPECT_EQ(regcomp(&compiled_, ("^(" + text + ")$").c_str(), REG_EXTENDED), 0) << text;
  }
  ~Regex() { regfree(&compiled_); }
  Regex(const Regex&) = delete;
  Regex& operator=(const Regex&) = delete;

  bool Matches(const std::string& text) const { return Find(text, 0).first; }
  /// The first group of `text`; "" when it does not match.
  std::string Group(const std::string& text) const { return Find(text, 1).second; }

 private:
  std::pair<bool, std::string> Find(const std::string& text, std::size_t group) const {
    regmatch_t match[3];
    if (regexec(&compiled_, text.c_str(), 3, match, 0) != 0) return {false, ""};
    const regmatch_t& m = match[group + 1];  // [1] is the whole: the parentheses of the constructor
    if (m.rm_so < 0) return {true, ""};
    return {true, text.substr(static_cast<std::size_t>(m.rm_so),
                              static_cast<std::size_t>(m.rm_eo - m.rm_so))};
  }
  regex_t compiled_;
};

/// The repository: the nearest folder upwards that has the Makefile and lcmtypes/.
fs::path Root() {
  for (fs::path p = fs::current_path(); p != p.root_path(); p = p.parent_path()) {
    if (fs::exists(p / "Makefile") && fs::exists(p / "lcmtypes")) return p;
  }
  return {};
}

struct Source {
  std::string path;  ///< from the root, with slashes
  std::vector<std::string> lines;
  std::vector<std::string> includes;  ///< what stands between the quotes or brackets
};

std::vector<std::string> Lines(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

/// All our files with one of `extensions` below `folders`, in order.
std::vector<Source> Sources(const std::vector<std::string>& folders,
                            const std::vector<std::string>& extensions) {
  const Regex include(R"( *# *include *["<]([^">]+)[">].*)");
  std::vector<Source> sources;
  for (const std::string& folder : folders) {
    if (!fs::exists(Root() / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(Root() / folder)) {
      const std::string extension = entry.path().extension().string();
      if (std::count(extensions.begin(), extensions.end(), extension) == 0) continue;
      Source source;
      source.path = fs::relative(entry.path(), Root()).generic_string();
      source.lines = Lines(entry.path());
      for (const std::string& line : source.lines) {
        const std::string name = include.Group(line);
        if (!name.empty()) source.includes.push_back(name);
      }
      sources.push_back(std::move(source));
    }
  }
  std::sort(sources.begin(), sources.end(),
            [](const Source& a, const Source& b) { return a.path < b.path; });
  return sources;
}

const std::vector<std::string> kCode = {"common", "server", "client", "render", "tests"};
const std::vector<std::string> kProduct = {"common", "server", "client", "render"};

std::vector<Source> Code() { return Sources(kCode, {".h", ".cpp"}); }

/// Expects that below `folders` only files matching `allowed` include what matches `included`.
void ExpectOnlyIn(const char* allowed, const std::vector<std::string>& folders,
                  const char* included) {
  const Regex door(included), may(allowed);
  std::string offenders;
  for (const Source& source : Sources(folders, {".h", ".cpp"})) {
    if (may.Matches(source.path)) continue;
    for (const std::string& name : source.includes) {
      if (door.Matches(name)) offenders += source.path + " includes " + name + "\n";
    }
  }
  EXPECT_TRUE(offenders.empty()) << offenders;
}

TEST(Layering, TheSourcesAreWhereThisTestLooks) {
  ASSERT_FALSE(Root().empty()) << "run the tests inside the repository";
  EXPECT_GT(Code().size(), 50u);
  EXPECT_GT(Sources({"lcmtypes"}, {".lcm"}).size(), 10u);
  // And it can fail: these doors are open.
  EXPECT_NONFATAL_FAILURE(ExpectOnlyIn("none", kCode, "lcm/.*"), "common/record/bus.cpp");
  EXPECT_NONFATAL_FAILURE(ExpectOnlyIn("none", kCode, "seam/.*"), "common/codec/codec.cpp");
  EXPECT_NONFATAL_FAILURE(ExpectOnlyIn("none", kCode, "sys/socket\\.h"), "common/net/udp.cpp");
}

TEST(Layering, EachModuleIncludesOnlyWhatIsBelowIt) {
  // A module, and the modules of ours that it may include besides itself.
  const std::vector<std::pair<const char*, const char*>> table = {
      {"common/base", "none"},
      {"common/codec", "common/base|seam"},
      {"common/net", "common/(base|codec)"},
      {"common/record", "common/(base|codec)"},
      {"common/physics", "common/base"},
      {"common/sync", "common/(base|codec|net|record|physics)"},
      {"common/measure", "common/(base|codec|net|record|physics|sync)"},
      {"server", "common/.*"},
      {"client", "common/.*"},
      {"render", "common/.*"},
      {"tests/lab/hard", "common/.*"},
      {"tests/lab/report", "common/.*|tests/lab"},
      {"tests/lab/world", "common/.*|tests/lab|tests/lab/report"},
      {"tests/lab", "common/.*|server|client|tests/lab/(hard|report|world)"},
      {"tests", "common/.*|server|client|render|tests/lab|tests/lab/.*"}};
  const Regex ours("(common/[a-z]+|server|client|render|tests|seam)/.*");
  std::string offenders;
  for (const Source& source : Code()) {
    const auto row = std::find_if(table.begin(), table.end(), [&](const auto& r) {
      return source.path.rfind(std::string(r.first) + "/", 0) == 0;
    });
    if (row == table.end()) {
      offenders += source.path + ": its module is not in the table\n";
      continue;
    }
    for (const std::string& name : source.includes) {
      if (!ours.Matches(name)) continue;
      const std::string module = fs::path(name).parent_path().generic_string();
      if (module != row->first && !Regex(row->second).Matches(module)) {
        offenders += source.path + " includes " + name + "\n";
      }
    }
  }
  EXPECT_TRUE(offenders.empty()) << offenders;
}

TEST(Layering, EveryIncludeOfOursIsWrittenFromTheRoot) {
  const Regex quoted(R"re( *# *include *"([^"]+)".*)re");
  std::string offenders;
  for (const Source& source : Code()) {
    for (const std::string& line : source.lines) {
      const std::string name = quoted.Group(line);
      if (!name.empty() && !fs::exists(Root() / name) && name.rfind("seam/", 0) != 0) {
        offenders += source.path + ": " + line + "\n";
      }
    }
  }
  EXPECT_TRUE(offenders.empty()) << offenders;
}

TEST(Layering, EachOutsideLibraryHasOneDoor) {
  ExpectOnlyIn("common/physics/.*|tests/lab/hard/raw_box2d\\.cpp", kCode, "box2d/.*|Box2D/.*");
  ExpectOnlyIn("render/canvas[^/]*", kCode, "GL/.*|EGL/.*");
  ExpectOnlyIn("common/record/bus\\.cpp", kCode, "lcm/.*");
  ExpectOnlyIn("common/codec/codec[^/]*\\.cpp", kCode, "seam/[a-z]+_t\\.hpp");
  ExpectOnlyIn("render/png[^/]*", kCode, "png\\.h|spng\\.h");
  ExpectOnlyIn("render/font[^/]*", kCode, "ft2build\\.h|freetype/.*");
  ExpectOnlyIn("common/physics/.*", kProduct, "toml\\.hpp|toml[^/]*/.*");
  ExpectOnlyIn("(server|client|render)/.*", kProduct, "CLI/.*");
  ExpectOnlyIn("server/script_lua[^/]*", kCode, "(.*/)?(lua|lauxlib|lualib)\\.h(pp)?");
  ExpectOnlyIn("none", kProduct, "gtest/.*");
  ExpectOnlyIn("common/net/udp[^/]*", kProduct, "sys/socket\\.h|netinet/.*|arpa/.*|netdb\\.h");
}

TEST(Layering, PhysicsKnowsNoClockSocketOrUnseededChance) {
  ExpectOnlyIn("none", {"common/physics", "common/sync"},
               "chrono|ctime|time\\.h|sys/time\\.h|random|unistd\\.h|thread");
}

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

/// Characters on the screen: a byte that continues a UTF-8 sequence takes no column.
std::size_t Columns(const std::string& line) {
  const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
  return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), begins));
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
