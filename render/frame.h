#pragma once
/// One page of a sequence: header, panels with worlds, legend, strip. What a page shows is decided
/// once (MakePage); drawing it for a moment is a function of page and time alone.

#include <string>
#include <vector>

#include "render/canvas/viewport.h"
#include "render/draw/draw_strip.h"
#include "render/playback/playback.h"

namespace seam {

/// One world on the page.
struct Panel {
  const Playback* playback = nullptr;  ///< borrowed
  int peer = 0;                        ///< whose view
  int error_peer = -1;                 ///< whose error the caption states; -1: all views'
  std::string caption;
  Colour swatch{0, 0, 0, 0};  ///< of its curve; alpha 0: none
};

struct Page {
  int width_px = 1280, height_px = 720;
  std::string title, subtitle;
  std::vector<Panel> panels;
  std::vector<Curve> curves;
  double from_s = 0, to_s = 1;  ///< the strip's axis
  bool cull = true;
};

/// Peer numbers of `--view`.
constexpr int kViewAll = -1;

/// A page of one recording: one peer's view, or all peers' side by side.
Page MakePage(const Playback& playback, int peer);

/// A page of several recordings in step, one panel and one curve each.
Page MakeComparison(const std::vector<Playback>& playbacks, int peer);

void DrawPage(DrawList& list, const Page& page, double now_s);

/// Letters beyond Latin-1 that the recordings' texts need.
std::string TextsOf(const std::vector<Playback>& playbacks);

/// How much larger than 1280x720 text and lines are.
float ScaleOf(int width_px, int height_px);

}  // namespace seam
