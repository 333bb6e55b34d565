#include "tests/lab/exact/front.h"

#include <fmt/format.h>

#include "tests/lab/report/physics_view.h"

namespace seam {

std::string CaseLines(const std::vector<HardCase>& cases) {
  std::string lines;
  for (const HardCase& hard : cases) {
    const bool converged = hard.truth == Truth::kConverged;
    lines += fmt::format("{}, {:g} s: {}, {}{}\n", hard.name, hard.seconds, hard.about, hard.unit,
                         converged ? " (its scripts have no exact(t))" : "");
  }
  return lines;
}

std::string FrontLines(const std::string& path) {
  std::string lines;
  for (const PhysicsCase& c : ViewPhysics(CsvTable::Load(path))) {
    const std::vector<std::size_t> front = ParetoFront(PhysicsTrials(c.all));
    lines += fmt::format("{}: {}\n", c.name,
                         front.empty()
                             ? "no front, no setting held: " + c.all.front().failure
                             : "the front, of " + std::to_string(c.all.size()) + " settings tried");
    if (!front.empty()) lines += fmt::format("{:>10} {:>10}\n", "cost", c.unit);
    for (const std::size_t i : front) {
      const PhysicsRun& run = c.all[i];
      const char* role = c.stock && run.row == c.stock->row   ? "  (stock)"
                         : c.scene && run.row == c.scene->row ? "  (the scene's own)"
                                                              : "";
      lines +=
          fmt::format("{:10.3f} {:10.4g}  {}{}\n", run.cost_ratio, run.error, run.setting, role);
    }
  }
  return lines;
}

}  // namespace seam
