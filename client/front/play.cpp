#include "client/front/play.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <vector>

#include "client/front/child.h"
#include "client/front/verbs.h"
#include "common/base/check.h"
#include "common/base/find_scene.h"
#include "common/base/nearest.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/record/bus.h"
#include "common/scene/scene.h"

namespace seam {
namespace {

constexpr double kStart_s = 10;  ///< for a program to say that it is there

/// A folder for what the programs say and, without the bus, for their logs; removed with us.
class PlayFolder {
 public:
  PlayFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "seam-play-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw OperatorError("no folder for temporary files");
    path_ = pattern;
  }
  ~PlayFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  PlayFolder(const PlayFolder&) = delete;
  PlayFolder& operator=(const PlayFolder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// Returns the word that follows `mark` in a text, up to a space, a semicolon or the line's end.
std::string WordAfter(const std::string& text, const std::string& mark) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + mark.size(), end = text.find_first_of("; \n", begin);
  return end == std::string::npos ? "" : text.substr(begin, end - begin);
}

/// True if LCM's bus works here.
bool BusWorks() {
  try {
    const Bus bus("");
    return true;
  } catch (const OperatorError&) {
    return false;
  }
}

bool IsTerminal() { return isatty(0) != 0 && isatty(1) != 0; }

/// The programs of a session. They say what they have to say into files.
class Session {
 public:
  explicit Session(const PlayOptions& options)
      : options_(options), on_bus_(BusWorks()), room_("play-" + std::to_string(getpid())) {}

  int Run() {
    ChoosePlayers();
    if (options_.token == "-") std::getline(std::cin, token_);
    StartServer();
    if (g_stop == 0) StartView();
    if (g_stop == 0) StartPlayers();
    if (g_stop == 0 && options_.browser) OpenBrowser();
    while (g_stop == 0 && AllRun()) {
      TellTroubles();
      SleepUs(50000);
    }
    return End();
  }

 private:
  void ChoosePlayers() {
    const Scene scene = LoadScene(FindScene(options_.scene));
    std::vector<std::string> names;
    for (const Player& player : scene.players) names.push_back(player.name);
    if (names.empty()) throw OperatorError(options_.scene + ": a scene without players");
    own_ = options_.name.empty() ? names.front() : options_.name;
    const auto found = std::find(names.begin(), names.end(), own_);
    if (found == names.end()) {
      throw OperatorError("--name " + own_ + ": " + options_.scene + " has no such player; " +
                          Suggestion(own_, names));
    }
    if (options_.drive) names.erase(found);
    bots_ = names;
    const auto most = static_cast<std::size_t>(std::max(0, options_.bots));
    if (bots_.size() > most) bots_.resize(most);
  }

  std::string FileOf(const std::string& program) const { return folder_ / (program + ".txt"); }

