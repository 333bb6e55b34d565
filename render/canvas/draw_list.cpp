#include "render/canvas/draw_list.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/base/geometry.h"

namespace seam {
namespace {

bool Same(const Rect& a, const Rect& b) {
  return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

bool Meet(const Rect& a, const Rect& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

/// Returns the least rectangle around the part of `rect` outside `cover`; without width if empty.
Rect LeftOver(const Rect& rect, const Rect& cover) {
  const bool high = cover.y <= rect.y && cover.bottom() >= rect.bottom();
  const bool wide = cover.x <= rect.x && cover.right() >= rect.right();
  float x0 = rect.x, x1 = rect.right(), y0 = rect.y, y1 = rect.bottom();
  if (high && cover.x <= x0) x0 = std::max(x0, std::min(x1, cover.right()));
  if (high && cover.right() >= x1) x1 = std::min(x1, std::max(x0, cover.x));
  if (wide && cover.y <= y0) y0 = std::max(y0, std::min(y1, cover.bottom()));
  if (wide && cover.bottom() >= y1) y1 = std::min(y1, std::max(y0, cover.y));
  return y1 > y0 && x1 > x0 ? Rect{x0, y0, x1 - x0, y1 - y0} : Rect{};
}

Vec2 LeftOf(const Vec2& from, const Vec2& to) {
  const Vec2 d = to - from;
  const float length = d.norm();
  return length > 0 ? Vec2(-d.y() / length, d.x() / length) : Vec2(0, 0);
}

/// Returns the corner normal with projection 1 on both neighbours' normals; limited at sharp
/// corners, where it would be long.
Vec2 Mitre(const Vec2& before, const Vec2& after) {
  const Vec2 sum = before + after;
  const float square = sum.squaredNorm();
  constexpr float kSharp = 0.25f;  // a mitre four times the width: beyond, a blunt corner
  if (square < kSharp) return after;
  return sum * (2 / square);
}

}  // namespace

void DrawList::Begin(int width_px, int height_px) {
  width_px_ = width_px;
  height_px_ = height_px;
  vertices_.clear();
  indices_.clear();
  text_indices_.clear();
  batches_.clear();
  dashes_ended_ = false;
  open_text_ = Batch();
  open_text_.kind = BatchKind::kText;
  NoClip();
}

void DrawList::Clip(const Rect& rect) {
  clip_ = {0, 0, static_cast<float>(width_px_), static_cast<float>(height_px_)};
  SetClip(Cut(rect));
}

void DrawList::NoClip() {
  SetClip({0, 0, static_cast<float>(width_px_), static_cast<float>(height_px_)});
}

void DrawList::SetClip(const Rect& rect) {
  clip_ = rect;
  if (Same(open_text_.clip, rect)) return;
  if (open_text_.indices > 0) batches_.push_back(open_text_);
  open_text_.clip = rect;
  open_text_.first_index = static_cast<std::uint32_t>(text_indices_.size());
  open_text_.indices = 0;
}

std::vector<Batch> DrawList::Batches() const {
  std::vector<Batch> all = batches_;
  if (open_text_.indices > 0) all.push_back(open_text_);
  return all;
}

Rect DrawList::Cut(const Rect& rect) const {
  const float x0 = std::max(clip_.x, std::round(rect.x));
  const float y0 = std::max(clip_.y, std::round(rect.y));
  const float x1 = std::min(clip_.right(), std::round(rect.right()));
  const float y1 = std::min(clip_.bottom(), std::round(rect.bottom()));
  return {x0, y0, std::max(0.0f, x1 - x0), std::max(0.0f, y1 - y0)};
}

void DrawList::Need(BatchKind kind) {
  const bool goes_on = !batches_.empty() && !dashes_ended_ && Same(batches_.back().clip, clip_);
  if (goes_on) {
    const BatchKind open = batches_.back().kind;
    if (open == kind || (open == BatchKind::kDashed && kind == BatchKind::kShape)) return;
  }
  dashes_ended_ = false;
  Batch batch;
  batch.kind = kind;
  batch.clip = clip_;
  batch.first_index = static_cast<std::uint32_t>(indices_.size());
  batches_.push_back(batch);
}

void DrawList::EndDashes() {
  dashes_ended_ = !batches_.empty() && batches_.back().kind == BatchKind::kDashed;
}

std::uint32_t DrawList::Add(float x, float y, Colour colour) {
  Vertex vertex;
  vertex.x = x;
  vertex.y = y;
  vertex.colour = colour;
  vertices_.push_back(vertex);
  return static_cast<std::uint32_t>(vertices_.size() - 1);
}

void DrawList::Triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  indices_.insert(indices_.end(), {a, b, c});
  batches_.back().indices += 3;
}

void DrawList::Fill(const std::vector<Vec2>& points, Colour colour) {
  if (points.size() < 3 || colour.a == 0) return;
  Need(BatchKind::kShape);
  Fan(points, colour);
}

void DrawList::Fan(const std::vector<Vec2>& points, Colour colour) {
  const auto first = static_cast<std::uint32_t>(vertices_.size());
  for (const Vec2& p : points) Add(p.x(), p.y(), colour);
  for (std::uint32_t i = 2; i < points.size(); ++i) Triangle(first, first + i - 1, first + i);
}

void DrawList::FillRect(const Rect& r, Colour colour) {
  if (r.width <= 0 || r.height <= 0) return;
  constexpr float kLarge = 5000;  // px^2: below, a separate draw call would cost more
  const bool large = r.width * r.height > kLarge;
  if (colour.a == 255 && large) {
    const Rect whole = Cut(r);
    if (whole.width <= 0 || whole.height <= 0) return;
    PutUnder(whole, colour, PlaceUnder(whole).value_or(batches_.size()));
    return;
  }
  // llvmpipe draws plain rectangles fastest, if they are worth a draw call.
  constexpr float kPlain = 400;  // px^2
  Need(r.width * r.height > kPlain ? BatchKind::kPlain : BatchKind::kShape);
  Fan({{r.x, r.y}, {r.right(), r.y}, {r.right(), r.bottom()}, {r.x, r.bottom()}}, colour);
}

void DrawList::FillUnder(const Rect& rect, Colour colour) {
  SEAM_ASSERT(colour.a == 255);
  const Rect whole = Cut(rect);
  if (whole.width <= 0 || whole.height <= 0) return;
  if (const std::optional<std::size_t> place = PlaceUnder(whole)) {
    PutUnder(whole, colour, *place);
  } else {
    FillRect(whole, colour);
  }
}

std::optional<std::size_t> DrawList::PlaceUnder(const Rect& rect) const {
  std::size_t place = 0;
  while (place < batches_.size() && batches_[place].kind == BatchKind::kClear) ++place;
  for (std::size_t i = place; i < batches_.size(); ++i) {
    if (Meet(batches_[i].clip, rect)) return std::nullopt;
  }
  if (open_text_.indices > 0 && Meet(open_text_.clip, rect)) return std::nullopt;
  return place;
}

void DrawList::PutUnder(const Rect& rect, Colour colour, std::size_t place) {
  Batch fill;
  fill.kind = BatchKind::kClear;
  fill.clip = rect;
  fill.clear = colour;
  std::size_t first = place;
  while (first > 0 && batches_[first - 1].kind == BatchKind::kClear) --first;
  batches_.insert(batches_.begin() + static_cast<std::ptrdiff_t>(place), fill);
  for (std::size_t i = place; i > first; --i) {
    Rect& under = batches_[i - 1].clip;
    under = LeftOver(under, fill.clip);
    if (under.width > 0) continue;
    batches_.erase(batches_.begin() + static_cast<std::ptrdiff_t>(i - 1));
  }
}

void DrawList::FillShaded(const Vec2 points[4], Colour from, Colour to) {
  Need(BatchKind::kPlain);
  const auto first = static_cast<std::uint32_t>(vertices_.size());
  for (int i = 0; i < 4; ++i) Add(points[i].x(), points[i].y(), i < 2 ? from : to);
  Triangle(first, first + 1, first + 2);
  Triangle(first, first + 2, first + 3);
}

void DrawList::Hatch(const std::vector<Vec2>& points, const Vec2& origin, const Vec2& normal,
                     float period, Colour colour) {
  if (points.size() < 3 || colour.a == 0) return;
  Need(BatchKind::kDashed);
  const auto first = static_cast<std::uint32_t>(vertices_.size());
  Fan(points, colour);
  for (std::size_t i = 0; i < points.size(); ++i) {
    vertices_[first + i].along = (points[i] - origin).dot(normal);
    vertices_[first + i].period = -period;
  }
}

void DrawList::Stroke(const std::vector<Vec2>& points, bool closed, const Line& line) {
  const std::size_t n = points.size();
  if (n < 2 || line.colour.a == 0) return;
  Need(line.dash != 0 ? BatchKind::kDashed : BatchKind::kShape);
  const float half = line.width / 2;
  const float reach = half + 0.5f;  // half a pixel further than the line for its soft edge
  const std::size_t segments = closed ? n : n - 1;
  float along = 0;
  for (std::size_t k = 0; k <= segments; ++k) {
    const std::size_t i = k % n;
    const bool has_before = closed || i > 0;
    const bool has_after = closed || i + 1 < n;
    const Vec2 before = has_before ? LeftOf(points[(i + n - 1) % n], points[i]) : Vec2(0, 0);
    const Vec2 after = has_after ? LeftOf(points[i], points[(i + 1) % n]) : before;
    const Vec2 out = Mitre(has_before ? before : after, after) * reach;
    if (k > 0) along += (points[i] - points[(k - 1) % n]).norm();
    for (int side = 1; side >= -1; side -= 2) {
      const auto s = static_cast<float>(side);
      const std::uint32_t v =
          Add(points[i].x() + s * out.x(), points[i].y() + s * out.y(), line.colour);
      vertices_[v].across = s * reach;
      vertices_[v].half = half;
      vertices_[v].along = along;
      vertices_[v].period = line.dash;
    }
    if (k == 0) continue;
    const auto last = static_cast<std::uint32_t>(vertices_.size());
    Triangle(last - 4, last - 3, last - 2);
    Triangle(last - 3, last - 2, last - 1);
  }
}

void DrawList::StrokeRect(const Rect& r, const Line& line) {
  Stroke({{r.x, r.y}, {r.right(), r.y}, {r.right(), r.bottom()}, {r.x, r.bottom()}}, true, line);
}

void DrawList::Disc(const Vec2& centre, float radius, Colour colour) {
  if (colour.a == 0) return;
  // OpenGL skips a point with its centre off the page, and limits the size of points.
  constexpr float kDotRadiusMax = 50;
  const bool on_page = centre.x() >= 0 && centre.x() <= static_cast<float>(width_px_) &&
                       centre.y() >= 0 && centre.y() <= static_cast<float>(height_px_);
  if (on_page && radius <= kDotRadiusMax) return Dot(centre, radius, colour);
  Need(BatchKind::kDisc);
  const float reach = radius + 0.5f;  // half a pixel further for its soft edge
  const auto first = static_cast<std::uint32_t>(vertices_.size());
  for (int corner = 0; corner < 4; ++corner) {
    const float x = corner == 1 || corner == 2 ? reach : -reach, y = corner >= 2 ? reach : -reach;
    const std::uint32_t v = Add(centre.x() + x, centre.y() + y, colour);
    vertices_[v].across = x;
    vertices_[v].along = y;
    vertices_[v].half = radius;
  }
  Triangle(first, first + 1, first + 2);
  Triangle(first, first + 2, first + 3);
}

void DrawList::Dot(const Vec2& centre, float radius, Colour colour) {
  Need(BatchKind::kDot);
  const std::uint32_t v = Add(centre.x(), centre.y(), colour);
  vertices_[v].across = centre.x();
  vertices_[v].along = centre.y();
  vertices_[v].half = radius;
  indices_.push_back(v);
  ++batches_.back().indices;
}

void DrawList::Ring(const Vec2& centre, float radius, const Line& line) {
  Stroke(CirclePoints(centre, radius), true, line);
}

float DrawList::Text(float x, float y, TextStyle style, const std::string& utf8, Colour colour,
                     Align align) {
  const float width = font_.Width(style, utf8);
  float pen = align == Align::kLeft ? x : align == Align::kRight ? x - width : x - width / 2;
  const float base = std::round(y);
  for (std::uint32_t codepoint : Codepoints(utf8)) {
    const Glyph& g = font_.Find(style, codepoint);
    const float x0 = std::round(pen) + static_cast<float>(g.left);
    const float y0 = base - static_cast<float>(g.top);
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    for (int corner = 0; corner < 4; ++corner) {
      const auto right = static_cast<float>(corner == 1 || corner == 2 ? g.width : 0);
      const auto down = static_cast<float>(corner >= 2 ? g.height : 0);
      const std::uint32_t v = Add(x0 + right, y0 + down, colour);
      vertices_[v].across = static_cast<float>(g.atlas_x) + right;
      vertices_[v].half = static_cast<float>(g.atlas_y) + down;
    }
    text_indices_.insert(text_indices_.end(),
                         {first, first + 1, first + 2, first, first + 2, first + 3});
    open_text_.indices += 6;
    pen += g.advance;
  }
  return width;
}

std::vector<Vec2> CirclePoints(const Vec2& centre, float radius) {
  // The sagitta of a side stays below a tenth of a pixel.
  const float sides = 3.1416f / std::acos(1 - std::min(0.5f, 0.1f / std::max(radius, 0.2f)));
  const int n = std::clamp(static_cast<int>(std::ceil(sides)), 8, 200);
  std::vector<Vec2> points;
  points.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const float a = 2 * kPiFloat * static_cast<float>(i) / static_cast<float>(n);
    points.emplace_back(centre.x() + radius * std::cos(a), centre.y() + radius * std::sin(a));
  }
  return points;
}

}  // namespace seam
