#include "common/sync/edit_order.h"

namespace seam {

static_assert(kEditTextMax == kEditTextBytesMax && kEditKindMax == kEditKindsMax);

EditOrder ToOrder(const Edit& edit) {
  EditOrder order;
  order.kind = static_cast<std::int8_t>(edit.kind);
  order.cause = static_cast<std::int8_t>(edit.cause);
  order.a = static_cast<std::int16_t>(edit.a);
  order.b = static_cast<std::int16_t>(edit.b);
  order.joint = static_cast<std::int16_t>(edit.joint);
  order.player = static_cast<std::int8_t>(edit.player);
  order.x = edit.x;
  order.y = edit.y;
  order.angle = edit.angle;
  order.amount = edit.amount;
  order.text = edit.text;
  return order;
}

Edit ToEdit(const EditOrder& order) {
  Edit edit;
  edit.kind = static_cast<EditKind>(order.kind);
  edit.cause = static_cast<EditCause>(order.cause);
  edit.a = order.a;
  edit.b = order.b;
  edit.joint = order.joint;
  edit.player = order.player;
  edit.x = order.x;
  edit.y = order.y;
  edit.angle = order.angle;
  edit.amount = order.amount;
  edit.text = order.text;
  return edit;
}

}  // namespace seam
