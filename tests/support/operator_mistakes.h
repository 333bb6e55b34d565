#pragma once
/// Mistakes of an operator: a folder with bad scenes, logs and files, and checks of the error lines
/// that programs print for them.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "common/codec/codec.h"
#include "common/net/udp.h"
#include "common/record/log_file.h"
#include "tests/support/program.h"

namespace seam {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

struct Mistake {
  Words command;     ///< program and arguments, run in a folder that Furnish has prepared
  std::string says;  ///< part of the line
};

constexpr const char* kTail =
    "[[player]]\nname = \"ann\"\n"
    "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\n";
constexpr const char* kCrate = "[[part]]\nname = \"crate\"\nposition = [0, 2]\n";
constexpr const char* kAxle = "[[joint]]\nname = \"axle\"\nkind = \"revolute\"\na = \"ground\"\n";

/// Scenes with one mistake each, and the expected error text. (tests/scene/scene_mistakes_test.cpp
/// has every kind; here are those that an operator sees.)
struct BadScene {
  const char* name;
  std::string text;
  const char* says;
};

inline const std::vector<BadScene>& BadScenes() {
  static const std::string tail = kTail, crate = tail + kCrate;
  static const std::string axle = crate + "box = [1, 1]\n" + kAxle;
  static const std::vector<BadScene> scenes = {
      {"empty.toml", "", "empty.toml:1: "},
      {"garbage.toml",
       "\x7f"
       "ELF\x01\x01\n\n",
       "garbage.toml:1: "},
      {"unclosed.toml", tail + "[[part]\nname = 1\n", "unclosed.toml:6: "},
      {"unknown.toml", crate + "densty = 1\nbox = [1, 1]\n", "unknown.toml:9: "},
      {"type.toml", crate + "box = \"large\"\n", "type.toml:9: "},
      {"nan.toml", crate + "box = [nan, 1]\n", "nan.toml:9: "},
      {"inf.toml", crate + "box = [1, 1]\nvelocity = [inf, 0]\n", "inf.toml:10: "},
      {"negative.toml", crate + "circle = -1\n", "negative.toml:9: "},
      {"density.toml", crate + "box = [1, 1]\ndensity = -2\n", "density.toml:10: "},
      {"gravity.toml", "gravity = [0, nan]\n" + tail, "gravity.toml:1: "},
      {"twice.toml", crate + "box = [1, 1]\n" + kCrate + "box = [1, 1]\n", "twice.toml:1"},
      {"players.toml", tail + "[[player]]\nname = \"ann\"\n", "players.toml:7: "},
      {"dangling.toml", axle + "b = \"chasis\"\nanchor = [0, 0]\n", "no part 'chasis'"},
      {"itself.toml", axle + "b = \"ground\"\nanchor = [0, 0]\n", "itself.toml:1"},
      {"long.toml", tail + std::string(4100000, '#') + "\n", "long.toml:1: "}};
  return scenes;
}

/// Files that are made once and copied into each mistake's folder.
class BadInput : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    made_ = std::make_unique<Workspace>();
    const Workspace& to = *made_;
    for (const char* scene : {"crossing.toml", "stack.toml"}) {
      fs::copy_file(std::string("scenes/") + scene, to / scene);
    }
    to.Write("nothing.lcm", "");
    to.Write("words.lcm", "These are words, not events.\n");
    to.Write("other.csv", "a,b\n1,2\n");
    fs::create_directory(to / "folder");
    fs::create_directory(to / "pictures");
    to.Write("pictures/holiday.png", "not a frame");
    for (const BadScene& scene : BadScenes()) to.Write(scene.name, scene.text);
    MakeLogs(to);
  }
  static void TearDownTestSuite() { made_.reset(); }

  /// Real recordings, a third of a second long, and some that lack what the programs need.
  static void MakeLogs(const Workspace& to) {
    const std::string server = BuiltProgram("seam-server");
    const auto record = [&](const char* scene, const char* log, const char* mode) {
      return std::make_unique<Program>(
          Words{server, scene, "--bind", "127.0.0.1:0", "--wait", "0", "--duration", "0.3",
                "--lcm-url", "none", "--mode", mode, "--record", log},
          to.path());
    };
    std::vector<std::unique_ptr<Program>> runs;
    runs.push_back(record("crossing.toml", "good.lcm", "buffer"));
    runs.push_back(record("stack.toml", "stack.lcm", "oracle"));
    for (auto& run : runs) ASSERT_TRUE(run->Wait(30) && run->status() == 0) << run->Story();

    Room room;
    room.room = "r";
    room.mode = "central";
    room.scene_name = "bad";
    room.scene_text = "part = 3\n";
    View view;
    view.id = {0};
    view.role = {kRoleAuthority};
    view.authority = {0};
    view.x = view.y = view.angle = view.vx = view.vy = view.spin = view.age = {0.0f};
    LogWriter(to / "roomless.lcm").Publish("SEAM.r.view.0", 0, Encode(view));
    LogWriter(to / "viewless.lcm").Publish("SEAM.r.scene", 0, Encode(room));
    LogWriter sceneless(to / "sceneless.lcm");
    sceneless.Publish("SEAM.r.scene", 0, Encode(room));
    sceneless.Publish("SEAM.r.view.0", 1, Encode(view));
  }

  /// A command under test, in a folder of its own.
  struct Running {
    explicit Running(const Mistake& m) : mistake(m) {
      fs::copy(made_->path(), folder.path(), fs::copy_options::recursive);
      before = folder.Content();
      Words words = mistake.command;
      words[0] = BuiltProgram(words[0]);
      program = std::make_unique<Program>(words, folder.path());
    }
    void Judge() {
      std::string trace;
      for (const std::string& word : mistake.command) trace += "'" + word + "' ";
      SCOPED_TRACE(trace);
      EXPECT_TRUE(program->Wait(60)) << "hangs";
      SCOPED_TRACE(program->Story());
      EXPECT_EQ(program->status(), 2);
      EXPECT_EQ(program->output(), "");
      const std::string line = program->errors();
      EXPECT_EQ(line.rfind(mistake.command[0] + ": ", 0), 0u);
      EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
      EXPECT_EQ(line.find('\r'), std::string::npos);
      EXPECT_FALSE(line.empty() || line.back() != '\n');
      EXPECT_NE(line.find(mistake.says), std::string::npos) << "should say: " << mistake.says;
      EXPECT_EQ(folder.Content(), before) << "nothing may be written";
    }
    const Mistake mistake;
    Workspace folder;
    std::vector<std::string> before;
    std::unique_ptr<Program> program;
  };

  /// Runs a few commands at a time.
  static void Judge(const std::vector<Mistake>& mistakes) {
    std::deque<Running> running;
    for (const Mistake& mistake : mistakes) {
      running.emplace_back(mistake);
      if (running.size() < 4) continue;
      running.front().Judge();
      running.pop_front();
    }
    for (Running& last : running) last.Judge();
  }

  static inline std::unique_ptr<Workspace> made_;
};

/// Makes a mistake of `words` after the program's name; all other arguments are correct.
inline Mistake ServerMistake(Words words, const std::string& says) {
  words.insert(words.begin(), "seam-server");
  if (std::count(words.begin(), words.end(), "--lcm-url") == 0) {
    words.insert(words.end(), {"--lcm-url", "none"});
  }
  return {words, says};
}
inline Mistake ClientMistake(Words words, const std::string& says) {
  if (std::find(words.begin(), words.end(), "--name") == words.end()) {
    words.insert(words.end(), {"--name", "ann"});
  }
  Mistake mistake = ServerMistake(std::move(words), says);
  mistake.command[0] = "seam-client";
  return mistake;
}
inline Mistake Measure(Words words, const std::string& says) {
  words.insert(words.begin(), "seam-measure");
  return {words, says};
}
inline Mistake Render(Words words, const std::string& says) {
  words.insert(words.begin(), "seam-render");
  return {words, says};
}

}  // namespace seam
