#pragma once
/// One page of a sequence: header, panels with worlds, legend, strip. MakePage decides the content
/// once; drawing it for a moment is a function of page and time alone.

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
  int peer = 0;                        ///< the displayed view
  int error_peer = -1;                 ///< the peer of the caption's error; -1: all views
  std::string caption;
  Colour swatch{0, 0, 0, 0};       ///< colour of its curve; alpha 0: none
  const Playback* over = nullptr;  ///< borrowed; drawn over it, coloured by the distance
  /// Ticks of visible corrections, ascending (FindCorrections); empty: unknown.
  std::optional<std::vector<std::int64_t>> corrections = std::nullopt;
};

/// An enlarged view of a contact in a corner of each panel while it happens.
struct Inset {
  double from_s = 0, to_s = 0;  ///< time of its display
  CameraPath camera;            ///< on the contact's bodies
};

struct Page {
  int width_px = 1280, height_px = 720;
  std::string title, subtitle;
  std::vector<Panel> panels;
  std::vector<Curve> curves;
  double from_s = 0, to_s = 1;              ///< the drawn range
  double strip_from_s = 0, strip_to_s = 1;  ///< the strip's axis
  /// The camera of all panels; none: each scene's own camera.
  std::shared_ptr<const CameraPath> camera;
  std::optional<Inset> inset;
  std::vector<std::pair<std::string, std::string>> about;  ///< goes into each picture file
  WorldLook look;  ///< the layers; peer and tick are set by panel and moment
};

/// Peer number of `--view all`.
constexpr int kViewAll = -1;

/// Returns what damaged recordings lack, to stand before a subtitle; "" if all are whole.
std::string DamageText(const std::vector<Playback>& playbacks);

/// Makes a page of one recording: one peer's view, or all peers' side by side.
Page MakePage(const Playback& playback, int peer);

/// Makes a page of several recordings at the same time, one panel and one curve each.
Page MakeComparison(const std::vector<Playback>& playbacks, int peer);

/// Makes a page with two recordings in one panel: the second over the first, coloured by the
/// distance.
Page MakeDifference(const std::vector<Playback>& playbacks, int peer);

/// Sets the camera of all panels, with an inset about the main contact unless bodies were named.
/// The path depends on the whole recordings, not on the drawn range. Throws OperatorError for an
/// unknown part.
void SetCamera(const CameraWish& wish, const std::vector<Playback>& playbacks, Page* page);

/// Returns the viewport of a panel with this area at a moment.
Viewport ViewportOf(const Page& page, const Panel& panel, const Rect& area, double now_s);

/// Draws the constant content of a page: title, legend, the strip's axis and pale curves.
void DrawStill(DrawList& list, const Page& page);
/// Draws the changing content, to be laid over a picture of the constant one.
void DrawMoving(DrawList& list, const Page& page, double now_s);
/// Draws the constant and the changing content.
void DrawPage(DrawList& list, const Page& page, double now_s);

/// Draws `moments` moments, evenly spaced from page.from_s to page.to_s, each as one small panel
/// for every panel of the page. Requires moments > 0.
void DrawSheet(DrawList& list, const Page& page, int moments);

/// Returns the texts of the recordings, for the letters that a font needs beyond Latin-1.
std::string TextsOf(const std::vector<Playback>& playbacks);

/// Returns the size of text and lines relative to a page of 1280x720.
float ScaleOf(int width_px, int height_px);

}  // namespace seam
