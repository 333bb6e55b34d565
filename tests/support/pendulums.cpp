#include "tests/support/pendulums.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

namespace seam {

std::string Pendulums(int count) {
  std::string text = R"(
duration = 20
buffer = 4
[[part]]
name = "beam"
box = [1, 1]
position = [0, 20]
anchored = true
[[player]]
name = "ann"
region = [[-100, -100], [-0.001, 100]]
[[player]]
name = "bob"
region = [[0, -100], [100, 100]]
)";
  for (int n = 0; n < count; ++n) {
    const std::string name = "ball" + std::to_string(n);
    const std::string at = "[" + std::to_string(n % 2 == 0 ? 5 + n % 5 : -5 - n % 5) + ", " +
                           std::to_string(8 + n % 11) + "]";
    text += "[[part]]\nname = \"" + name + "\"\ncircle = 0.3\ngroup = -1\nposition = " + at + "\n";
    text += "[[joint]]\nname = \"rope" + std::to_string(n) +
            "\"\nkind = \"distance\"\na = \"beam\"\nb = \"" + name +
            "\"\nanchor_a = [0, 20]\nanchor_b = " + at + "\n";
  }
  return text;
}

std::vector<double> HandOverMs(const Recording& recording) {
  std::map<int, std::pair<std::int32_t, std::int64_t>> revoked;  // mechanism -> epoch, utime
  std::vector<double> ms;
  for (const Grants& g : recording.grants) {
    for (std::size_t i = 0; i < g.mechanism.size(); ++i) {
      const auto it = revoked.find(g.mechanism[i]);
      if (it != revoked.end() && g.epoch[i] == it->second.first + 1) {
        ms.push_back(static_cast<double>(g.utime - it->second.second) / 1000);
      }
      if (it != revoked.end() && g.epoch[i] > it->second.first) revoked.erase(it);
      if (g.authority[i] == 0) revoked.emplace(g.mechanism[i], std::pair(g.epoch[i], g.utime));
    }
  }
  std::sort(ms.begin(), ms.end());
  return ms;
}

}  // namespace seam
