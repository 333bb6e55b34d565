/// What people's scripts depend on stays as it is: names of columns, rows, flags, keys, profiles,
/// rules and channels. tests/process/interface.txt holds them, one a line, in their order. After a
/// change that is meant, rewrite it with
///   SEAM_INTERFACE=write build/release/seam-tests --gtest_filter='Interface.*'
/// look at the difference, and say in the commit message what was added or taken away and why.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "common/codec/message_list.h"
#include "common/measure/table.h"
#include "common/net/impair.h"
#include "common/sync/mode.h"
#include "tests/lab/physics_row.h"
#include "tests/lab/sweep_row.h"
#include "tests/support/known_keys.h"
#include "tests/support/lab_workspace.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace interface_test {

using Names = std::vector<std::string>;

constexpr const char* kFile = "tests/process/interface.txt";

Names Split(const std::string& text, char by) {
  Names parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, by);) parts.push_back(part);
  return parts;
}

/// Collects "GROUP NAME" lines.
class Interface {
 public:
  void Add(const std::string& group, const Names& names) {
    EXPECT_FALSE(names.empty()) << group << ": there must be some";
    for (const std::string& name : names) lines_.push_back(group + ' ' + name);
  }
  const Names& lines() const { return lines_; }

 private:
  Names lines_;
};

/// Returns a program's output; it must succeed.
std::string Output(Names words) {
  words[0] = BuiltProgram(words[0]);
  Program program(words);
  EXPECT_TRUE(program.Wait(60));
  EXPECT_EQ(program.status(), 0) << program.Story();
  return program.output();
}

