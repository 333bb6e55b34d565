#pragma once
/// The exact answer that a scene carries: what its script's functions exact(t) and measured(t) say.
/// docs/lab.md is their reference.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/measure/energy.h"
#include "server/script/script.h"
#include "tests/lab/exact/displacement.h"
#include "tests/lab/exact/judged_room.h"

namespace seam {

/// What is right at one moment: poses of parts, or a number.
struct ExactMoment {
  std::vector<std::pair<PartId, WantedPose>> poses;  ///< ascending; empty: a number
  double value = 0;
};

class SceneTruth {
 public:
  /// Loads the scene's scripts. `file`: what errors begin with. Throws OperatorError "file:line:
  /// what" for a script that cannot be loaded, for two that say exact(t), and for an exact or a
  /// measured that is no function or stands alone.
  SceneTruth(const Scene& scene, const std::string& file);
  ~SceneTruth();
  SceneTruth(const SceneTruth&) = delete;
  SceneTruth& operator=(const SceneTruth&) = delete;

  /// Whether a script of the scene has a function exact(t). The functions below require it.
  bool found() const { return script_ != nullptr; }

  /// exact(t), `t` in s. Throws OperatorError "file:line: exact(T): what" for anything that is
  /// neither poses of the scene's parts nor a number, and when it is not of the kind that it was of
  /// at first.
  ExactMoment At(double t);
  /// Asks the first question of At again. Throws OperatorError when the answer is another.
  void AskAgain();
  /// Whether it says a number; its unit, "" if it says none; and the number's name. Those of the
  /// last call of At.
  bool scalar() const { return scalar_; }
  /// Whether there is a function measured(t).
  bool measures() const { return measures_; }
  const std::string& unit() const { return unit_; }
  const std::string& name() const { return name_; }

  /// What the world has of the number: what measured(t) returns, else the mechanical energy, J. May
  /// be NaN or infinite. Always of one world. Throws OperatorError when it is no number at all.
  double Measured(const World& world);

 private:
  /// Throws "file:line: FUNCTION(T): complaint".
  [[noreturn]] void Fail(const char* function, double t, const std::string& complaint) const;
  /// What the function returned; throws when the script stopped.
  std::vector<TomlNode> Ask(const char* function, double t, int results);
  ExactMoment Answer(double t);
  WantedPose PoseOf(double t, const std::string& part, const TomlNode& node) const;
  void SetScalar(double t, const std::vector<TomlNode>& answer);

  const Scene scene_;
  const std::string file_;
  JudgedRoom room_;
  std::unique_ptr<Script> script_;  // the one with exact(t)
  std::optional<EnergyMeter> energy_;
  double first_t_ = 0;
  ExactMoment first_;  // what At said at first
  bool known_ = false, scalar_ = false, measures_ = false;
  std::string unit_, name_;
};

}  // namespace seam
