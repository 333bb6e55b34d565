#pragma once
/// Columns of a few bodies on a table of their own, for tests without a world.

#include <utility>

#include "common/sync/table/body_table.h"

namespace seam {

/// A `Columns` for `bodies` bodies and no mechanism.
template <class Columns>
class OwnTable : private BodyTable, public Columns {
 public:
  template <class... More>
  explicit OwnTable(int bodies, More&&... more)
      : BodyTable(bodies, 0),
        Columns(static_cast<const BodyTable&>(*this), std::forward<More>(more)...) {}
};

}  // namespace seam
