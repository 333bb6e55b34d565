#include "server/edits/oracle_edit_log.h"

#include <algorithm>

namespace seam {
namespace {

/// Delay of edits from outside (a seat, a rule, a script), s; all peers apply them at the same
/// tick. A peer that gets its order later than this is behind.
constexpr double kAppointSeconds = 0.25;

}  // namespace

EditLog::Batch OracleEditLog::OrderPending(std::int64_t now_us) {
  Batch batch;
  batch.numbered = false;
  const auto ahead = static_cast<std::int64_t>(kAppointSeconds * tick_hz());
  for (const Edit& edit : TakePending()) {
    EditOrder order = ToOrder(edit);
    order.utime = now_us;
    order.tick = std::max<std::int64_t>(0, world().tick()) + ahead;
    order.number = 0;  // no repair (BeginAnew)
    batch.orders.push_back(order);
  }
  return batch;
}

std::optional<EditOrder> OracleEditLog::NoteApplied(const Edit& edit, std::int64_t now_us) {
  EditOrder order = ToOrder(edit);
  order.utime = now_us;
  order.tick = world().tick();
  order.number = NextNumber();
  EditLog::NoteApplied(edit, now_us);
  return order;
}

std::unique_ptr<EditLog> MakeEditLog(const Policy& policy, const World& world,
                                     const AuthorityManager& authority, int tick_hz) {
  if (policy.AppliesFoundEdits()) return std::make_unique<OracleEditLog>(world, authority, tick_hz);
  return std::make_unique<EditLog>(world, authority, tick_hz);
}

}  // namespace seam
