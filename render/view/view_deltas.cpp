#include "render/view/view_deltas.h"

#include <utility>

namespace seam {

void ViewDeltas::Put(const ViewFrame& frame, bool alone, PageBytes* out) {
  if (alone) known_.clear();
  std::vector<Known> next;
  next.reserve(frame.bodies.size());
  PageBytes gone, changed;
  std::uint64_t gone_count = 0, changed_count = 0;
  int gone_before = -1, changed_before = -1;
  auto old = known_.begin();
  const auto drop = [&] {
    PutUnsigned(&gone, static_cast<std::uint64_t>(old->body.id - gone_before - 1));
    gone_before = old->body.id;
    ++gone_count;
    ++old;
  };
  for (const ViewFrame::Body& body : frame.bodies) {
    while (old != known_.end() && old->body.id < body.id) drop();
    const bool is_new = old == known_.end() || old->body.id != body.id;
    Known now{body, {}};
    bool differs = is_new || old->body.owner != body.owner;
    const bool owner = differs;
    std::array<std::int64_t, 3> rest{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t predicted = is_new ? 0 : old->body.pose[k] + old->step[k];
      rest[k] = body.pose[k] - predicted;
      now.step[k] = is_new ? 0 : body.pose[k] - old->body.pose[k];
      differs = differs || rest[k] != 0;
    }
    if (!is_new) ++old;
    next.push_back(now);
    if (!differs) continue;
    const auto gap = static_cast<std::uint64_t>(body.id - changed_before - 1);
    changed_before = body.id;
    ++changed_count;
    PutUnsigned(&changed, 2 * gap + (owner ? 1 : 0));
    if (owner) PutUnsigned(&changed, static_cast<std::uint64_t>(body.owner));
    for (const std::int64_t value : rest) PutSigned(&changed, value);
  }
  while (old != known_.end()) drop();
  known_ = std::move(next);
  PutUnsigned(out, static_cast<std::uint64_t>(frame.peer));
  PutSigned(out, frame.tick);
  PutUnsigned(out, static_cast<std::uint64_t>(frame.world));
  PutUnsigned(out, alone ? 1 : 0);
  PutUnsigned(out, gone_count);
  out->insert(out->end(), gone.begin(), gone.end());
  PutUnsigned(out, changed_count);
  out->insert(out->end(), changed.begin(), changed.end());
}

}  // namespace seam
