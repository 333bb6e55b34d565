#pragma once
/// One page of a sequence: header, panels with worlds, legend, strip. What a page shows is decided
/// once (MakePage); drawing it for a moment is a function of page and time alone.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/canvas/viewport.h"
#include "render/draw/draw_strip.h"
#include "render/draw/draw_world.h"
#include "render/playback/camera.h"
#include "render/playback/playback.h"

namespace seam {

/// One world on the page.
struct Panel {
  const Playback* playback = nullptr;  ///< borrowed
  int peer = 0;                        ///< whose view
  int error_peer = -1;                 ///< whose error the caption states; -1: all views'
  std::string caption;
  Colour swatch{0, 0, 0, 0};       ///< of its curve; alpha 0: none
  const Playback* over = nullptr;  ///< borrowed; drawn over it, by how far it is from it
  /// Ticks of those that a person sees, ascending (FindCorrections); empty: unknown.
  std::optional<std::vector<std::int64_t>> corrections = std::nullopt;
};

/// A contact that is drawn once more, larger, in a corner of each panel while it happens.
struct Inset {
  double from_s = 0, to_s = 0;  ///< while it is shown
  CameraPath camera;            ///< on the contact's bodies
};

struct Page {
  int width_px = 1280, height_px = 720;
  std::string title, subtitle;
  std::vector<Panel> panels;
  std::vector<Curve> curves;
  double from_s = 0, to_s = 1;              ///< what is drawn
  double strip_from_s = 0, strip_to_s = 1;  ///< the strip's axis
  /// What the panels show; none: each scene's own camera.
  std::shared_ptr<const CameraPath> camera;
  std::optional<Inset> inset;
  std::vector<std::pair<std::string, std::string>> about;  ///< goes into each picture file
  WorldLook look;  ///< its layers; whose view and when is said by panel and moment
};

/// Peer numbers of `--view`.
constexpr int kViewAll = -1;

/// A page of one recording: one peer's view, or all peers' side by side.
Page MakePage(const Playback& playback, int peer);

/// A page of several recordings in step, one panel and one curve each.
Page MakeComparison(const std::vector<Playback>& playbacks, int peer);

/// Two recordings in one panel: the second over the first, coloured by the distance.
Page MakeDifference(const std::vector<Playback>& playbacks, int peer);

/// Lets all panels follow what was wished for, with an inset about the main contact unless bodies
/// were named. The path depends on the whole recordings, not on the part that is drawn. Throws
/// OperatorError for a part that is not there.
void SetCamera(const CameraWish& wish, const std::vector<Playback>& playbacks, Page* page);

/// What a panel of these measures shows of the world at a moment.
Viewport ViewportOf(const Page& page, const Panel& panel, const Rect& area, double now_s);

/// What of a page is the same at each moment: title, legend, the strip's axis and pale curves.
void DrawStill(DrawList& list, const Page& page);
/// All else, over a picture of it.
void DrawMoving(DrawList& list, const Page& page, double now_s);
/// Both together.
void DrawPage(DrawList& list, const Page& page, double now_s);

/// So many moments from page.from_s to page.to_s, evenly, each as a small panel (of a page of
/// several panels: one of each). Requires moments > 0.
void DrawSheet(DrawList& list, const Page& page, int moments);

/// Letters beyond Latin-1 that the recordings' texts need.
std::string TextsOf(const std::vector<Playback>& playbacks);

/// How much larger than 1280x720 text and lines are.
float ScaleOf(int width_px, int height_px);

}  // namespace seam
