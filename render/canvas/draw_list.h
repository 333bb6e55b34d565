#pragma once
/// A list of drawing primitives, as triangles in painter's order: shapes, lines with width, text.
/// Pure arithmetic in pixels (origin upper left, y downwards); a Canvas turns it into an Image.
/// Text lies over all shapes of its clip rectangle, so that a page needs few draw calls.
///
/// Lines are antialiased by distance: every vertex carries its distance across the line, and the
/// fragment's coverage is `half + 0.5 - |across|`. So a line costs two triangles and has 256
/// shades, and the outline over a plain filled shape hides the shape's jagged edges.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/types.h"
#include "render/canvas/font.h"
#include "render/canvas/image.h"

namespace seam {

/// A rectangle in px.
struct Rect {
  float x = 0, y = 0, width = 0, height = 0;
  float right() const { return x + width; }
  float bottom() const { return y + height; }
};

/// One corner of a triangle. In a text batch `across` and `half` are the atlas position in px, in a
/// batch of discs `across` and `along` the offset from the centre and `half` the radius. A dot is
/// one vertex; its `across` and `along` are the centre on the page, `half` the radius.
struct Vertex {
  float x = 0, y = 0;
  float across = 0, half = kSolid;  ///< px from the line's middle; half its width
  float along = 0, period = 0;      ///< px; > 0: dashes, < 0: hatching of that period
  Colour colour;
  static constexpr float kSolid = 1e6f;
};

/// The shader of a run of triangles: plain colour, antialiased line or shape (kDashed: also dashes
/// and hatching), disc, or text from the atlas. kClear needs none: an opaque rectangle is cleared.
/// Dots are small discs, of one index each.
enum class BatchKind { kPlain, kShape, kDashed, kDisc, kDot, kText, kClear };

/// A run of triangles, or of dots, of one kind and clip: one draw call.
struct Batch {
  BatchKind kind = BatchKind::kShape;
  Rect clip;
  std::uint32_t first_index = 0, indices = 0;  ///< kText: among the text's indices
  Colour clear;                                ///< kClear: fills `clip`
};

/// Style of a line.
struct Line {
  float width = 1;  ///< px
  Colour colour;
  float dash = 0;  ///< period of the dashes, px; 0: solid
};

enum class Align { kLeft, kCentre, kRight };

/// A list that is reused from frame to frame, so that it stops allocating.
class DrawList {
 public:
  explicit DrawList(const Font& font) : font_(font) {}

  /// Empties the list for a page of this size.
  void Begin(int width_px, int height_px);
  /// Clips all that follows to the rectangle, rounded to whole pixels.
  void Clip(const Rect& rect);
  void NoClip();

  /// Fills a convex polygon; points in order around it.
  void Fill(const std::vector<Vec2>& points, Colour colour);
  /// Fills a rectangle without antialiasing. A large opaque one is rounded to whole pixels.
  void FillRect(const Rect& rect, Colour colour);
  /// Fills an opaque rectangle of whole pixels, however thin. Fast where only such rectangles were
  /// drawn before: then the pixels are written to memory directly.
  void FillUnder(const Rect& rect, Colour colour);
  /// Fills a quadrilateral with a gradient from `from` (points 0, 1) to `to` (points 2, 3).
  void FillShaded(const Vec2 points[4], Colour from, Colour to);
  /// Draws stripes of `period` px over a convex shape, across `normal` (unit), with `origin` as the
  /// zero of the pattern.
  void Hatch(const std::vector<Vec2>& points, const Vec2& origin, const Vec2& normal, float period,
             Colour colour);
  void Stroke(const std::vector<Vec2>& points, bool closed, const Line& line);
  /// Ends the batch of dashes, so that following shapes use the faster shader without dashes. Pays
  /// after few dashes and before many other shapes; not where dashes and shapes alternate.
  void EndDashes();
  void StrokeRect(const Rect& rect, const Line& line);
  void Disc(const Vec2& centre, float radius, Colour colour);
  void Ring(const Vec2& centre, float radius, const Line& line);

  /// Draws a text with its base line at `y`. Returns the width.
  float Text(float x, float y, TextStyle style, const std::string& utf8, Colour colour,
             Align align = Align::kLeft);

  const Font& font() const { return font_; }
  const std::vector<Vertex>& vertices() const { return vertices_; }
  const std::vector<std::uint32_t>& indices() const { return indices_; }
  const std::vector<std::uint32_t>& text_indices() const { return text_indices_; }
  std::vector<Batch> Batches() const;
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

 private:
  void Need(BatchKind kind);
  void SetClip(const Rect& rect);
  /// Returns the position after the leading opaque rectangles if nothing else was drawn within
  /// `rect`, else nullopt.
  std::optional<std::size_t> PlaceUnder(const Rect& rect) const;
  /// Inserts an opaque rectangle at `place`, and cuts the rectangles below by the covered part if
  /// nothing was drawn on them.
  void PutUnder(const Rect& rect, Colour colour, std::size_t place);
  void Dot(const Vec2& centre, float radius, Colour colour);
  Rect Cut(const Rect& rect) const;
  void Fan(const std::vector<Vec2>& points, Colour colour);
  std::uint32_t Add(float x, float y, Colour colour);
  void Triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  const Font& font_;
  int width_px_ = 0, height_px_ = 0;
  Rect clip_;
  std::vector<Vertex> vertices_;
  std::vector<std::uint32_t> indices_;
  std::vector<std::uint32_t> text_indices_;
  std::vector<Batch> batches_;
  bool dashes_ended_ = false;
  Batch open_text_;  // text of the current clip
};

/// Returns the corners of a polygon that looks like a circle: its sides are off by less than a
/// tenth of a pixel.
std::vector<Vec2> CirclePoints(const Vec2& centre, float radius);

}  // namespace seam
