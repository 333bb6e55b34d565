#pragma once
/// Places for the texts of a panel, so that no text covers another.

#include <optional>
#include <vector>

#include "render/canvas/viewport.h"

namespace seam {

/// The areas of a panel that texts take, in pixels.
class TextPlaces {
 public:
  /// `taken`: areas that are no longer free. Areas outside the panel are never given.
  TextPlaces(const Rect& panel, std::vector<Rect> taken);

  /// Marks an area as no longer free, whether it was free or not.
  void Take(const Rect& area) { taken_.push_back(area); }

  /// Takes and returns the free area of this size that is nearest to `wanted`, at most two of its
  /// heights up or down or one of its widths aside; nullopt if there is none.
  std::optional<Rect> Place(const Rect& wanted);

 private:
  bool IsFree(const Rect& area) const;

  Rect panel_;
  std::vector<Rect> taken_;
};

}  // namespace seam
