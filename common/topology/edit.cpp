#include "common/topology/edit.h"

#include <utility>

namespace seam {

Edit::Edit(AnyEdit edit, EditCause why) : what(std::move(edit)), cause(why) {}

EditKey KeyOf(const Edit& edit) {
  EditKey key = {static_cast<std::int32_t>(edit.what.index()), -1, -1, -1};
  std::visit(Overloaded{[&](const BreakEdit& e) { key[1] = e.joint; },
                        [&](const BondEdit& e) {
                          key[1] = static_cast<std::int32_t>(e.cause);
                          key[2] = e.a;
                          key[3] = e.b;
                        },
                        [&](const RemoveEdit& e) { key[2] = e.part; },
                        [&](const FreeEdit& e) { key[2] = e.part; },
                        [&](const PushEdit& e) { key[2] = e.part; },
                        [&](const SeatEdit& e) { key[2] = e.seat; }, [](const auto&) {}},
             edit.what);
  return key;
}

}  // namespace seam
