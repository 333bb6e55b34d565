#include "render/draw/draw_hud.h"

#include <algorithm>
#include <cmath>

#include "render/canvas/palette.h"
#include "render/draw/draw_body.h"
#include "render/playback/peer_colour.h"

namespace seam {
namespace {

/// Writes the legend from left to right, or measures it.
class LegendLine {
 public:
  /// `draws` false: x() moves, and nothing else happens.
  LegendLine(DrawList& list, const Rect& area, bool draws)
      : list_(list),
        scale_(list.font().scale()),
        base_(area.y + area.height / 2 + 4 * scale_),
        x_(area.x),
        draws_(draws) {}

  float x() const { return x_; }
  void Gap() {
    if (draws_) list_.FillRect({std::round(x_), base_ - 11 * scale_, 1, 14 * scale_}, kFrame);
    x_ += 16 * scale_;
  }
  void Text(const std::string& text) { x_ += Write(text) + 16 * scale_; }
  /// A small box painted like a body, and what that is.
  void Body(const BodyLook& look, const std::string& text) {
    if (draws_) Swatch(look);
    x_ += 22 * scale_;
    Text(text);
  }
  void Oracle(const std::string& text) {
    if (draws_) list_.StrokeRect(Box(), {1.3f * scale_, kInk, 5 * scale_});
    x_ += 22 * scale_;
    Text(text);
  }
  void Impact(const std::string& text) {
    const Vec2 at{x_ + 7 * scale_, base_ - 4 * scale_};
    if (draws_) DrawSpark(list_, at, 4 * scale_, 4 * scale_, {1.4f * scale_, kSpark, 0});
    x_ += 20 * scale_;
    Text(text);
  }
  /// The scale of the heat colours: 1 mm to 1 m.
  void Heat(const std::string& from) {
    constexpr int kSteps = 30;
    x_ += Write(from) + 6 * scale_;
    for (int i = 0; i < kSteps; ++i, x_ += 3 * scale_) {
      const float decades = 3 * static_cast<float>(i) / (kSteps - 1);
      const Rect step{std::round(x_), std::round(base_ - 10 * scale_), std::ceil(3 * scale_),
                      11 * scale_};
      if (draws_) list_.FillRect(step, HeatColour(1e-3f * std::pow(10.0f, decades)));
    }
    x_ += 6 * scale_;
    Text("1 m");
  }

 private:
  float Write(const std::string& text) {
    if (!draws_) return list_.font().Width(TextStyle::kSmall, text);
    return list_.Text(x_, base_, TextStyle::kSmall, text, kInk);
  }
  Rect Box() const {
    return {x_ + 0.5f, std::round(base_ - 10 * scale_) + 0.5f, 16 * scale_, 11 * scale_};
  }
  void Swatch(const BodyLook& look) {
    const Rect box = Box();
    const std::vector<Vec2> corners{
        {box.x, box.y}, {box.right(), box.y}, {box.right(), box.bottom()}, {box.x, box.bottom()}};
    list_.Fill(corners, look.fill);
    if (look.hatched) {
      const float s = 0.70710678f;
      list_.Hatch(corners, {box.x, box.y}, {s, s}, 6 * scale_, Faded(look.edge, 0.55f));
    }
    list_.Stroke(corners, true, {1.2f * scale_, look.edge, 0});
  }

  DrawList& list_;
  const float scale_, base_;
  float x_;
  const bool draws_;
};

/// Writes the colours of the first `names` peers.
void WriteNames(LegendLine& line, const Playback& playback, std::size_t names) {
  const std::vector<int> peers = playback.peers();
  for (std::size_t i = 0; i < names; ++i) {
    line.Body(LookOf(ColourOf(playback, peers[i]), kRoleAuthority), playback.PeerName(peers[i]));
  }
  if (names < peers.size()) line.Text("… +" + std::to_string(peers.size() - names));
}

/// Writes what patterns mean, in many words or in few.
void WritePatterns(LegendLine& line, const Playback& playback, const WorldLook& look, bool impacts,
                   bool many) {
  if (look.heat || look.pale) {
    line.Gap();
    line.Heat(look.pale ? "apart 1 mm" : "error 1 mm");
  } else if (!playback.policy().IsOracle()) {
    line.Gap();
    line.Body(LookOf(PeerColour(0), kRoleAuthority),
              many ? "simulated with authority" : "authority");
    line.Body(LookOf(PeerColour(0), kRoleSecondary), many ? "secondary copy" : "copy");
    line.Body(LookOf(PeerColour(0), kRoleRemote), many ? "remote, displayed" : "remote");
  }
  if (playback.has_oracle() || impacts) line.Gap();
  if (playback.has_oracle()) line.Oracle(many ? "oracle: where it should be" : "oracle");
  if (impacts) line.Impact("impact");
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

/// Cuts the upper texts to the panel's width.
CornerTexts FittingCorners(const DrawList& list, const Rect& panel, CornerTexts corners) {
  const float scale = list.font().scale(), room = panel.width - 20 * scale;
  const float mark = corners.swatch.a > 0 ? 22 * scale : 0;
  corners.upper_left = Fitting(list, TextStyle::kStrong, corners.upper_left, room - mark);
  corners.upper_right = Fitting(list, TextStyle::kStrong, corners.upper_right, room);
  return corners;
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
  // Patterns cannot be guessed; names stand at the bodies too. So names make room, down to three,
  // then words of the patterns, then all names.
  const std::size_t most = std::min<std::size_t>(playback.peers().size(), 6);
  const float end = area.right() + 16 * list.font().scale();  // the space behind the last entry
  const auto fits = [&](std::size_t names, bool many) {
    LegendLine line(list, area, false);
    WriteNames(line, playback, names);
    WritePatterns(line, playback, look, impacts, many);
    return line.x() <= end;
  };
  std::size_t names = most;
  bool many = true;
  while (names > std::min<std::size_t>(most, 3) && !fits(names, many)) --names;
  if (!fits(names, many)) {
    names = most;
    many = false;
    while (names > 0 && !fits(names, many)) --names;
  }
  LegendLine line(list, area, true);
  WriteNames(line, playback, names);
  WritePatterns(line, playback, look, impacts, many);
}

std::vector<Rect> CornerAreas(const DrawList& list, const Rect& panel, const CornerTexts& all) {
  const float scale = list.font().scale();
  const CornerTexts corners = FittingCorners(list, panel, all);
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
    if (areas[1].bottom() > panel.bottom() && !beside) areas[1] = {};
  }
  const float note = width(TextStyle::kSmall, corners.lower_left);
  if (!corners.lower_left.empty() && note <= panel.width - 180 * scale)  // the scale bar
    areas[2] = {panel.x + 5 * scale, panel.bottom() - 20 * scale, note, 15 * scale};
  return areas;
}

void DrawCorners(DrawList& list, const Rect& panel, const CornerTexts& all) {
  const float scale = list.font().scale(), inset = 5 * scale;
  const CornerTexts corners = FittingCorners(list, panel, all);
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
