#pragma once
/// Turns a DrawList into an Image. Only implementations of this interface use a graphics library,
/// so that another backend fits beside canvas_osmesa.cpp.

#include <memory>

#include "render/canvas/draw_list.h"
#include "render/canvas/image.h"

namespace seam {

/// Used by one thread at a time.
class Canvas {
 public:
  virtual ~Canvas() = default;
  /// Draws `list` over `background` and resizes `image` to the list's page. The same list gives
  /// the same bytes in every thread.
  virtual void Draw(const DrawList& list, Colour background, Image* image) = 0;
  /// Draws `list` over a picture. Requires a picture of the size of the list's page.
  virtual void Draw(const DrawList& list, const Image& background, Image* image) = 0;
};

/// Makes a canvas for lists made with `font`. Throws OperatorError when the graphics library fails.
std::unique_ptr<Canvas> MakeCanvas(const Font& font);

}  // namespace seam
