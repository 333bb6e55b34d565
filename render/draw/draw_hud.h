#pragma once
/// The text around the panels: header with title and figures, legend, captions of panels.

#include <string>
#include <utility>
#include <vector>

#include "render/canvas/viewport.h"
#include "render/draw/draw_world.h"
#include "render/playback/playback.h"

namespace seam {

/// A figure of the header: name and value.
using Figure = std::pair<std::string, std::string>;

/// Draws title and subtitle on the left, with room for `figures` figures on the right.
void DrawHeader(DrawList& list, const Rect& area, const std::string& title,
                const std::string& subtitle, std::size_t figures);
/// Draws the figures on the right of the same area, the first outermost.
void DrawFigures(DrawList& list, const Rect& area, const std::vector<Figure>& figures);

/// Draws the legend of the colours and patterns that the playback has, as many names of peers as
/// there is room for. `look`: the layers.
void DrawLegend(DrawList& list, const Rect& area, const Playback& playback, const WorldLook& look,
                bool impacts);

/// The texts in a panel's corners.
struct CornerTexts {
  std::string upper_left, upper_right;
  Colour swatch{0, 0, 0, 0};  ///< colour of the panel's curve in a comparison; alpha 0: none
  std::string lower_left;     ///< drawn if there is room beside the scale bar
};

/// Returns the areas that DrawCorners draws into.
std::vector<Rect> CornerAreas(const DrawList& list, const Rect& panel, const CornerTexts& corners);
void DrawCorners(DrawList& list, const Rect& panel, const CornerTexts& corners);

/// Returns the settings of a recording's run: mode, reconciler, network, seed, rate.
std::string RunDescription(const Playback& playback);

}  // namespace seam
