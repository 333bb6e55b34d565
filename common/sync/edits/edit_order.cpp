#include "common/sync/edits/edit_order.h"

#include "common/base/state_archive.h"
#include "common/codec/persist_message.h"

namespace seam {
EditOrder ToOrder(const Edit& edit) {
  EditOrder order;
  order.kind = static_cast<std::int8_t>(edit.what.index());
  order.cause = static_cast<std::int8_t>(edit.cause);
  std::visit(
      Overloaded{[](const std::monostate&) {}, [&](const BreakEdit& e) { order.joint = e.joint; },
                 [&](const BondEdit& e) {
                   order.a = e.a;
                   order.b = e.b;
                   order.joint = static_cast<std::int32_t>(e.cause);
                   order.value = {e.position.x(), e.position.y(), e.angle, e.strength};
                 },
                 [&](const InsertEdit& e) { order.text = e.text; },
                 [&](const RemoveEdit& e) {
                   order.a = e.part;
                   order.joint = e.left_bounds ? 1 : -1;
                 },
                 [&](const FreeEdit& e) { order.a = e.part; },
                 [&](const PushEdit& e) {
                   order.a = e.part;
                   order.value = {e.impulse.x(), e.impulse.y(), e.turn, e.limp};
                 },
                 [&](const SeatEdit& e) {
                   order.a = e.seat;
                   order.player = static_cast<std::int16_t>(e.player);
                 },
                 [&](const BlastEdit& e) {
                   order.value = {e.centre.x(), e.centre.y(), e.speed, e.radius, e.impulse};
                 }},
      edit.what);
  return order;
}

Edit ToEdit(const EditOrder& order) {
  const Vec2 xy(order.value[0], order.value[1]);
  const float angle = order.value[2], amount = order.value[3];
  AnyEdit what;
  switch (order.kind) {
    case 1: what = BreakEdit{order.joint}; break;
    case 2: {
      const auto cause = order.joint == 0   ? BondCause::kConnectors
                         : order.joint == 1 ? BondCause::kGroup
                         : order.joint == 2 ? BondCause::kGrip
                                            : BondCause::kGiven;
      what = BondEdit{order.a, order.b, xy, angle, amount, cause};
      break;
    }
    case 3: what = InsertEdit{order.text}; break;
    case 4: what = RemoveEdit{order.a, order.joint == 1}; break;
    case 5: what = FreeEdit{order.a}; break;
    case 6: what = PushEdit{order.a, xy, angle, amount}; break;
    case 7: what = SeatEdit{order.a, order.player}; break;
    case 8: what = BlastEdit{xy, amount, angle, order.value.size() > 4 ? order.value[4] : 0}; break;
    default: break;
  }
  return Edit(what, static_cast<EditCause>(order.cause));
}

void Persist(StateArchive& a, Edit* edit) {
  EditOrder order = a.reading() ? EditOrder() : ToOrder(*edit);
  PersistMessage(a, &order, kMessageBytesMax);
  if (a.reading()) *edit = a.ok() ? ToEdit(order) : Edit();
}

}  // namespace seam
