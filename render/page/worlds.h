#pragma once
/// Shapes of a recording's bodies, as the JSON of a review page: each body once, and each world (a
/// revision of the scene) as a list of bodies, joints, waters, bricks and regions.

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/measure/revisions.h"
#include "render/page/column.h"
#include "render/playback/playback.h"

namespace seam {

/// The worlds that a recording's views show.
class PageWorlds {
 public:
  /// `playback` must outlive this.
  explicit PageWorlds(const Playback& playback);

  /// Returns the index of the world after `edits` edits; creates it at the first call. Edits that a
  /// growing recording has received since are known.
  int IndexOf(int edits);
  /// Returns {"bodies":[...],"worlds":[...],"moved":[...],...}; call it last.
  std::string Json() const;
  /// True if TakeNewJson has something.
  bool has_new() const { return worlds_taken_ < worlds_.size(); }
  /// Returns the number of worlds so far.
  int count() const { return static_cast<int>(worlds_.size()); }
  /// Returns the bodies and worlds made since the last call, with their first indices:
  /// {"body":0,"bodies":[...],"world":0,"worlds":[...]}.
  std::string TakeNewJson();

 private:
  int Pool(const std::string& body);

  const Playback& playback_;
  std::size_t edits_ = 0;  // of the recording, as revisions_ knows them
  std::unique_ptr<const RevisionHistory> revisions_;
  std::size_t bodies_taken_ = 0, worlds_taken_ = 0;
  std::map<int, int> index_of_key_;
  std::vector<std::string> bodies_, worlds_;
  std::map<std::string, int> pooled_;
};

/// Encodes a scene's bricks as few rectangles, units of 5 cm: their number, then as first
/// differences all left edges, all lower edges, all widths and all heights.
PageBytes EncodeBricks(const Playback& playback);

/// A region of a player, or its buffer zone: a polygon, m.
struct PageRegion {
  int peer = 0;
  bool zone = false;  ///< the region and its buffer zone
  std::string name;   ///< the player's
  std::vector<Vec2> corners;
};

/// Returns all regions that a page shows; the only definition of their shape. Empty where the mode
/// has none.
std::vector<PageRegion> RegionsOfPage(const Playback& playback);

}  // namespace seam
