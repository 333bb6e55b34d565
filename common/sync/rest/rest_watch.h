#pragma once
/// Measures how long each body has been asleep, still, or nearly still. Goes by position, not by
/// speed, because small corrections disturb the speed again and again.

#include <cstdint>

#include "common/physics/world.h"
#include "common/sync/table/body_column.h"

namespace seam {

class RestWatch {
 public:
  /// Both must outlive this.
  RestWatch(const World& world, const BodyTable& table);

  /// Call after a step. Bodies that are not present are skipped; their times must not be asked for.
  void Look();
  /// Ticks for which the body has been asleep; 0: awake.
  std::int64_t asleep(int body) const { return Since(of(body).asleep_since); }
  /// Ticks for which it has stayed within 1 mm and .002 rad of one pose.
  std::int64_t still(int body) const { return Since(of(body).still.since); }
  /// Ticks for which it has stayed within 20 mm and .04 rad of one pose.
  std::int64_t slow(int body) const { return Since(of(body).slow.since); }
  /// Restarts all times. Call when the bodies or the tick were changed.
  void StartAnew();
  void Persist(StateArchive& a);

 private:
  struct Near {
    BodyState pose;
    std::int64_t since = 0;
  };
  struct Track {
    std::int64_t asleep_since = -1;
    std::int64_t looked = 0;  // tick of the last Look that saw it
    Near still, slow;
  };
  const Track& of(int body) const { return tracks_[body]; }
  std::int64_t Since(std::int64_t tick) const { return tick < 0 ? 0 : world_.tick() - tick; }
  void Follow(const BodyState& now, float distance, Near* near) const;

  const World& world_;
  BodyColumn<Track> tracks_;
};

}  // namespace seam
