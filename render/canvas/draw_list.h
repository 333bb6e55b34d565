#pragma once
/// What is to be drawn, as triangles in painter's order: shapes, lines with width, text. Pure
/// arithmetic in pixels (origin upper left, y downwards); a Canvas turns it into an Image.
/// Text lies over the shapes of its clip, whichever came first, so that a page is few draw calls.
///
/// Lines are antialiased by distance: every vertex carries how far across the line it lies, and the
/// fragment's coverage is `half + 0.5 - |across|`. So a line costs two triangles and has 256
/// shades, and the outline over a plain filled shape hides the shape's own stairs.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/types.h"
#include "render/canvas/font.h"
#include "render/canvas/image.h"

namespace seam {

/// px
struct Rect {
  float x = 0, y = 0, width = 0, height = 0;
  float right() const { return x + width; }
  float bottom() const { return y + height; }
};

/// One corner of a triangle. In a text batch `across` and `half` are the atlas position in px, in a
/// batch of discs `across` and `along` the way from the centre and `half` the radius. A dot is one
/// vertex; its `across` and `along` are the centre on the page, `half` the radius.
struct Vertex {
  float x = 0, y = 0;
  float across = 0, half = kSolid;  ///< px from the line's middle; half its width
  float along = 0, period = 0;      ///< px; > 0: dashes, < 0: hatching of that period
  Colour colour;
  static constexpr float kSolid = 1e6f;
};

/// What a run of triangles needs: plain colour, coverage by a line, with dashes or hatching or
/// without, or of a disc, or the atlas; or none at all, because an opaque rectangle is cleared.
/// Dots are small discs, of one index each.
enum class BatchKind { kPlain, kShape, kDashed, kDisc, kDot, kText, kClear };

/// A run of triangles, or of dots, of one kind and clip: one draw call.
struct Batch {
  BatchKind kind = BatchKind::kShape;
  Rect clip;
  std::uint32_t first_index = 0, indices = 0;  ///< kText: among the text's indices
  Colour clear;                                ///< kClear: fills `clip`
};

/// How a line looks.
struct Line {
  float width = 1;  ///< px
  Colour colour;
  float dash = 0;  ///< period of the dashes, px; 0: solid
};

enum class Align { kLeft, kCentre, kRight };

/// Reused from frame to frame, so that it stops allocating.
class DrawList {
 public:
  explicit DrawList(const Font& font) : font_(font) {}

  /// Empties the list for a page of this size.
  void Begin(int width_px, int height_px);
  /// Everything from here on is cut at the rectangle, rounded to whole pixels.
  void Clip(const Rect& rect);
  void NoClip();

  /// Convex, in order.
  void Fill(const std::vector<Vec2>& points, Colour colour);
  /// For large areas; its edges are not softened, and a large opaque one has whole pixels.
  void FillRect(const Rect& rect, Colour colour);
  /// An opaque one of whole pixels, however thin: written to memory like a large area where nothing
  /// but such rectangles was drawn before.
  void FillUnder(const Rect& rect, Colour colour);
  /// A quadrilateral whose colour goes from `from` (points 0, 1) to `to` (points 2, 3).
  void FillShaded(const Vec2 points[4], Colour from, Colour to);
  /// Stripes of `period` px over a convex shape, across `normal` (unit) as seen from `origin`.
  void Hatch(const std::vector<Vec2>& points, const Vec2& origin, const Vec2& normal, float period,
             Colour colour);
  void Stroke(const std::vector<Vec2>& points, bool closed, const Line& line);
  /// What follows is no longer drawn as fast as dashes are. Worth it after few dashes, before much
  /// else; dashes and shapes that alternate are better drawn alike.
  void EndDashes();
  void StrokeRect(const Rect& rect, const Line& line);
  void Disc(const Vec2& centre, float radius, Colour colour);
  void Ring(const Vec2& centre, float radius, const Line& line);

  /// `y` is the base line. Returns the width.
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
  /// Where among the opaque rectangles that come first another one can be put: after them, if
  /// nothing else was drawn there.
  std::optional<std::size_t> PlaceUnder(const Rect& rect) const;
  /// Puts one there, and cuts those that it covers and nothing was drawn on.
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
  Batch open_text_;  // text of the present clip
};

/// The points of a circle, as many as it needs to look round.
std::vector<Vec2> CirclePoints(const Vec2& centre, float radius);

}  // namespace seam
