#include "common/measure/outside_edits.h"

#include <algorithm>

#include "common/sync/edits/edit_order.h"

namespace seam {

OutsideEdits::OutsideEdits(const Scene& scene)
    : scene_(scene), parts_(scene.parts.size()), joints_(scene.joints.size()) {}

void OutsideEdits::Add(const Recording& recording) {
  const auto fresh = recording.edits.lower_bound(next_);
  if (fresh == recording.edits.end()) return;
  recorded_ = std::make_unique<const RevisionHistory>(scene_, recording);
  for (auto edit = fresh; edit != recording.edits.end(); ++edit) {
    const auto& [number, order] = *edit;
    next_ = number + 1;
    if (order.cause != static_cast<std::int8_t>(EditCause::kOutside)) continue;
    by_tick_[order.tick].push_back({number, ToEdit(order)});
  }
}

std::vector<Edit> OutsideEdits::Take(std::int64_t tick, const Scene& now) {
  std::vector<Edit> edits;
  while (!by_tick_.empty() && by_tick_.begin()->first <= tick) {
    for (const auto& [number, edit] : by_tick_.begin()->second) {
      edits.push_back(edit);
      Translate(number, now, &edits.back());
    }
    by_tick_.erase(by_tick_.begin());
  }
  return edits;
}

PartId OutsideEdits::PartOf(const Scene& then, PartId part, const Scene& now) const {
  if (part < 0 || static_cast<std::size_t>(part) < parts_) return part;
  if (static_cast<std::size_t>(part) >= then.parts.size()) return -1;
  const std::string& name = then.parts[static_cast<std::size_t>(part)].name;
  for (std::size_t p = now.parts.size(); p-- > parts_;) {
    if (!now.parts[p].gone && now.parts[p].name == name) return now.parts[p].id;
  }
  return -1;
}

/// Returns the corresponding joint. Joints made at run time have no lasting name, so the match is
/// by kind and the two parts.
std::int32_t OutsideEdits::JointOf(const Scene& then, std::int32_t joint, const Scene& now) const {
  if (joint < 0 || static_cast<std::size_t>(joint) < joints_) return joint;
  if (static_cast<std::size_t>(joint) >= then.joints.size()) return -1;
  const Joint& wanted = then.joints[static_cast<std::size_t>(joint)];
  const PartId a = PartOf(then, wanted.a, now), b = PartOf(then, wanted.b, now);
  for (std::size_t j = now.joints.size(); j-- > joints_;) {
    const Joint& found = now.joints[j];
    if (found.gone || found.kind != wanted.kind) continue;
    if ((found.a == a && found.b == b) || (found.a == b && found.b == a)) {
      return static_cast<std::int32_t>(j);
    }
  }
  return -1;
}

/// Translates ids of parts and joints made at run time to the oracle's own.
void OutsideEdits::Translate(int number, const Scene& now, Edit* edit) const {
  const auto part = [&](PartId* id) {
    if (*id < 0 || static_cast<std::size_t>(*id) < parts_) return;
    *id = PartOf(recorded_->At(number)->scene(), *id, now);
  };
  std::visit(Overloaded{[&](BreakEdit& e) {
                          if (e.joint < 0 || static_cast<std::size_t>(e.joint) < joints_) return;
                          e.joint = JointOf(recorded_->At(number)->scene(), e.joint, now);
                        },
                        [&](BondEdit& e) {
                          part(&e.a);
                          part(&e.b);
                        },
                        [&](RemoveEdit& e) { part(&e.part); }, [&](FreeEdit& e) { part(&e.part); },
                        [&](PushEdit& e) { part(&e.part); }, [](auto&) {}},
             edit->what);
}

}  // namespace seam
