#pragma once
/// The table of seam-top: a line for each room, and the traffic by kind.

#include <cstdint>
#include <map>
#include <string>

#include "common/record/load_page.h"

namespace seam {

class TopTable {
 public:
  /// Adds a load received at `now_us`, on any clock that never runs backwards.
  void Take(std::int64_t now_us, const RoomLoad& load);
  bool empty() const { return rooms_.empty(); }
  /// Returns the table. Rates are those between a room's last two loads. Leaves out rooms without a
  /// load for 5 s.
  std::string Text(std::int64_t now_us) const;

 private:
  struct Heard {
    Load before, now;
    Connections before_connections, connections;
    std::int64_t before_us = 0, now_us = 0;
    double seconds() const { return static_cast<double>(now_us - before_us) * 1e-6; }
  };
  static std::string LinesText(const Heard& heard);
  static std::string Row(const std::string& room, const Heard& heard);

  std::map<std::string, Heard> rooms_;
};

}  // namespace seam
