#include "tests/lab/hard/hard_case.h"

#include <algorithm>
#include <filesystem>

namespace seam {

const std::vector<HardCase>& HardCases() {
  static const std::vector<HardCase> all = [] {
    std::vector<HardCase> cases = ExactCases();
    for (const auto& more : {InvariantCases(), MechanismCases()}) {
      cases.insert(cases.end(), more.begin(), more.end());
    }
    std::sort(cases.begin(), cases.end(), [](const HardCase& a, const HardCase& b) {
      const bool judged_a = a.truth == Truth::kInvariant, judged_b = b.truth == Truth::kInvariant;
      return judged_a != judged_b ? judged_b : a.name < b.name;
    });
    return cases;
  }();
  return all;
}

Scene LoadHardScene(const HardCase& hard, const std::string& folder) {
  const bool is_path = std::filesystem::path(hard.scene).extension() == ".toml";
  Scene scene = LoadScene(is_path ? hard.scene : folder + "/" + hard.scene + ".toml");
  if (hard.adjust) hard.adjust(&scene);
  return scene;
}

Solver StockSolver() {
  Solver stock;
  stock.weld_joints = true;
  stock.joints = JointSolving::kIterative;
  return stock;
}

}  // namespace seam
