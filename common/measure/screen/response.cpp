#include "common/measure/screen/response.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/measure/parts.h"
#include "common/measure/percentile.h"
#include "common/measure/revisions.h"
#include "common/measure/screen/age.h"
#include "common/measure/screen/counterfactual.h"
#include "common/measure/screen/input_delays.h"

namespace seam {
namespace {

constexpr int kChangesMax = 16;     ///< examined changes of each player
constexpr double kHorizon = 1;      ///< s: greatest response time
constexpr double kEffectMin = 0.2;  ///< m/s: weaker inputs are left out
/// A body responds when the input has changed its velocity by kAnswer, m/s, for kAnswerTicks ticks.
/// The threshold is low because the onset tells most: a late body catches up.
constexpr double kAnswer = 0.1;
constexpr std::int64_t kAnswerTicks = 3;
/// The change must also exceed the velocity error before the change: its mean and its standard
/// deviation, each times its factor.
constexpr double kBiasFactor = 1.5, kNoiseFactor = 3;
/// Greatest response time of the oracle, s: in a slower response a late view catches up unseen.
constexpr double kOnsetMax = 0.25;
/// Time before the change over which the view's age and error are measured, s.
constexpr double kBefore = 0.25;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// One input change with its effect, along one direction.
struct Question {
  InputChange change;
  Effect effect;
  Eigen::Vector3d way{0, 0, 0};  // unit

  /// Returns the oracle's velocity with the input less that without, along `way`, m/s; nullopt
  /// beyond the simulated ticks.
  std::optional<double> At(double tick) const {
    const double t = tick - static_cast<double>(change.tick);
    if (t <= -1) return 0;
    const auto last = static_cast<double>(effect.velocity.size()) - 1;
    if (t > last) return std::nullopt;
    const double low = std::floor(t);
    const auto along = [&](double at) {
      return at < 0 ? 0 : effect.velocity[static_cast<std::size_t>(at)].dot(way);
    };
    return along(low) + (t > low ? (t - low) * (along(low + 1) - along(low)) : 0);
  }
};

std::optional<Question> Ask(const InputChange& change, Effect effect) {
  if (effect.id < 0) return std::nullopt;
  Question question{change, std::move(effect), {0, 0, 0}};
  double most = 0;
  for (const Eigen::Vector3d& d : question.effect.velocity) {
    if (d.norm() <= most) continue;
    most = d.norm();
    question.way = d / most;
  }
  return question;
}

/// Returns the tick at which the oracle's own response reaches `due`, m/s; nullopt: not in time.
std::optional<std::int64_t> TrueAnswer(const Question& question, double due, double h) {
  const auto onset_max = static_cast<std::size_t>(std::llround(kOnsetMax / h));
  const std::size_t known = question.effect.velocity.size();
  for (std::size_t t = 0; t < std::min(known, onset_max); ++t) {
    if (question.effect.velocity[t].dot(question.way) < due) continue;
    return question.change.tick + static_cast<std::int64_t>(t);
  }
  return std::nullopt;
}

/// The displayed velocity of the body less the one without the input, along the question's `way`.
class Difference {
 public:
  Difference(const Question& question, const BodyPath& shown, const BodyPath& truth, double h)
      : question_(question), shown_(shown), truth_(truth), h_(h) {
    const auto before = static_cast<std::int64_t>(std::llround(kBefore / h));
    const std::int64_t tick = question.change.tick;
    const std::int64_t first = std::max(shown.first(), tick - before);
    const ViewAge age = FitAge(shown, truth, question.effect.radius, first, tick - 1,
                               static_cast<int>(std::llround(1 / h)));
    if (age.told) age_ = age.ticks;
    double sum = 0, squares = 0, count = 0;
    for (std::int64_t t = first + 1; t < tick; ++t) {
      const std::optional<double> off = Raw(t);
      if (!off) continue;
      sum += *off;
      squares += *off * *off;
      count += 1;
    }
    if (count == 0) return;
    bias_ = sum / count;
    noise_ = std::sqrt(std::max(0.0, squares / count - bias_ * bias_));
  }
  double age() const { return age_; }
  /// Returns the threshold of a response, m/s: above the velocity error before the change.
  double due() const {
    return std::max({kAnswer, kBiasFactor * std::abs(bias_), kNoiseFactor * noise_});
  }
  std::optional<double> At(std::int64_t tick) const {
    const std::optional<double> raw = Raw(tick);
    return raw ? std::optional<double>(*raw - bias_) : std::nullopt;
  }

 private:
  std::optional<double> Raw(std::int64_t tick) const {
    const double due = static_cast<double>(tick) - age_;
    const std::optional<double> effect = question_.At(due);
    if (!effect || !shown_.Whole(tick - 1, tick) || !truth_.Whole(due - 1, due)) {
      return std::nullopt;
    }
    const double radius = question_.effect.radius;
    const Eigen::Vector3d v = Between(shown_.At(tick - 1), shown_.At(tick), radius) / h_;
    const Eigen::Vector3d u = Between(truth_.At(due - 1), truth_.At(due), radius) / h_;
    return (v - u).dot(question_.way) + *effect;
  }

