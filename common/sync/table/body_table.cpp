#include "common/sync/table/body_table.h"

#include <algorithm>

#include "common/base/check.h"

namespace seam {

TableEntry::TableEntry(const BodyTable& table) : table_(table) { table.entries_.push_back(this); }

TableEntry::~TableEntry() {
  // The last one made goes first, as a rule.
  const auto found = std::find(table_.entries_.rbegin(), table_.entries_.rend(), this);
  table_.entries_.erase(std::next(found).base());
}

BodyTable::BodyTable(const World& world)
    : BodyTable(world.body_count(), static_cast<int>(world.composition().mechanisms.size())) {}

BodyTable::~BodyTable() { SEAM_ASSERT(entries_.empty()); }

void BodyTable::Renumber(const BodyRemap& change) {
  bodies_ = static_cast<int>(change.bodies.size());
  mechanisms_ = static_cast<int>(change.mechanisms.size());
  ++renumbered_;
  for (TableEntry* const entry : entries_) entry->Renumber(change);
}

}  // namespace seam
