#pragma once
/// The camera of a sequence: the displayed box of the world at each moment, the same for all panels
/// of a page, and smoothed against jitter.

#include <string>
#include <vector>

#include "render/playback/moments.h"
#include "render/playback/moving_box.h"

namespace seam {

/// Requested camera.
struct CameraWish {
  enum class Kind {
    kFit,     ///< moving bodies, as large as the panel allows
    kScene,   ///< the area of the action, or a box about the part that the scene's camera follows
    kFixed,   ///< a place and a height
    kFollow,  ///< a part, with a box of `height` around it
  };
  Kind kind = Kind::kFit;
  std::string part;   ///< kFollow: name of a part, or of a player for the player's vehicle
  Vec2 centre{0, 0};  ///< kFixed, m
  float height = 0;   ///< kFixed, kFollow: visible height, m; 0: the scene's box
  float zoom = 1;     ///< magnification, for all kinds
  /// kFit: bodies to fit (assembly ids), with those jointed to them; empty: all moving ones.
  std::set<PartId> bodies;
};

/// The camera over time.
class CameraPath {
 public:
  /// Computes the path for from_s..to_s from all views. Throws OperatorError for a part that the
  /// scene does not have.
  CameraPath(const std::vector<CameraView>& views, const CameraWish& wish, double from_s,
             double to_s);

  /// Returns the visible box at a moment, m.
  WorldBox At(double s) const;

 private:
  double from_s_ = 0;
  std::vector<WorldBox> boxes_;  // kSamplesPerSecond apart
  float zoom_ = 1;
};

/// Returns the area that a picture of the whole action shows: the scene's [camera], or without one
/// all that a camera that fits what moves shows in from_s..to_s.
WorldBox ActionArea(const std::vector<CameraView>& views, double from_s, double to_s);

}  // namespace seam