  const Question& question_;
  const BodyPath &shown_, &truth_;
  double h_, age_ = 0, bias_ = 0, noise_ = 0;
};

/// The ticks at which a screen and the oracle respond.
struct Answer {
  double tick = kNever;    // kNever: no response
  std::int64_t truth = 0;  // the oracle's tick
};

/// Finds the response on a screen. nullopt if it cannot be determined: the body is so far off the
/// oracle's motion that the input does not stand out, or it seems to respond before the oracle.
std::optional<Answer> AnswerOf(const Question& question, const Difference& screen, double h) {
  const double due = screen.due();
  const std::optional<std::int64_t> truth = TrueAnswer(question, due, h);
  if (!truth) return std::nullopt;
  const std::int64_t first = question.change.tick;
  const auto end = first + std::llround(kHorizon / h) + std::llround(screen.age());
  std::int64_t kept = 0;
  for (std::int64_t tick = first; tick < end; ++tick) {
    const std::optional<double> off = screen.At(tick);
    kept = off && *off >= due ? kept + 1 : 0;
    if (kept < kAnswerTicks) continue;
    const std::int64_t answer = tick - kAnswerTicks + 1;
    if (answer < *truth - 1) return std::nullopt;
    return Answer{static_cast<double>(answer), *truth};
  }
  return Answer{kNever, *truth};
}

std::optional<double> Median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  const double median = Percentile(values, 0.5);
  return std::isfinite(median) ? std::optional<double>(median) : std::nullopt;
}

/// True if the recorded times advance: a bus without a clock gives all views the same time.
bool TimesPass(const Recording& recording) {
  for (const auto& [peer, times] : recording.view_us) {
    const double ticks = static_cast<double>(times.rbegin()->first - times.begin()->first);
    const double us = static_cast<double>(times.rbegin()->second - times.begin()->second);
    if (ticks > 0 && us < ticks * TickSeconds(recording) * 1e6 / 2) return false;
  }
  return !recording.view_us.empty();
}

/// Returns the time at which the bus received a view, us.
std::optional<double> HeardUs(const Recording& recording, int peer, std::int64_t tick) {
  const auto of_peer = recording.view_us.find(peer);
  if (of_peer == recording.view_us.end()) return std::nullopt;
  const auto heard = of_peer->second.find(tick);
  if (heard == of_peer->second.end()) return std::nullopt;
  return static_cast<double>(heard->second);
}

}  // namespace

void MeasureResponse(const Recording& recording, const Oracle& oracle, Measures* measures) {
  if (recording.room.scene_text.empty() || !TimesPass(recording)) return;
  const Scene scene = RecordedScene(recording.room);
  const RevisionHistory revisions(scene, recording);
  const RevisionHistory* changing = revisions.change() ? &revisions : nullptr;
  OwnBodies own(recording, &revisions);
  const Counterfactual worlds(recording, oracle, revisions, &own);
  const InputDelays delays(recording);
  const double h = TickSeconds(recording);
  const auto horizon = static_cast<std::int64_t>(std::llround(kHorizon / h));
  std::map<int, std::vector<const View*>> views;
  for (const auto& [peer, of_peer] : recording.views) views[peer] = ViewsByTick(recording, peer);
  std::vector<double> of_own, of_server, of_others;
  const std::int64_t first = std::max(oracle.first_tick, recording.first_tick) + 1;
  for (const InputChange& change :
       ChangesOf(TapeOf(recording), first, recording.last_tick - horizon, kChangesMax)) {
    const int player_peer = change.player + 1;
    const std::optional<double> read_us =
        HeardUs(recording, player_peer, change.tick - delays.Of(change.player, change.tick));
    if (!read_us) continue;
    const std::optional<Question> question = Ask(change, worlds.Of(change, horizon, kEffectMin));
    if (!question) continue;
    const BodyPath truth = TruePath(recording, oracle, question->effect.id);
    for (const auto& [peer, of_peer] : views) {
      const BodyPath shown = ShownPath(recording, of_peer, changing, question->effect.id);
      const Difference screen(*question, shown, truth, h);
      const std::optional<Answer> answer = AnswerOf(*question, screen, h);
      if (!answer) continue;
      std::vector<double>& kind = peer == 0 ? of_server : peer == player_peer ? of_own : of_others;
      if (answer->tick == kNever) {
        kind.push_back(kNever);
        continue;
      }
      const auto seen_us = HeardUs(recording, peer, static_cast<std::int64_t>(answer->tick));
      if (!seen_us) continue;
      // The body's own inertia is no latency; the step in which the input takes effect is.
      const auto inertia = static_cast<double>(answer->truth - change.tick - 1);
      kind.push_back((*seen_us - *read_us) * 1e-3 - 1000 * inertia * h);
    }
  }
  measures->response_own_ms = Median(of_own);
  measures->response_server_ms = Median(of_server);
  measures->response_other_ms = Median(of_others);
}

}  // namespace seam
