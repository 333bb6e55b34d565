#pragma once
/// The table that seam-top shows: a line for each room, and where its bytes go.

#include <cstdint>
#include <map>
#include <string>

#include "common/record/load_page.h"

namespace seam {

class TopTable {
 public:
  /// Heard at `now_us`, on any clock that never runs backwards.
  void Take(std::int64_t now_us, const RoomLoad& load);
  bool empty() const { return rooms_.empty(); }
  /// Rates are those between the last two that were heard of a room. A room that has not been heard
  /// for 5 s is left out.
  std::string Text(std::int64_t now_us) const;

 private:
  struct Heard {
    Load before, now;
    std::int64_t before_us = 0, now_us = 0;
    double seconds() const { return static_cast<double>(now_us - before_us) * 1e-6; }
  };
  static std::string Row(const std::string& room, const Heard& heard);

  std::map<std::string, Heard> rooms_;
};

}  // namespace seam
