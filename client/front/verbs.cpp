#include "client/front/verbs.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "common/base/check.h"

namespace seam {

const std::vector<Verb>& Verbs() {
  static const std::vector<Verb> verbs = {
      {"server", "seam-server", "run a room, or several"},
      {"relay", "seam-relay", "pass a room on to many watchers"},
      {"join", "seam-client", "be a player of a room, or look on"},
      {"view", "seam-view", "watch a running session in a browser"},
      {"record", "lcm-logger", "capture the LCM bus in a log"},
      {"replay", "lcm-logplayer", "put a log on the LCM bus again"},
      {"measure", "seam-measure", "turn logs into numbers"},
      {"render", "seam-render", "turn logs into pictures, a video, or a page"},
      {"export", "seam-export", "turn logs into CSV, JSON, MCAP, or a trace"},
      {"log", "seam-log", "check, list, cut and merge logs"},
      {"import", "seam-import", "turn other programs' worlds into scenes"},
      {"lab", "seam-lab", "experiments in virtual time"},
      {"swarm", "seam-swarm", "put a server under load with many clients"},
      {"top", "seam-top", "watch the cost of a server's rooms"},
      {"token", "seam-token", "make keys and tokens of an operator"}};
  return verbs;
}

const Verb* FindVerb(const std::string& name) {
  const auto& all = Verbs();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Verb& verb) { return verb.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string ProgramPath(const std::string& name) {
  std::error_code error;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string beside = (own.parent_path() / name).string();
  return !error && access(beside.c_str(), X_OK) == 0 ? beside : name;
}

void Become(const Verb& verb, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{verb.program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execvp(ProgramPath(verb.program).c_str(), argv.data());
  throw OperatorError(std::string(verb.program) + ": " + std::strerror(errno));
}

}  // namespace seam
