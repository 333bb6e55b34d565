#include "render/draw/draw_hud.h"

#include <cmath>

#include "render/canvas/palette.h"
#include "render/draw/draw_body.h"
#include "render/playback/peer_colour.h"

namespace seam {
namespace {

/// Draws a small box painted like a body.
void Swatch(DrawList& list, float x, float y, const BodyLook& look) {
  const float scale = list.font().scale();
  const Rect box{x + 0.5f, std::round(y - 10 * scale) + 0.5f, 16 * scale, 11 * scale};
  const std::vector<Vec2> corners{
      {box.x, box.y}, {box.right(), box.y}, {box.right(), box.bottom()}, {box.x, box.bottom()}};
  list.Fill(corners, look.fill);
  if (look.hatched) {
    const float s = 0.70710678f;
    list.Hatch(corners, {box.x, box.y}, {s, s}, 6 * scale, Faded(look.edge, 0.55f));
  }
  list.Stroke(corners, true, {1.2f * scale, look.edge, 0});
}

/// Draws the scale of the heat colours: 1 mm to 1 m. Returns the x of its end.
float HeatBar(DrawList& list, float x, float base, const char* from) {
  const float scale = list.font().scale();
  constexpr int kSteps = 30;
  x += list.Text(x, base, TextStyle::kSmall, from, kInk) + 6 * scale;
  for (int i = 0; i < kSteps; ++i) {
    const float decades = 3 * static_cast<float>(i) / (kSteps - 1);
    list.FillRect({std::round(x), std::round(base - 10 * scale), std::ceil(3 * scale), 11 * scale},
                  HeatColour(1e-3f * std::pow(10.0f, decades)));
    x += 3 * scale;
  }
  x += 6 * scale;
  return x + list.Text(x, base, TextStyle::kSmall, "1 m", kInk);
}

/// Returns the text, cut with an ellipsis if it is wider than `width`.
std::string Fitting(const DrawList& list, TextStyle style, std::string text, float width) {
  if (list.font().Width(style, text) <= width) return text;
  while (!text.empty() && list.font().Width(style, text + "…") > width) {
    do {
      text.pop_back();  // a whole letter of UTF-8
    } while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80);
  }
  return text + "…";
}

}  // namespace

void DrawHeader(DrawList& list, const Rect& area, const std::string& title,
                const std::string& subtitle, std::size_t figures) {
  const float scale = list.font().scale();
  const float upper = area.y + 22 * scale, lower = area.y + 42 * scale;
  const float room = area.width - 104 * scale * static_cast<float>(figures) - 8 * scale;
  list.Text(area.x, upper, TextStyle::kTitle, Fitting(list, TextStyle::kTitle, title, room), kInk);
  list.Text(area.x, lower, TextStyle::kBody, Fitting(list, TextStyle::kBody, subtitle, room),
            kFaintInk);
}

void DrawFigures(DrawList& list, const Rect& area, const std::vector<Figure>& figures) {
  const float scale = list.font().scale();
  float right = area.right();
  for (const auto& [name, value] : figures) {
    list.Text(right, area.y + 17 * scale, TextStyle::kSmall, name, kFaintInk, Align::kRight);
    list.Text(right, area.y + 40 * scale, TextStyle::kNumber, value, kInk, Align::kRight);
    right -= 104 * scale;
  }
}

