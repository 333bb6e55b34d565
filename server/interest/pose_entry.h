#pragma once
/// Copies an entry between messages that list bodies by id, epoch and pose (Rest, ExactStates).

#include <cstddef>

namespace seam {

/// Appends id, epoch and pose of the i-th body of `from` to `to`.
template <class Message>
void AddPose(const Message& from, std::size_t i, Message* to) {
  to->id.push_back(from.id[i]);
  to->epoch.push_back(from.epoch[i]);
  to->x.push_back(from.x[i]);
  to->y.push_back(from.y[i]);
  to->angle.push_back(from.angle[i]);
}

}  // namespace seam
