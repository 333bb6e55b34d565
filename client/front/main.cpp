/// seam: one program in front of all others. `seam help`.

#include <string>
#include <vector>

#include "client/front/edit.h"
#include "client/front/play.h"
#include "client/front/verbs.h"
#include "common/base/command_line.h"
#include "common/base/find_scene.h"
#include "common/base/process.h"
#include "common/codec/version_line.h"
#include "common/net/impair.h"
#include "common/sync/mode.h"

namespace {

using namespace seam;

/// The subcommands that this program does itself, as parsed.
struct FrontCommands {
  Command* play = nullptr;
  Command* demo = nullptr;
  Command* edit = nullptr;
  PlayOptions options;
  EditOptions edited;
  bool no_browser = false;
};

void AddPlay(Command& command, FrontCommands& f) {
  PlayOptions& o = f.options;
  command.Option("scene", o.scene, "scene file or name (arena)");
  command.Option("--impair", o.impair, "network of all players (demo)");
  command.Option("--mode", o.mode, "as of seam-server (buffer)");
  command.Option("--bots", o.bots, "at most so many other players (7)").Range(0, 31);
  command.Option("--port", o.port, "of the page; 0: any that is free (0)").Range(0, 65535);
  command
      .Option("--token", o.token,
              "of the page's address, instead of a new one: - is a line of standard input")
      .OneOf({"-"});
  command.Option("--duration", o.duration_s, "seconds (0: until stopped)").Range(0.0, 1e6);
  command.Switch("--no-browser", f.no_browser, "only print the page's address");
}

void DefineFront(Command& app, FrontCommands& f) {
  f.play = &app.Add("play", "play at once: a server, bots, and a page to drive in");
  AddPlay(*f.play, f);
  f.play->Option("--name", f.options.name, "player to drive (the scene's first)");
  f.demo = &app.Add("demo", "the same with bots only, to look on");
  AddPlay(*f.demo, f);
  f.edit = &app.Add("edit", "check a scene each time it is saved, and play it anew");
  f.edit->Option("scene", f.edited.scene, "scene file or name").Required();
  f.edit->Switch("--play", f.edited.play, "play it from the start after each save that loads");
  f.edit->Option("--port", f.edited.room.port, "of its page; 0: any that is free (0)")
      .Range(0, 65535);
  f.edit->Option("--impair", f.edited.room.impair, "network of all players (demo)");
  f.edit->Option("--mode", f.edited.room.mode, "as of seam-server (buffer)");
  for (const Verb& verb : Verbs()) {
    app.Add(verb.name, std::string(verb.about) + " (" + verb.program + ")");
  }
  app.RequireCommand();
}

int RunFront(FrontCommands& f) {
  if (f.edit->chosen()) {
    FindProfile(f.edited.room.impair);
    return EditScene(f.edited);
  }
  f.options.drive = f.play->chosen();
  f.options.browser = !f.no_browser;
  FindProfile(f.options.impair);  // refuses a name that is none
  return Play(f.options);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  // The arguments of another program are its own to read.
  if (!words.empty() && FindVerb(words[0]) != nullptr) {
    return RunMain("seam", [&]() -> int {
      Become(*FindVerb(words[0]), {words.begin() + 1, words.end()});
    });
  }
  if (!words.empty() && words[0] == "help") {
    words.erase(words.begin());
    if (words.size() == 1 && FindVerb(words[0]) != nullptr) {
      return RunMain("seam", [&]() -> int { Become(*FindVerb(words[0]), {"--help"}); });
    }
    words.push_back("--help");
  }
  if (words.empty()) words.push_back("--help");
  std::vector<const char*> arguments{argv[0]};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  FrontCommands commands;
  const ProgramText text{"seam",
                         "seam: a distributed 2D physics runtime; `seam play` is a first try",
                         VersionLine("seam"),
                         "seam help VERB explains a verb.",
                         {{"scene", SceneNames()}, {"--impair", ProfileNames()}}};
  return RunCommandLine(
      text, static_cast<int>(arguments.size()), arguments.data(),
      [&](Command& app) { DefineFront(app, commands); }, [&] { return RunFront(commands); });
}
