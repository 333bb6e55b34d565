#pragma once
/// An entry of the messages that list bodies by id, epoch and pose (Rest, ExactStates).

#include <cstddef>

namespace seam {

/// Who the i-th body of a message is and where, added to `to`.
template <class Message>
void AddPose(const Message& from, std::size_t i, Message* to) {
  to->id.push_back(from.id[i]);
  to->epoch.push_back(from.epoch[i]);
  to->x.push_back(from.x[i]);
  to->y.push_back(from.y[i]);
  to->angle.push_back(from.angle[i]);
}

}  // namespace seam
