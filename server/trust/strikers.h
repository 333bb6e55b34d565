#pragma once
/// Bounds what collisions can have done to a body: by the speeds and masses of all bodies that it
/// may have met within kSeconds, directly or through others (its island).
///
///   speed after a collision  <=  2 max v_i            v_i: speeds of the island's bodies
///   force on a joint         <=  2 sum m_i v_i / h + weight      h: duration of a substep

#include <cstdint>
#include <functional>
#include <vector>

#include "common/physics/world.h"

namespace seam {

class Strikers {
 public:
  /// `world` must outlive this. `speed_of`: a body's greatest speed of late, m/s.
  Strikers(const World& world, std::function<float(int body)> speed_of);

  /// Greatest speed that a collision can have given to the body, m/s.
  float SpeedOf(int body);
  /// Greatest load that the joint can have borne, N.
  float LoadOf(const Joint& joint);

  /// Look-ahead and look-back, s: as long as a few messages may be lost.
  static constexpr float kSeconds = 0.5f;

 private:
  void Look();

  const World& world_;
  const std::function<float(int)> speed_of_;
  std::int64_t looked_ = -1;  // tick and edits of the islands
  int revision_ = -1;
  std::vector<int> island_;     // rebuilt by Look, by mechanism
  std::vector<float> fastest_;  // by island, m/s
  std::vector<float> momentum_, mass_;
};

}  // namespace seam
