/// Man pages and completions document every flag of every program, and the tools that read them
/// accept them.

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace pages_test {

using Words = std::vector<std::string>;

constexpr const char* kPrograms[] = {"seam-server",  "seam-client", "seam-render",
                                     "seam-measure", "seam-export", "seam-import",
                                     "seam-view", "seam-log",    "seam",        "seam-lab"};

std::string Generated(const std::string& program, const std::string& kind) {
  Program run({BuiltProgram(program), "--generate", kind});
  EXPECT_TRUE(run.Wait(60) && run.status() == 0) << run.Story();
  return run.output();
}

/// Flags and subcommands of each program, and the subcommands' flags.
/// tests/process/interface_test.cpp compares the file with --help.
Words NamesOf(const std::string& program) {
  Words names;
  for (const std::string& line : Lines(Root() / "tests/process/interface.txt")) {
    std::istringstream in(line);
    const Words words{std::istream_iterator<std::string>(in), {}};
    if (words.size() < 3 || words[0] != program) continue;
    const std::string& kind = words[words.size() - 2];
    if (kind == "flag" || kind == "subcommand") names.push_back(words.back());
  }
  return names;
}

bool Has(const std::string& program) {
  Program which({"sh", "-c", "command -v " + program});
  return which.Wait(60) && which.status() == 0;
}

/// Returns the text on stderr, and a status other than 0.
std::string Complaints(const Words& words) {
  Program run(words);
  if (!run.Wait(60)) return "hangs";
  return run.errors() + (run.status() == 0 ? "" : "status " + std::to_string(run.status()));
}

TEST(Pages, DocumentEveryFlagAndSubcommand) {
  for (const std::string program : kPrograms) {
    const Words names = NamesOf(program);
    EXPECT_GT(names.size(), program == "seam-server" || program == "seam-lab" ? 8u : 6u) << program;
    const std::string man = Generated(program, "man"), bash = Generated(program, "bash"),
                      zsh = Generated(program, "zsh"), fish = Generated(program, "fish");
    for (const std::string& name : names) {
      if (name[0] != '-') {  // a subcommand
        EXPECT_NE(man.find("\n.SS " + name.substr(0, name.find('-'))), std::string::npos) << name;
        EXPECT_NE(bash.find("'. " + name + "')"), std::string::npos) << name;
        EXPECT_NE(zsh.find("'" + name + ":"), std::string::npos) << name;
        EXPECT_NE(fish.find(" -a " + name + " "), std::string::npos) << name;
        continue;
      }
      std::string escaped;
      for (const char c : name) escaped += c == '-' ? std::string("\\-") : std::string(1, c);
      EXPECT_NE(man.find("\\fB" + escaped + "\\fR"), std::string::npos) << program << " " << name;
      EXPECT_NE(bash.find(name), std::string::npos) << program << " " << name;
      EXPECT_NE(zsh.find("'*" + name + "["), std::string::npos) << program << " " << name;
      const bool is_long = name.rfind("--", 0) == 0;
      const std::string option = is_long ? " -l " + name.substr(2) : " -s " + name.substr(1);
      EXPECT_NE(fish.find(option + " "), std::string::npos) << program << " " << name;
    }
  }
}

TEST(Pages, AreAcceptedByManBashZshAndFishWithoutMessages) {
  const Workspace folder;
  for (const std::string program : kPrograms) {
    folder.Write(program + ".1", Generated(program, "man"));
    folder.Write(program + ".bash", Generated(program, "bash"));
    folder.Write(program + ".zsh", Generated(program, "zsh"));
    folder.Write(program + ".fish", Generated(program, "fish"));
    const std::string man = folder / (program + ".1");
    // man-db prints roff's warnings with --warnings.
    if (Has("man") && Has("groff")) {
      EXPECT_EQ(Complaints({"man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", man}), "");
    }
    if (Has("mandoc")) {
      // The date that it misses would be that of the build.
      EXPECT_EQ(
          Complaints({"sh", "-c",
                      "! mandoc -Tlint -W warning '" + man + "' | grep -v 'missing date' >&2"}),
          "");
    }
    EXPECT_EQ(Complaints({"bash", "-n", folder / (program + ".bash")}), "") << program;
    if (Has("zsh")) {
      EXPECT_EQ(Complaints({"zsh", "-n", folder / (program + ".zsh")}), "");
    }
    if (Has("fish")) {
      EXPECT_EQ(Complaints({"fish", "-n", folder / (program + ".fish")}), "");
    }
  }
}

/// Returns bash's completions of the last of these words, in order.
Words Completed(const Words& words) {
  const Workspace folder;
  folder.Write("script", Generated(words[0], "bash"));
  std::string function = "_" + words[0], line;
  std::replace(function.begin(), function.end(), '-', '_');
  for (const std::string& word : words) line += "'" + word + "' ";
  Program bash({"bash", "-c",
                ". " + (folder / "script") + "; COMP_WORDS=(" + line +
                    "); COMP_CWORD=" + std::to_string(words.size() - 1) + "; " + function +
                    "; printf '%s\\n' \"${COMPREPLY[@]}\""},
               folder.path());
  EXPECT_TRUE(bash.Wait(60) && bash.status() == 0) << bash.Story();
  Words found;
  std::istringstream in(bash.output());
  for (std::string word; in >> word;) found.push_back(word);
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Pages, BashCompletesSubcommandsFlagsValuesAndScenes) {
  EXPECT_EQ(Completed({"seam-lab", "sw"}), (Words{"sweep"}));
  EXPECT_EQ(Completed({"seam-lab", "run", "--dr"}), (Words{"--drive"}));
  EXPECT_EQ(Completed({"seam-lab", "run", "--drive", ""}), (Words{"bot", "script"}));
  EXPECT_EQ(Completed({"seam-lab", "run", "x.toml", "--smooth", "o"}), (Words{"off", "on"}));
  EXPECT_EQ(Completed({"seam-lab", "sweep", "--drive"}), Words{}) << "is a flag of run";
  EXPECT_EQ(Completed({"seam-server", "cross"}), (Words{"crossing"}));
  EXPECT_EQ(Completed({"seam-server", "--mode", "s"}), (Words{"strict"}));
  EXPECT_EQ(Completed({"seam-server", "--reconcile", "sp"}), (Words{"spring"}));
  EXPECT_EQ(Completed({"seam-client", "--impair", "dem"}), (Words{"demo"}));
  EXPECT_EQ(Completed({"seam-render", "--page", "-o", "scri"}), (Words{"script"})) << "a file";
}

TEST(Pages, AnUnknownKindIsOneLine) {
  Program run({BuiltProgram("seam-lab"), "--generate", "bsh"});
  ASSERT_TRUE(run.Wait(60));
  EXPECT_EQ(run.status(), 2);
  EXPECT_EQ(
      run.errors(),
      "seam-lab: --generate takes man, bash, zsh or fish, not 'bsh' (did you mean 'bash'?)\n");
}

}  // namespace pages_test
}  // namespace seam
