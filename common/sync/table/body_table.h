#pragma once
/// Numbers of a replica's bodies and mechanisms, and the list of all columns that are indexed by
/// them. An edit renumbers every column here, in one place and in one order.
///
///   World::Apply --> BodyRemap --> BodyTable::Renumber --> each column by its merge rule,
///                                                          each hook (EditHook)
///
/// Columns (body_column.h, mechanism_column.h) are members of the classes that use them. They
/// register when they are made, so the order is that in which the replica's parts are made.

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "common/physics/world.h"
#include "common/topology/body_remap.h"

namespace seam {

class BodyTable;

/// Part of a table that an edit changes. Registers for its whole life; the table must outlive it.
class TableEntry {
 public:
  TableEntry(const TableEntry&) = delete;
  TableEntry& operator=(const TableEntry&) = delete;

 protected:
  explicit TableEntry(const BodyTable& table);
  virtual ~TableEntry();
  const BodyTable& table() const { return table_; }

 private:
  friend class BodyTable;
  /// Follows an edit. The table's counts are those after it.
  virtual void Renumber(const BodyRemap& change) = 0;

  const BodyTable& table_;
};

class BodyTable {
 public:
  BodyTable(int bodies, int mechanisms) : bodies_(bodies), mechanisms_(mechanisms) {}
  explicit BodyTable(const World& world);
  /// Requires that no entry is left.
  ~BodyTable();
  BodyTable(const BodyTable&) = delete;
  BodyTable& operator=(const BodyTable&) = delete;

  int bodies() const { return bodies_; }
  int mechanisms() const { return mechanisms_; }
  /// Number of Renumber calls. What was noted under another number is of other bodies.
  std::int64_t renumbered() const { return renumbered_; }

  /// Call when World::Apply has returned a change. Renumbers all entries in the order in which they
  /// were made, so an entry may read those made before it.
  void Renumber(const BodyRemap& change);

 private:
  friend class TableEntry;

  int bodies_, mechanisms_;
  std::int64_t renumbered_ = 0;
  // Readers of a const replica have columns too: registering changes no data of the table.
  mutable std::vector<TableEntry*> entries_;
};

/// Calls a function at each edit, after the columns made before it: for what an owner keeps besides
/// columns (lists of bodies, indices, flags).
class EditHook final : public TableEntry {
 public:
  using Call = std::function<void(const BodyRemap&)>;
  EditHook(const BodyTable& table, Call call) : TableEntry(table), call_(std::move(call)) {}

 private:
  void Renumber(const BodyRemap& change) override { call_(change); }

  Call call_;
};

}  // namespace seam
