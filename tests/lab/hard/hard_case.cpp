#include "tests/lab/hard/hard_case.h"

#include <filesystem>

namespace seam {

const std::vector<HardCase>& HardCases() {
  static const std::vector<HardCase> all = [] {
    std::vector<HardCase> cases = ExactCases();
    const std::vector<HardCase> more = InvariantCases();
    cases.insert(cases.end(), more.begin(), more.end());
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
