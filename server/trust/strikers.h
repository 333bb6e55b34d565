#pragma once
/// Bounds what collisions can have done to a body: by the speeds and masses of all bodies that it
/// may have met within kSeconds, directly or through others (its island).
///
///   speed after a collision  <=  v + 2 max v_i        v_i: speeds of the island's other
///   mechanisms,
///                                                     and of parts on a path that may meet it
///   force on a joint         <=  2 sum m_i v_i / h + weight      h: duration of a substep

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "common/physics/world.h"
#include "common/stages/kinematic.h"
#include "common/sync/reach/zones.h"

namespace seam {

class Strikers {
 public:
  /// `world` must outlive this. `speed_of`: a body's greatest speed of late, m/s.
  Strikers(const World& world, std::function<float(int body)> speed_of);

  /// Greatest speed that collisions with other mechanisms can have added to the body's, m/s.
  float AddedSpeed(int body);
  /// Greatest load that the joint can have borne, N.
  float LoadOf(const Joint& joint);

  /// Look-ahead and look-back, s: as long as a few messages may be lost.
  static constexpr float kSeconds = 0.5f;

 private:
  void Look();
  /// Adds the speeds of parts on a path (ImposedMotions) to the islands that they may meet.
  void AddMovers(const std::vector<MovingBox>& boxes);

  const World& world_;
  const std::function<float(int)> speed_of_;
  std::int64_t looked_ = -1;  // tick and edits of the islands
  int revision_ = -1;
  std::vector<int> island_;  // rebuilt by Look, by mechanism
  /// The fastest mechanism of an island, and the speed of the fastest of its others.
  struct Fastest {
    int mechanism = -1;
    float speed = 0, of_others = 0;  // m/s
    void Note(int its, float its_speed);
  };
  std::vector<Fastest> fastest_;  // by island
  std::optional<ImposedMotions> movers_;  // of that revision
  std::vector<float> momentum_, mass_;
};

}  // namespace seam