/// Returns the first words of the lines of a --help below the title, "options" or "subcommands": of
/// flags each spelling. CLI11 has changed the case of its titles and the columns of its flags: "
/// -o,--out TEXT", "  -o,     --out TEXT", "          --out TEXT".
Names Below(const std::string& help, const std::string& title) {
  constexpr std::size_t kIndentMax = 12;  // what is further in goes on with a description
  Names names;
  bool below = false;
  for (const std::string& line : Split(help, '\n')) {
    const std::size_t indent = line.find_first_not_of(' ');
    if (indent == std::string::npos) continue;
    if (indent == 0) {
      std::string lower = line;
      std::transform(lower.begin(), lower.end(), lower.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      below = lower == title + ":";
      continue;
    }
    if (!below || indent > kIndentMax) continue;
    std::istringstream in(line);
    std::string word;
    do {
      in >> word;
      for (const std::string& name : Split(word, ',')) {
        names.push_back(name.substr(0, name.find('{')));  // --no-floor{false}
      }
    } while (word.back() == ',' && in);
  }
  return names;
}

void AddPrograms(Interface* interface) {
  for (const char* program : {"seam-server", "seam-token", "seam-relay", "seam-client",
                              "seam-swarm", "seam-top", "seam-render", "seam-measure",
                              "seam-export", "seam-import", "seam-view", "seam-log", "seam-lab"}) {
    const std::string help = Output({program, "--help"});
    const std::string name = program;
    interface->Add(name + " flag", Below(help, "options"));
    if (name != "seam-lab" && name != "seam-log") continue;
    const Names commands = Below(help, "subcommands");
    interface->Add(name + " subcommand", commands);
    for (const std::string& command : commands) {
      interface->Add(name + " " + command + " flag",
                     Below(Output({program, command, "--help"}), "options"));
    }
  }
  const Names verbs = Below(Output({"seam", "--help"}), "subcommands");
  interface->Add("seam subcommand", verbs);
  for (const char* verb : {"play", "demo", "edit"}) {
    interface->Add("seam " + std::string(verb) + " flag",
                   Below(Output({"seam", verb, "--help"}), "options"));
  }
}

/// Names at the beginning of the indented lines of `seam-measure --more`, when everything applies.
Names MoreRows() {
  MeasuredRun run;
  Measures& m = run.measures;
  m.compared = 1;
  m.handovers = 1;
  m.sent_bytes_per_s = 1;
  m.seam_rms_m = m.seam_stutter_mps2 = m.rebound = m.rest_ticks = m.jitter_rest_mps = 1;
  m.penetration_m = m.joint_drift_m = m.energy_gain_j = 1;
  m.handover_gap_m = m.handover_dv_mps = m.topology_lag_s = 1;
  m.lost = 1;
  m.error_rms_by_peer_m = {{0, 1}};
  Names rows;
  for (const std::string& line : Split(FormatTable({run}, true), '\n')) {
    if (line.size() < 3 || line.compare(0, 2, "  ") != 0 || line[2] == ' ') continue;
    rows.push_back(line.substr(2, line.find("  ", 2) - 2));
  }
  return rows;
}

void AddTables(Interface* interface) {
  interface->Add("seam-measure --csv column", Split(CsvHeader(), ','));
  interface->Add("seam-measure --more row", MoreRows());
  interface->Add("seam-lab sweep column",
                 Split(SweepKeyColumns() + ',' + SweepValueColumns(), ','));
  interface->Add("seam-lab physics column",
                 Split(PhysicsKeyColumns() + ',' + PhysicsValueColumns(), ','));
  const LabWorkspace files;
  Output({"seam-lab", "overhead", (Root() / "scenes/cradle.toml").string(), "-o", files / "o.csv",
          "--repeats", "1"});
  const std::string table = files.Read("o.csv");
  interface->Add("seam-lab overhead column", Split(table.substr(0, table.find('\n')), ','));
}

void AddScenes(Interface* interface) {
  const std::string ann = "[[player]]\nname = \"ann\"\n";
  const std::string ball = "[[part]]\nname = \"p\"\ncircle = 1\n";
  const std::string two = ball + "[[part]]\nname = \"q\"\ncircle = 1\nposition = [5, 0]\n";
  const std::string joint = two + "[[joint]]\nname = \"j\"\na = \"p\"\nb = \"q\"\nkind = ";
  const std::string bricks = ball + "[[bricks]]\nname = \"b\"\nbrick = [1, 1]\n";
  const std::string who = ball + "[[character]]\nname = \"c\"\nposition = [0, 0]\n";
  const std::pair<const char*, std::string> tables[] = {
      {"", ""},
      {"[solver]", "[solver]"},
      {"[planner]", "[planner]"},
      {"[camera]", ball + "[camera]"},
      {"[grouping]", ball + "[grouping]"},
      {"[[part]]", "[[part]]"},
      {"[[part]] repeat", ball + "[part.repeat]"},
      {"[[part]] conveyor", ball + "[part.conveyor]"},
      {"[[part]] damage", ball + "health = 1\n[part.damage]"},
      {"[[part]] permissions", ball + "[part.permissions]"},
      {"[[bricks]]", ball + "[[bricks]]"},
      {"[[bricks]] towers", bricks + "[bricks.towers]"},
      {"[[character]]", ball + "[[character]]"},
      {"[[character]] torque", who + "[character.torque]"},
      {"[[joint]]", two + "[[joint]]"},
      {"[[joint]] motor (hinge)", joint + "\"hinge\"\n[joint.motor]"},
      {"[[joint]] motor (prismatic)", joint + "\"prismatic\"\n[joint.motor]"},
      {"[[joint]] follow", joint + "\"motor\"\nforce = 1\ntorque = 1\n[joint.follow]"},
      {"[[strand]]", ball + "[[strand]]"},
      {"[[thrust]]", ball + "[[thrust]]"},
      {"[[propeller]]", ball + "[[propeller]]"},
      {"[[water]]", ball + "[[water]]"},
      {"[[player]]", "[[player]]"},
      {"[[player]] actions", ball + ann + "[[player.actions]]"},
      {"[[seat]]", ball + "[[seat]]"},
      {"[[trigger]]", ball + "[[trigger]]"},
      {"[[charges]]", ball + "[[charges]]"},
      {"[[script]]", ball + "[[script]]"},
      {"[lcm]", ball + "[lcm]"},
      {"[[lcm.publish]]", ball + "[[lcm.publish]]"},
      {"[[lcm.drive]]", ball + "[[lcm.drive]]"},
      {"[[lcm.message]]", ball + "[[lcm.message]]"},
      {"[[watch]]", ball + "[[watch]]"}};
  for (const auto& [name, text] : tables) {
    interface->Add("scene key " + std::string(name), KnownKeys(text));
  }
}

void AddNames(Interface* interface) {
  Names names;
  for (const ImpairProfile& profile : Profiles()) names.push_back(profile.name);
  interface->Add("network profile", names);
  interface->Add("mode", ModeNames());
  names.clear();
  for (const NamedReconciler& rule : Reconcilers()) names.emplace_back(rule.name);
  interface->Add("reconciler", names);
  names.clear();
#define SEAM_NOTE_KIND(Struct, lcm_type, travels, kind, ...) \
  if (kind[0] != '\0') names.push_back(std::string(kind) + ' ' + #lcm_type);
  SEAM_MESSAGES(SEAM_NOTE_KIND)
#undef SEAM_NOTE_KIND
  interface->Add("channel kind", names);
}

/// Lines of `a` that `b` lacks.
std::string Lacking(const Names& a, const Names& b) {
  std::string lines;
  for (const std::string& line : a) {
    if (std::count(b.begin(), b.end(), line) == 0) lines += line + '\n';
  }
  return lines;
}

TEST(Interface, TheNamesThatScriptsUseMatchTheFile) {
  Interface found;
  AddTables(&found);
  AddPrograms(&found);
  AddScenes(&found);
  AddNames(&found);
  const char* request = std::getenv("SEAM_INTERFACE");
  if (request != nullptr && std::string(request) == "write") {
    std::ofstream out(Root() / kFile);
    for (const std::string& line : found.lines()) out << line << '\n';
    ASSERT_TRUE(out.good()) << "cannot write " << kFile;
  }
  const Names pinned = Lines(Root() / kFile);
  EXPECT_EQ(Lacking(pinned, found.lines()), "") << "gone: see the head of this file";
  EXPECT_EQ(Lacking(found.lines(), pinned), "") << "new: see the head of this file";
  EXPECT_TRUE(pinned == found.lines()) << "the same names in another order, or some twice";
}

TEST(Interface, ReadsHelpInAnyLayout) {
  const std::string help =
      "about\nUsage: x\n\nOPTIONS:\n  -o,--out TEXT  where\n  -h,     --help\n"
      "          --bind TEXT\n                   --not-this\n  --no-floor{false}  no\n\n"
      "Subcommands:\n  run  runs\n";
  EXPECT_EQ(Below(help, "options"), (Names{"-o", "--out", "-h", "--help", "--bind", "--no-floor"}));
  EXPECT_EQ(Below(help, "subcommands"), (Names{"run"}));
}

}  // namespace interface_test
}  // namespace seam
