#pragma once
/// The camera of a sequence: the displayed box of the world at each moment, the same for all panels
/// of a page, and smoothed against jitter.

#include <string>
#include <vector>

#include "render/canvas/viewport.h"
#include "render/playback/moments.h"

namespace seam {

/// A box of the world, m.
struct WorldBox {
  Vec2 min{1e9f, 1e9f}, max{-1e9f, -1e9f};

  bool empty() const { return min.x() > max.x(); }
  Vec2 size() const { return max - min; }
  Vec2 centre() const { return (min + max) / 2; }
  void Add(const Vec2& p, float radius);
  /// Adds a body's outlines at a pose.
  void Add(const BodyShapes& body, const Pose& pose);
  void Add(const WorldBox& other);
};

/// Requested camera.
struct CameraWish {
  enum class Kind {
    kFit,     ///< moving bodies, as large as the panel allows
    kScene,   ///< the scene's own box, or one about the part that its camera follows
    kFixed,   ///< a place and a height
    kFollow,  ///< a part, with a box of `height` around it
  };
  Kind kind = Kind::kFit;
  std::string part;   ///< kFollow: name of a part, or of a player for the player's vehicle
  Vec2 centre{0, 0};  ///< kFixed, m
  float height = 0;   ///< kFixed, kFollow: visible height, m; 0: the scene's box
  float zoom = 1;     ///< magnification, for all kinds
  /// kFit: bodies to fit (assembly ids); empty: all moving ones.
  std::set<PartId> bodies;
};

/// One world of the page.
struct CameraView {
  const Playback* playback = nullptr;
  int peer = 0;
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

/// Returns the bodies that move noticeably in from_s..to_s, in the oracle or in one of the views.
std::set<PartId> MovingBodies(const std::vector<CameraView>& views, double from_s, double to_s);

/// Returns the box of `bodies` at a moment, in the oracle and in all views. Empty without any.
WorldBox BoxOf(const std::vector<CameraView>& views, const std::set<PartId>& bodies, double s);

}  // namespace seam
