#pragma once
/// The text around the panels: header with title and figures, legend, captions of panels.

#include <string>
#include <utility>
#include <vector>

#include "render/canvas/viewport.h"
#include "render/draw/draw_world.h"
#include "render/playback/playback.h"

namespace seam {

/// A figure of the header: a faint name over a bold value.
using Figure = std::pair<std::string, std::string>;

/// Title and line below it on the left, with room for so many figures on the right.
void DrawHeader(DrawList& list, const Rect& area, const std::string& title,
                const std::string& subtitle, std::size_t figures);
/// On the right of the same area, the first outermost.
void DrawFigures(DrawList& list, const Rect& area, const std::vector<Figure>& figures);

/// Which colours and patterns mean what, as far as the playback has them.
/// `look`: which layers.
void DrawLegend(DrawList& list, const Rect& area, const Playback& playback, const WorldLook& look,
                bool impacts);

/// In a panel's upper corners; `swatch` marks the curve of a comparison (alpha 0: none).
void DrawCaption(DrawList& list, const Rect& panel, const std::string& left,
                 const std::string& right, Colour swatch);

/// In a panel's lower left corner, if there is room beside the scale bar.
void DrawNote(DrawList& list, const Rect& panel, const std::string& text);

/// Everything a recording says about its run: mode, reconciler, network, seed, rate.
std::string RunDescription(const Playback& playback);

}  // namespace seam
