/// Replica: edits, and bodies that split and merge by them. What is known of a body (its past, what
/// was heard of it, its pose in the view) is carried over to what it becomes.

#include "common/sync/edits/edit_order.h"
#include "common/sync/replica.h"

namespace seam {

bool Replica::Queue(const EditOrder& order) {
  if (config_.mode == Mode::kOracle) {
    const Edit edit = ToEdit(order);
    if (edit.cause == EditCause::kOutside) appointed_[order.tick].push_back(edit);
    return true;
  }
  if (order.number != revision() + static_cast<int>(queued_.size())) return false;
  queued_.push_back(ToEdit(order));
  return true;
}

void Replica::QueueAppointed() {
  while (!appointed_.empty() && appointed_.begin()->first <= tick()) {
    for (Edit& edit : appointed_.begin()->second) queued_.push_back(std::move(edit));
    appointed_.erase(appointed_.begin());
  }
}

void Replica::ApplyEdits() {
  while (has_queued()) ApplyNextEdit();
}

std::optional<BodyRemap> Replica::ApplyNextEdit() {
  const Edit edit = queued_.front();
  queued_.erase(queued_.begin());
  std::optional<BodyRemap> change = world_.Apply({edit});
  ForgetProposals(edit);
  rest_.NoteEdit();
  if (change) {
    Remap(*change);
  } else {
    corrector_.FollowRoles();  // who sits in a seat decides what is predicted
  }
  return change;
}

void Replica::ForgetProposals(const Edit& edit) {
  if (edit.As<BreakEdit>() != nullptr) proposals_.Forget(KeyOf(edit));
  const RemoveEdit* removed = edit.As<RemoveEdit>();
  const std::vector<Joint>& joints = world_.scene().joints;
  for (std::size_t j = 0; removed != nullptr && j < joints.size(); ++j) {
    if (joints[j].a != removed->part && joints[j].b != removed->part) continue;
    proposals_.Forget(KeyOf(Edit(BreakEdit{static_cast<std::int32_t>(j)})));
  }
}

void Replica::Remap(const BodyRemap& change) {
  memory_.Remap(change);
  display_.Remap(change);
  roles_.Remap(change.mechanisms);
  replay_.Forget();  // its barriers are of other bodies
  rest_.Remap(change);
  corrector_.FollowRoles();
}

}  // namespace seam
