#pragma once
/// Edit log of a room in mode oracle. Every peer applies by itself, and in the same tick, the edits
/// that its physics finds. Only edits from outside are sent, with a tick that is still to come.

#include <cstdint>
#include <memory>
#include <optional>

#include "common/sync/policy/policy.h"
#include "server/edits/edit_log.h"

namespace seam {

class OracleEditLog : public EditLog {
 public:
  using EditLog::EditLog;

  /// Returns the pending edits without numbers.
  Batch OrderPending(std::int64_t now_us) override;
  std::optional<EditOrder> NoteApplied(const Edit& edit, std::int64_t now_us) override;
  /// Never: between two pings, peers have applied different numbers of edits.
  bool NeedsRepair(const Ping&, bool) const override { return false; }
};

/// Makes the edit log of a room.
std::unique_ptr<EditLog> MakeEditLog(const Policy& policy, const World& world,
                                     const AuthorityManager& authority, int tick_hz);

}  // namespace seam