  Child* Start(const std::string& as, const std::vector<std::string>& words, ChildFiles files) {
    files.errors = open(FileOf(as).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    children_.push_back(std::make_unique<Child>(words, files));
    names_.push_back(as);
    if (files.errors >= 0) close(files.errors);
    return children_.back().get();
  }

  /// Waits for a text among what a program says. Throws its last line if it ends before.
  std::string WaitFor(Child* child, const std::string& as, const std::string& mark) {
    const std::int64_t begin_us = SteadyClockUs();
    while (g_stop == 0) {
      const std::string text = ReadPlainFile(FileOf(as), 1 << 20);
      const std::string word = WordAfter(text, mark);
      if (!word.empty()) return word;
      if (!child->running()) throw OperatorError(LastLine(as));
      if (static_cast<double>(SteadyClockUs() - begin_us) * 1e-6 > kStart_s) {
        throw OperatorError(as + " does not start");
      }
      SleepUs(10000);
    }
    return "";
  }

  /// Returns the last line that a program has said: an error, if it has ended by one.
  std::string LastLine(const std::string& as) const {
    std::string text = ReadPlainFile(FileOf(as), 1 << 20);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    const std::string line = text.substr(text.rfind('\n') + 1);
    return line.empty() ? as + " has ended" : line;
  }

  /// Prints the server's lines about trouble in its room, such as a script that is stopped: all
  /// that it says between its start and its summary. A terminal that shows the room has them at the
  /// end.
  void TellTroubles() {
    if (heard_ == std::string::npos) return;
    const std::string text = ReadPlainFile(FileOf("server"), 1 << 20);
    for (std::size_t end = 0; (end = text.find('\n', heard_)) != std::string::npos;) {
      const std::string line = text.substr(heard_, end - heard_);
      if (line.find(" ticks; dropped ") != std::string::npos) return;  // the summary
      heard_ = end + 1;
      troubles_.push_back(line);
    }
    if (in_terminal_) return;
    for (; told_ < troubles_.size(); ++told_) {
      std::fprintf(stderr, "%s\n", troubles_[told_].c_str());
    }
  }

  /// Adds the flags by which a program's messages reach the view.
  void AddBus(const std::string& as, std::vector<std::string>* words) {
    if (on_bus_) return;
    logs_.push_back(folder_ / (as + ".lcm"));
    words->insert(words->end(), {"--lcm-url", "none", "--record", logs_.back()});
  }

  void StartServer() {
    const std::size_t players = bots_.size() + (options_.drive ? 1 : 0);
    std::vector<std::string> words{"seam-server", options_.scene,
                                   "--bind",      "127.0.0.1:0",
                                   "--room",      room_,
                                   "--impair",    options_.impair,
                                   "--mode",      options_.mode,
                                   "--wait",      std::to_string(players),
                                   "--duration",  std::to_string(options_.duration_s),
                                   "--control",   "0",
                                   "--quiet"};
    AddBus("server", &words);
    Child* server = Start("server", words, {});
    control_ = "http://127.0.0.1:" + WaitFor(server, "server", "control at http://127.0.0.1:");
    address_ = "127.0.0.1:" + WaitFor(server, "server", "on 127.0.0.1:");
    if (g_stop != 0) return;
    const std::string text = ReadPlainFile(FileOf("server"), 1 << 20);
    heard_ = text.find('\n', text.find("control at ")) + 1;
  }

  void StartView() {
    std::vector<std::string> logs = logs_;
    std::vector<std::string> words{"seam-view", "--port", std::to_string(options_.port),
                                   "--room",    room_,    "--oracle",
                                   "--control", "-"};
    if (options_.drive) words.insert(words.end(), {"--drive", own_});
    if (!token_.empty()) words.insert(words.end(), {"--token", "-"});
    if (!on_bus_) {
      logs.push_back(folder_ / (own_ + ".lcm"));
      for (const std::string& bot : bots_) logs.push_back(folder_ / (bot + ".lcm"));
      std::sort(logs.begin(), logs.end());
      logs.erase(std::unique(logs.begin(), logs.end()), logs.end());
      words.insert(words.end(), logs.begin(), logs.end());
    }
    int pipe[2] = {-1, -1};
    if (options_.drive && pipe2(pipe, O_CLOEXEC) != 0) throw OperatorError("no pipe");
    ChildFiles files;
    files.output = pipe[1];
    files.input = ReadableText(control_ + "\n" + token_ + "\n");
    Child* view = Start("view", words, files);
    close(files.input);
    if (pipe[1] >= 0) close(pipe[1]);
    keys_ = pipe[0];
    page_ = "http://127.0.0.1:" + WaitFor(view, "view", "http://127.0.0.1:");
    if (g_stop == 0) std::fprintf(stderr, "seam: %s\n", page_.c_str());
  }

  void StartPlayers() {
    for (const std::string& bot : bots_) {
      std::vector<std::string> words = ClientWords(bot);
      words.insert(words.end(), {"--drive", "bot"});
      Start(bot, words, {});
    }
    if (!options_.drive) {
      std::fprintf(stderr, "seam: bots play %s; Ctrl-C ends it\n", options_.scene.c_str());
      return;
    }
    std::vector<std::string> words = ClientWords(own_);
    words.insert(words.end(), {"--inputs", "/dev/fd/3"});
    ChildFiles files;
    files.third = keys_;
    files.terminal = IsTerminal();
    in_terminal_ = files.terminal;
    if (files.terminal) {
      words.insert(words.end(), {"--drive", "keyboard", "--hint", "also " + page_});
    }
    player_ = Start(own_, words, files);
    if (!files.terminal) {
      std::fprintf(stderr, "seam: drive %s there by arrows or WASD; Ctrl-C ends it\n",
                   own_.c_str());
    }
    close(keys_);
  }

  std::vector<std::string> ClientWords(const std::string& name) {
    // The network is the server's, where the page changes it.
    std::vector<std::string> words{"seam-client", address_, "--name", name, "--room", room_};
    AddBus(name, &words);
    return words;
  }

  void OpenBrowser() {
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
    Start("browser", {"xdg-open", page_}, {});
  }

  /// True while all programs run that have to; a browser's starter may end.
  bool AllRun() {
    for (std::size_t i = 0; i < children_.size(); ++i) {
      if (!children_[i]->running() && names_[i] != "browser") return false;
    }
    return true;
  }

  /// Says why a program has ended by itself.
  std::string WhyEnded(std::size_t child) const {
    const int status = children_[child]->status();
    if (status <= 128) return LastLine(names_[child]);
    return "seam: " + children_[child]->name() + " was killed by signal " +
           std::to_string(status - 128);
  }

  /// Ends the programs, the players first; returns the exit status.
  int End() {
    std::string ended;
    int status = 0;
    for (std::size_t i = 0; i < children_.size() && g_stop == 0; ++i) {
      if (children_[i]->running() || names_[i] == "browser") continue;
      status = children_[i]->status();
      if (status != 0) ended = WhyEnded(i);
      break;
    }
    if (player_ != nullptr) player_->Interrupt();
    for (std::size_t i = children_.size(); i-- > 0;) children_[i]->End();
    in_terminal_ = false;
    TellTroubles();
    // The server is the first. It ends with 1 because of what it has said.
    const bool told = !troubles_.empty() && children_[0]->status() == 1;
    if (status != 0 && !told) std::fprintf(stderr, "%s\n", ended.c_str());
    return status == 0 && !told ? 0 : 1;
  }

  const PlayOptions options_;
  const bool on_bus_;
  const std::string room_;
  const PlayFolder folder_;
  std::string own_;
  std::vector<std::string> bots_, logs_, names_;
  std::vector<std::unique_ptr<Child>> children_;
  Child* player_ = nullptr;  // among children_
  std::string address_, page_, control_;
  std::string token_;                      // of the page; "": its own
  std::vector<std::string> troubles_;      // lines of the server
  std::size_t heard_ = std::string::npos;  // bytes of its lines; npos: it starts
  std::size_t told_ = 0;                   // of troubles_
  bool in_terminal_ = false;               // the player shows the room in our terminal
  int keys_ = -1;  // the page's inputs come here
};

}  // namespace

int Play(const PlayOptions& options) {
  StopOnSignals();
  return Session(options).Run();
}

}  // namespace seam