void DrawLegend(DrawList& list, const Rect& area, const Playback& playback, const WorldLook& look,
                bool impacts) {
  const float scale = list.font().scale();
  const float base = area.y + area.height / 2 + 4 * scale;
  float x = area.x;
  const auto entry = [&](const BodyLook& body, const std::string& text) {
    Swatch(list, x, base, body);
    x += 22 * scale;
    x += list.Text(x, base, TextStyle::kSmall, text, kInk) + 16 * scale;
  };
  const auto gap = [&] {
    list.FillRect({std::round(x), base - 11 * scale, 1, 14 * scale}, kFrame);
    x += 16 * scale;
  };
  const std::vector<int> peers = playback.peers();
  for (std::size_t i = 0; i < peers.size() && i < 6; ++i)
    entry(LookOf(ColourOf(playback, peers[i]), kRoleAuthority), playback.PeerName(peers[i]));
  if (peers.size() > 6) x += list.Text(x, base, TextStyle::kSmall, "…", kInk) + 16 * scale;
  if (look.heat || look.pale) {
    gap();
    x = HeatBar(list, x, base, look.pale ? "apart 1 mm" : "error 1 mm") + 16 * scale;
  } else if (!playback.policy().IsOracle()) {
    gap();
    entry(LookOf(PeerColour(0), kRoleAuthority), "simulated with authority");
    entry(LookOf(PeerColour(0), kRoleSecondary), "secondary copy");
    entry(LookOf(PeerColour(0), kRoleRemote), "remote, displayed");
  }
  if (playback.has_oracle() || impacts) gap();
  if (playback.has_oracle()) {
    const Rect box{x + 0.5f, std::round(base - 10 * scale) + 0.5f, 16 * scale, 11 * scale};
    list.StrokeRect(box, {1.3f * scale, kInk, 5 * scale});
    x += 22 * scale;
    x += list.Text(x, base, TextStyle::kSmall, "oracle: where it should be", kInk) + 16 * scale;
  }
  if (impacts) {
    DrawSpark(list, {x + 7 * scale, base - 4 * scale}, 4 * scale, 4 * scale,
              {1.4f * scale, kSpark, 0});
    x += 20 * scale;
    list.Text(x, base, TextStyle::kSmall, "impact", kInk);
  }
}

std::vector<Rect> CornerAreas(const DrawList& list, const Rect& panel, const CornerTexts& corners) {
  const float scale = list.font().scale();
  const auto width = [&](TextStyle style, const std::string& text) {
    return list.font().Width(style, text) + 10 * scale;
  };
  std::vector<Rect> areas(3);  // upper left, upper right, lower left
  const float mark = corners.swatch.a > 0 ? 22 * scale : 0, top = panel.y + 4 * scale;
  areas[0] = {panel.x + 5 * scale, top, width(TextStyle::kStrong, corners.upper_left) + mark,
              18 * scale};
  const float right = width(TextStyle::kStrong, corners.upper_right);
  if (!corners.upper_right.empty()) {
    const bool beside = areas[0].width + right + 15 * scale <= panel.width;
    areas[1] = {panel.right() - 5 * scale - right, beside ? top : areas[0].bottom(), right,
                18 * scale};
  }
  const float note = width(TextStyle::kSmall, corners.lower_left);
  if (!corners.lower_left.empty() && note <= panel.width - 180 * scale)  // the scale bar
    areas[2] = {panel.x + 5 * scale, panel.bottom() - 20 * scale, note, 15 * scale};
  return areas;
}

void DrawCorners(DrawList& list, const Rect& panel, const CornerTexts& corners) {
  const float scale = list.font().scale(), inset = 5 * scale;
  const std::vector<Rect> areas = CornerAreas(list, panel, corners);
  const float base = panel.y + 17 * scale;
  for (const Rect& area : areas)
    if (area.width > 0) list.FillRect(area, Faded(kPanel, 0.8f));
  float x = areas[0].x + inset;
  if (corners.swatch.a > 0) {
    list.FillRect({x, base - 7 * scale, 16 * scale, 4 * scale}, corners.swatch);
    x += 22 * scale;
  }
  list.Text(x, base, TextStyle::kStrong, corners.upper_left, kInk);
  if (areas[1].width > 0)
    list.Text(areas[1].x + inset, areas[1].y + 13 * scale, TextStyle::kStrong, corners.upper_right,
              kInk);
  if (areas[2].width > 0)
    list.Text(areas[2].x + inset, areas[2].y + 11 * scale, TextStyle::kSmall, corners.lower_left,
              kInk);
}

std::string RunDescription(const Playback& playback) {
  const Room& room = playback.recording().room;
  std::string text = "mode " + room.mode;
  if (!room.reconcile.empty()) text += ", reconcile " + room.reconcile;
  if (!room.predict.empty()) text += ", predict " + room.predict;
  if (room.input_delay_ticks > 0) {
    text += "  ·  inputs delayed by " + std::to_string(room.input_delay_ticks) + " ticks";
  }
  if (!room.impair.empty()) text += "  ·  network " + room.impair;
  text += "  ·  " + std::to_string(room.tick_hz) + " Hz, states at " +
          std::to_string(room.send_hz) + " Hz";
  return text + "  ·  seed " + std::to_string(room.seed);
}

}  // namespace seam
