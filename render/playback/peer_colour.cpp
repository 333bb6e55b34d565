#include "render/playback/peer_colour.h"

#include <string>
#include <vector>

namespace seam {

Colour ColourOf(const Playback& playback, int peer) {
  const int player = playback.PlayerOf(peer);
  const std::vector<std::string>& colours = playback.player_colours();
  if (player < 0 || static_cast<std::size_t>(player) >= colours.size()) return PeerColour(peer);
  const std::string& text = colours[static_cast<std::size_t>(player)];
  if (text.empty()) return PeerColour(peer);
  if (text[0] != '#') return PeerColour(std::stoi(text));  // checked when the scene was read
  const auto rgb = static_cast<unsigned>(std::stoul(text.substr(1), nullptr, 16));
  return {static_cast<std::uint8_t>(rgb >> 16 & 0xff), static_cast<std::uint8_t>(rgb >> 8 & 0xff),
          static_cast<std::uint8_t>(rgb & 0xff), 255};
}

}  // namespace seam
