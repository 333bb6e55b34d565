#pragma once
/// Which part of the world a sequence shows at each moment: the same for all panels of a page, and
/// without a jitter of its own.

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
  /// A body's outlines at a pose.
  void Add(const BodyShapes& body, const Pose& pose);
  void Add(const WorldBox& other);
};

/// What was asked of the camera.
struct CameraWish {
  enum class Kind {
    kFit,     ///< what moves, as large as the panel allows
    kScene,   ///< the scene's own box, or about the part that its camera follows
    kFixed,   ///< a place and a height
    kFollow,  ///< a part, with as much around it as `height` says
  };
  Kind kind = Kind::kFit;
  std::string part;   ///< kFollow: by its name, or a player's: the player's vehicle
  Vec2 centre{0, 0};  ///< kFixed, m
  float height = 0;   ///< kFixed, kFollow: m that are visible; 0: the scene's box
  float zoom = 1;     ///< of all kinds: so many times larger
  /// kFit: only these bodies are fitted (assembly ids); empty: all that move.
  std::set<PartId> bodies;
};

/// One world of the page.
struct CameraView {
  const Playback* playback = nullptr;
  int peer = 0;
};

class CameraPath {
 public:
  /// Looks at from_s..to_s of all views once. Throws OperatorError for a part that the scene does
  /// not have.
  CameraPath(const std::vector<CameraView>& views, const CameraWish& wish, double from_s,
             double to_s);

  /// What is to be visible at a moment, m.
  WorldBox At(double s) const;

 private:
  double from_s_ = 0;
  std::vector<WorldBox> boxes_;  // kSamplesPerSecond apart
  float zoom_ = 1;
};

/// Bodies that move by more than a little in from_s..to_s, in truth or in one of the views.
std::set<PartId> MovingBodies(const std::vector<CameraView>& views, double from_s, double to_s);

/// The box of those bodies at a moment, in truth and in all views. Empty where none is there.
WorldBox BoxOf(const std::vector<CameraView>& views, const std::set<PartId>& bodies, double s);

}  // namespace seam
