#include "tests/lab/exact/scene_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/scene/toml/scene_text.h"

namespace seam {
namespace {

constexpr const char* kExact = "exact";
constexpr const char* kMeasured = "measured";
/// Farther nothing is, m or rad: beyond it the engine's numbers have no digits for places.
constexpr double kFarthest = 1e9;
/// Longest unit and name, bytes: they stand in tables.
constexpr std::size_t kWordMax = 32;

bool IsNumber(const TomlNode& node) {
  return node.kind == TomlNode::Kind::kNumber || node.kind == TomlNode::Kind::kInteger;
}

std::string Said(const TomlNode& node) {
  if (node.kind == TomlNode::Kind::kBoolean) return "a boolean";
  return node.kind == TomlNode::Kind::kOther ? "nothing" : KindName(node.kind);
}

bool IsWord(const TomlNode& node) {
  return node.kind == TomlNode::Kind::kText && !node.text.empty() && node.text.size() <= kWordMax &&
         IsCleanText(node.text, "");
}

}  // namespace

SceneTruth::SceneTruth(const Scene& scene, const std::string& file)
    : scene_(scene), file_(file), room_(scene_) {
  const World world(scene_);
  room_.Look(&world);
  const ScriptSource* apart = nullptr;  // says measured(t) without exact(t)
  for (const ScriptSource& source : scene_.scripts) {
    auto script = std::make_unique<Script>(source, file_, 0, room_);
    if (script->stopped()) throw OperatorError(script->error());
    for (const char* function : {kExact, kMeasured}) {
      if (script->LineOf(function) >= 0) continue;
      throw OperatorError(fmt::format("{}:{}: script '{}': {} is no function", file_, source.line,
                                      source.name, function));
    }
    if (!script->Defines(kExact)) {
      if (script->Defines(kMeasured)) apart = &source;
      continue;
    }
    if (script_ != nullptr) {
      throw OperatorError(fmt::format("{}:{}: scripts '{}' and '{}' both say exact(t)", file_,
                                      script->LineOf(kExact), script_->name(), source.name));
    }
    script_ = std::move(script);
  }
  room_.Look(nullptr);
  room_.EndLoading();
  if (apart != nullptr) {
    throw OperatorError(fmt::format("{}:{}: script '{}' says measured(t), but not exact(t)", file_,
                                    apart->line, apart->name));
  }
  if (script_ == nullptr) return;
  measures_ = script_->Defines(kMeasured);
}

SceneTruth::~SceneTruth() = default;

void SceneTruth::Fail(const char* function, double t, const std::string& complaint) const {
  throw OperatorError(fmt::format("{}:{}: {}({:.6g}): {}", file_, script_->LineOf(function),
                                  function, t, complaint));
}

std::vector<TomlNode> SceneTruth::Ask(const char* function, double t, int results) {
  std::vector<TomlNode> answer = script_->Ask(function, t, results);
  if (script_->stopped()) throw OperatorError(script_->error());
  if (answer.empty()) throw OperatorError(file_ + ": " + function + "(t) is no function any more");
  return answer;
}

WantedPose SceneTruth::PoseOf(double t, const std::string& part, const TomlNode& node) const {
  const auto fail = [&](const std::string& what) {
    Fail(kExact, t, fmt::format("part '{}': {}", Printable(part), what));
  };
  if (node.kind != TomlNode::Kind::kTable || node.members.empty()) {
    fail("expected {x = m, y = m, angle = rad}, or some of these, not " + Said(node));
  }
  WantedPose wanted;
  for (const auto& [key, value] : node.members) {
    std::optional<double>* const field = key == "x"       ? &wanted.x
                                         : key == "y"     ? &wanted.y
                                         : key == "angle" ? &wanted.angle
                                                          : nullptr;
    if (field == nullptr) {
      fail(fmt::format("a pose has x, y and angle, not '{}'", Printable(key)));
    } else if (!IsNumber(value) || !std::isfinite(value.number)) {
      fail(fmt::format("{} is {}", key, IsNumber(value) ? "not finite" : Said(value)));
    } else if (std::fabs(value.number) > kFarthest) {
      fail(fmt::format("{} is {:.6g}, of at most {:g}", key, value.number, kFarthest));
    } else {
      *field = value.number;
    }
  }
  return wanted;
}

void SceneTruth::SetScalar(double t, const std::vector<TomlNode>& answer) {
  const char* const kOrder = "the number may be followed by its unit and its name, both text";
  for (std::size_t i = 1; i < answer.size(); ++i) {
    if (answer[i].kind != TomlNode::Kind::kOther && !IsWord(answer[i])) Fail(kExact, t, kOrder);
  }
  const std::string unit = !measures_ && answer[1].text.empty() ? "J" : answer[1].text;
  if (known_ && unit != unit_) Fail(kExact, t, "another unit than before");
  unit_ = unit;
  name_ = !answer[2].text.empty() ? answer[2].text : measures_ ? "value" : "energy";
  if (!measures_ && unit_ != "J") {
    Fail(kExact, t,
         fmt::format("in {}, but without a function measured(t) it is compared with the energy, "
                     "in J",
                     Printable(unit_)));
  }
}

ExactMoment SceneTruth::At(double t) {
  const bool first = !known_;
  ExactMoment moment = Answer(t);
  if (first) {
    first_t_ = t;
    first_ = moment;
  }
  return moment;
}

void SceneTruth::AskAgain() {
  const auto same_pose = [](const auto& x, const auto& y) {
    const WantedPose &p = x.second, &q = y.second;
    return x.first == y.first && p.x == q.x && p.y == q.y && p.angle == q.angle;
  };
  const ExactMoment again = Answer(first_t_);
  if (again.value == first_.value &&
      std::equal(again.poses.begin(), again.poses.end(), first_.poses.begin(), first_.poses.end(),
                 same_pose)) {
    return;
  }
  Fail(kExact, first_t_, "another answer than before; it may depend on t alone");
}

ExactMoment SceneTruth::Answer(double t) {
  const std::vector<TomlNode> answer = Ask(kExact, t, 3);
  const TomlNode& first = answer.front();
  ExactMoment moment;
  const bool table = first.kind == TomlNode::Kind::kTable;
  if (!table && !IsNumber(first)) {
    Fail(kExact, t,
         "expected poses by part, {ball = {x = 1, y = 2}}, or a number; it returns " + Said(first));
  }
  if (known_ && scalar_ == table) Fail(kExact, t, "poses at one time, a number at another");
  scalar_ = !table;
  if (scalar_) {
    if (!std::isfinite(first.number)) Fail(kExact, t, "the number is not finite");
    SetScalar(t, answer);
    known_ = true;
    moment.value = first.number;
    return moment;
  }
  known_ = true;
  if (first.members.empty()) Fail(kExact, t, "no part is in the table");
  for (const auto& [name, pose] : first.members) {
    const PartId part = room_.FindPart(name);
    if (part < 0) Fail(kExact, t, fmt::format("the scene has no part '{}'", Printable(name)));
    moment.poses.emplace_back(part, PoseOf(t, name, pose));
  }
  std::sort(moment.poses.begin(), moment.poses.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  return moment;
}

double SceneTruth::Measured(const World& world) {
  if (!measures_) {
    // Welds may be joints in this world, so its bodies are others than the scene's.
    if (!energy_) energy_.emplace(world.scene(), world.composition());
    std::vector<BodyState> states;
    for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
    return energy_->Of(states, world.tick());
  }
  room_.Look(&world);
  const double t = static_cast<double>(world.tick()) / world.scene().solver.tick_hz;
  const std::vector<TomlNode> answer = Ask(kMeasured, t, 1);
  room_.Look(nullptr);
  if (!IsNumber(answer.front())) {
    Fail(kMeasured, t, "expected a number; it returns " + Said(answer.front()));
  }
  return answer.front().number;
}

}  // namespace seam
