#include "tests/lab/fairness/mirrored_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "common/sync/inputs/input_source.h"

namespace seam {
namespace {

std::string BotScript(std::int64_t seed, double seconds, int tick_hz) {
  std::string script;
  Input last;
  const auto ticks = static_cast<std::int64_t>(seconds * tick_hz);
  for (std::int64_t tick = 0; tick <= ticks; ++tick) {
    const Input input = BotInput(seed, 0, tick, tick_hz);
    if (tick > 0 && input == last) continue;
    last = input;
    script +=
        fmt::format("{}[{:.6f}, {{drive = {:.6f}, lift = {:.6f}}}]", script.empty() ? "" : ", ",
                    static_cast<double>(tick) / tick_hz, input.drive / 127.0, input.lift / 127.0);
  }
  return "script = [" + script + "]\n";
}

/// How many more brackets open than close before a comment.
int Opened(const std::string& line) {
  const std::string code = line.substr(0, line.find('#'));
  return static_cast<int>(std::count(code.begin(), code.end(), '[') -
                          std::count(code.begin(), code.end(), ']'));
}

}  // namespace

std::string WithMirroredBots(const Scene& scene, std::int64_t seed, double seconds) {
  const std::string script = BotScript(seed, seconds, scene.solver.tick_hz);
  std::istringstream lines(scene.text);
  std::string text;
  bool player = false;
  int open = 0;  // brackets of the script that is left out
  for (std::string line; std::getline(lines, line);) {
    if (open > 0) {
      open += Opened(line);
      continue;
    }
    if (player && line.rfind("script", 0) == 0) {
      open = Opened(line);
      continue;
    }
    if (line.rfind("[", 0) == 0) player = line.rfind("[[player]]", 0) == 0;
    text += line + "\n";
    if (player && line.rfind("[[player]]", 0) == 0) text += script;
  }
  return text;
}

}  // namespace seam
