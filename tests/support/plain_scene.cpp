#include "tests/support/plain_scene.h"

#include <fmt/format.h>

namespace seam {

std::string PlainText(const PlainScene& plain) {
  const float width = plain.spacing * static_cast<float>(plain.players) + 200;
  std::string text = fmt::format(
      "duration = {}\nbuffer = 4\nserver_follow = 0\nbounds = [[-200, -50], [{:.0f}, 200]]\n"
      "[solver]\nsubsteps = 1\n{}"
      "[[part]]\nname = \"ground\"\nchain = [[-150, 0], [{:.0f}, 0]]\n",
      plain.duration, width, plain.planner.empty() ? "" : "[planner]\n" + plain.planner + "\n",
      width - 50);
  for (int p = 0; p < plain.players; ++p) {
    const float x = plain.spacing * static_cast<float>(p);
    text += fmt::format(
        "[[player]]\nname = \"p{0}\"\nvehicle = \"cart-{0}\"\n[[part]]\nname = \"cart-{0}\"\n"
        "box = [2, 1]\nposition = [{1}, 0.51]\nfriction = 0.2\nowner = \"p{0}\"\n[[thrust]]\n"
        "name = \"push-{0}\"\npart = \"cart-{0}\"\nforce = [14, 0]\nplayer = \"p{0}\"\n",
        p, x);
    for (int c = 0; c < plain.crates; ++c) {
      const int column = c / 2;
      const float aside = 3.0f + 1.5f * static_cast<float>(column / 2);
      text += fmt::format(
          "[[part]]\nname = \"crate-{}-{}\"\nbox = [0.8, 0.8]\nfriction = 0.3\ndensity = 0.5\n"
          "position = [{}, {}]\n",
          p, c, x + (column % 2 == 0 ? aside : -aside), 0.41 + 0.82 * (c % 2));
    }
  }
  return text;
}

}  // namespace seam
