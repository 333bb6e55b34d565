#pragma once
/// Tests of scenes' titles: one sentence and one numeric test for each, applied to every peer's
/// screen. docs/scenes.md has the sentences, seam-lab titles the table.

#include <string>
#include <vector>

#include "tests/lab/titles/screen.h"

namespace seam {

/// The expectations of one screen; keeps the first that was missed.
class Claims {
 public:
  /// `what`: the words for a miss.
  void Expect(bool kept, const std::string& what) {
    if (!kept && missed_.empty()) missed_ = what;
  }
  /// The same for `value` in [least, most]; the words get the value.
  void Between(double value, double least, double most, const std::string& what);
  void AtLeast(double value, double least, const std::string& what);

  /// Empty: every expectation was met.
  const std::string& missed() const { return missed_; }

 private:
  std::string missed_;
};

struct Title {
  const char* scene;     ///< name of the file in scenes/
  const char* sentence;  ///< the promise, in numbers
  void (*judge)(const Screen& screen, Claims* claims);
  int players = 0;    ///< that join, in the tests, 0: all
  double test_s = 0;  ///< of the tests' sessions, 0: the scene's own
};

/// All of them, in the order of docs/scenes.md.
const std::vector<Title>& Titles();
/// Throws OperatorError for a scene that has none.
const Title& TitleOf(const std::string& scene);

/// Returns "" if the server and every client kept the title's promise; otherwise the first peer
/// that did not, and its first miss.
std::string MissedBy(const Title& title, const Recording& recording);

// Each in its own file, and named in titles.cpp.
void JudgeTitanic(const Screen& screen, Claims* claims);
void JudgeHarbour(const Screen& screen, Claims* claims);
void JudgeRegatta(const Screen& screen, Claims* claims);
void JudgeGluehouse(const Screen& screen, Claims* claims);
void JudgeFoundation(const Screen& screen, Claims* claims);
void JudgeSkyline(const Screen& screen, Claims* claims);
void JudgeRagdolls(const Screen& screen, Claims* claims);
void JudgeObstacle(const Screen& screen, Claims* claims);
void JudgeFreight(const Screen& screen, Claims* claims);
void JudgeCrane(const Screen& screen, Claims* claims);
void JudgeConveyor(const Screen& screen, Claims* claims);
void JudgeDockside(const Screen& screen, Claims* claims);
void JudgeTracks(const Screen& screen, Claims* claims);
void JudgePlayground(const Screen& screen, Claims* claims);
void JudgeBattlefield(const Screen& screen, Claims* claims);
void JudgeSwarm(const Screen& screen, Claims* claims);
void JudgeDerby(const Screen& screen, Claims* claims);
void JudgePile(const Screen& screen, Claims* claims);
void JudgeRelay8(const Screen& screen, Claims* claims);

}  // namespace seam
