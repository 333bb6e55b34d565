#include "tests/lab/check/scene_check.h"

#include <algorithm>
#include <sstream>

namespace seam {
namespace {

/// By number, from 1; a line of index 0 before the first.
std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines(1);
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool SaysMeant(const std::vector<std::string>& lines, int line) {
  if (line < 0 || static_cast<std::size_t>(line) >= lines.size()) return false;
  const std::string& text = lines[static_cast<std::size_t>(line)];
  const std::size_t comment = text.find('#');
  return comment != std::string::npos && text.find("check: meant", comment) != std::string::npos;
}

}  // namespace

std::vector<Finding> CheckMeaning(const Scene& scene) {
  std::vector<Finding> findings;
  FindWrongSides(scene, &findings);
  FindOverlaps(scene, &findings);
  FindInBricks(scene, &findings);
  FindDegrees(scene, &findings);
  FindRegions(scene, &findings);
  FindUnused(scene, &findings);
  FindJointLimits(scene, &findings);
  FindInScripts(scene, &findings);
  const std::vector<std::string> lines = LinesOf(scene.text);
  const auto meant = [&lines](const Finding& finding) {
    return SaysMeant(lines, finding.line) || SaysMeant(lines, finding.line - 1);
  };
  findings.erase(std::remove_if(findings.begin(), findings.end(), meant), findings.end());
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.line < b.line; });
  return findings;
}

}  // namespace seam
