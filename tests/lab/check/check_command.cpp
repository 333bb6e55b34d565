#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "common/base/check.h"
#include "common/base/find_scene.h"
#include "tests/lab/check/scene_check.h"
#include "tests/lab/commands.h"

namespace seam {
namespace {

/// The program beside this one that draws; "" when there is none.
std::string Renderer() {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto program = self.parent_path() / "seam-render";
  return std::filesystem::exists(program, error) ? program.string() : "";
}

/// seam-render's exit status.
int Draw(const std::string& scene, const std::string& picture, bool force) {
  std::string program = Renderer();
  if (program.empty()) throw OperatorError("-o: there is no seam-render beside this program");
  std::vector<std::string> words = {"seam-render", scene, "-o", picture};
  if (force) words.push_back("--force");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  std::fflush(stdout);
  pid_t child = 0;
  int status = 0;
  if (posix_spawn(&child, program.c_str(), nullptr, nullptr, pointers.data(), environ) != 0 ||
      waitpid(child, &status, 0) != child) {
    throw OperatorError(program + ": cannot be started");
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

int RunCheck(const CheckCommand& command) {
  if (!command.picture.empty() && command.scenes.size() != 1) {
    throw OperatorError("-o draws one scene, not several");
  }
  int count = 0;
  for (const std::string& word : command.scenes) {
    const std::string path = FindScene(word);
    const std::vector<Finding> findings = CheckMeaning(LoadScene(path));
    for (const Finding& finding : findings) {
      std::printf("%s:%d: %s\n", path.c_str(), finding.line, finding.text.c_str());
    }
    if (findings.empty()) std::printf("%s: nothing found\n", path.c_str());
    count += static_cast<int>(findings.size());
  }
  const int found = count > 0 ? 1 : 0;
  if (command.picture.empty()) return found;
  const int drawn = Draw(FindScene(command.scenes.front()), command.picture, command.force);
  return drawn != 0 ? drawn : found;
}

}  // namespace seam
