#pragma once
/// The exact answer that a scene carries: its script's functions exact(t) and measured(t).
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

/// The right answer at one moment: poses of parts, or a number.
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

  /// True if a script of the scene has a function exact(t). The functions below require it.
  bool found() const { return script_ != nullptr; }

  /// exact(t), `t` in s. Throws OperatorError "file:line: exact(T): what" for anything that is
  /// neither poses of the scene's parts nor a number, and when it is not of the kind that it was of
  /// at first.
  ExactMoment At(double t);
  /// Asks the first question of At again. Throws OperatorError when the answer is another.
  void AskAgain();
  /// True if exact(t) returned a number in the last call of At; its unit, "" if there is none; and
  /// the number's name.
  bool scalar() const { return scalar_; }
  /// True if there is a function measured(t).
  bool measures() const { return measures_; }
  const std::string& unit() const { return unit_; }
  const std::string& name() const { return name_; }

  /// Returns the world's value of the number: the result of measured(t), else the mechanical
  /// energy, J. May be NaN or infinite. Always of one world. Throws OperatorError if it is no
  /// number at all.
  double Measured(const World& world);

 private:
  /// Throws "file:line: FUNCTION(T): complaint".
  [[noreturn]] void Fail(const char* function, double t, const std::string& complaint) const;
  /// Returns the function's result; throws if the script stopped.
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
  ExactMoment first_;  // first answer of At
  bool known_ = false, scalar_ = false, measures_ = false;
  std::string unit_, name_;
};

}  // namespace seam
