#include "common/sync/edit_order.h"

namespace seam {

EditOrder ToOrder(const Edit& edit) {
  EditOrder order;
  order.kind = static_cast<std::int8_t>(edit.kind);
  order.cause = static_cast<std::int8_t>(edit.cause);
  order.a = static_cast<std::int16_t>(edit.a);
  order.b = static_cast<std::int16_t>(edit.b);
  order.joint = edit.joint;
  order.player = static_cast<std::int16_t>(edit.player);
  order.value = {edit.x, edit.y, edit.angle, edit.amount};
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
  edit.x = order.value[0];
  edit.y = order.value[1];
  edit.angle = order.value[2];
  edit.amount = order.value[3];
  edit.text = order.text;
  return edit;
}

}  // namespace seam
