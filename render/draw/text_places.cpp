#include "render/draw/text_places.h"

#include <algorithm>
#include <utility>

namespace seam {

TextPlaces::TextPlaces(const Rect& panel, std::vector<Rect> taken)
    : panel_(panel), taken_(std::move(taken)) {}

bool TextPlaces::IsFree(const Rect& area) const {
  if (area.x < panel_.x || area.y < panel_.y || area.right() > panel_.right() ||
      area.bottom() > panel_.bottom())
    return false;
  return std::none_of(taken_.begin(), taken_.end(), [&](const Rect& other) {
    return area.x < other.right() && other.x < area.right() && area.y < other.bottom() &&
           other.y < area.bottom();
  });
}

std::optional<Rect> TextPlaces::Place(const Rect& wanted) {
  // Shares of width and height, by distance; upwards first, where less is drawn.
  constexpr float kMoves[][2] = {{0, 0},  {0, -1},    {0, 1},      {-0.5f, 0}, {0.5f, 0}, {0, -2},
                                 {-1, 0}, {1, 0},     {-0.5f, -1}, {0.5f, -1}, {0, 2},    {-1, -1},
                                 {1, -1}, {-0.5f, 1}, {0.5f, 1},   {-1, 1},    {1, 1}};
  for (const auto& move : kMoves) {
    const Rect area{wanted.x + move[0] * wanted.width, wanted.y + move[1] * wanted.height,
                    wanted.width, wanted.height};
    if (!IsFree(area)) continue;
    Take(area);
    return area;
  }
  return std::nullopt;
}

}  // namespace seam
