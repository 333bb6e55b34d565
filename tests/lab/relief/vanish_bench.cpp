/// A holder that vanishes, beside its bars.

#include <fmt/format.h>

#include <algorithm>

#include "tests/lab/relief/bar_rows.h"
#include "tests/lab/relief/benches.h"
#include "tests/lab/relief/vanish.h"

namespace seam {

TextTable ReliefVanishBench(bool quick) {
  const int seeds = quick ? 2 : 10;
  std::vector<BarRow> rows;
  for (const VanishKind& kind : VanishKinds()) {
    Vanished worst;
    int valid = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      const Vanished now = Vanish(kind, static_cast<std::uint64_t>(seed));
      valid += now.held && now.looked > 0 ? 1 : 0;
      worst.stands_s = std::max(worst.stands_s, now.stands_s);
      worst.jump_m = std::max(worst.jump_m, now.jump_m);
    }
    const auto add = [&](BarRow row) {
      row.given = fmt::format("it had the authority, and was seen on: {} of {}", valid, seeds);
      row.valid = valid == seeds;
      rows.push_back(std::move(row));
    };
    if (!kind.driven) {
      add(AtMost(fmt::format("{}: what it had stands", kind.name), worst.stands_s, 0.3, "s"));
    }
    add(AtMost(fmt::format("{}: jumps", kind.name), worst.jump_m, 0.5, "m"));
  }
  return TableOf(
      "vanish", "A holder that vanishes", rows,
      fmt::format("The worst of {} sessions of each room, in which it is killed or cut "
                  "off, over networks of 20 to 100 ms one way and up to 10 % loss; in "
                  "the views of the server and of another player. A jump is by how much the way "
                  "of a tick differs from that of the one before: a blow makes one, too.",
                  seeds));
}

}  // namespace seam
