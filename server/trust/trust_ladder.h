#pragma once
/// Consequences of doubts about a player's client: a score that leaks, and steps that it leads to.
/// One doubt proves nothing; many in a short time do. Each step but the last ends by itself.
///
///   noted         a line for the operator
///   watched       the same; its states are no longer believed against the server's copy
///   server holds  its bodies are the server's for kHeldS; it drives them by its inputs
///   inputs only   the same for kInputsOnlyS, and nothing but its inputs is believed: the second
///                 time within kRememberS
///   out           it has to leave, and its place holds nothing for kRememberS: the third time

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace seam {

class StateArchive;

enum class TrustStep { kTrusted, kNoted, kWatched, kServerHolds, kInputsOnly, kOut };
/// Returns "trusted", "noted", ...
const char* ToString(TrustStep step);

/// kWatch: doubts are scored and told, without any consequence.
enum class TrustMode { kOff, kWatch, kAct };
/// Throws OperatorError unless the text is off, watch or act.
TrustMode ParseTrustMode(const std::string& text);

class TrustLadder {
 public:
  TrustLadder(std::size_t players, int tick_hz);

  /// Adds a doubt about a player's client. Weight 1: a small difference told for .25 s.
  void Note(int player, float weight);
  /// Takes away the player's right to hold bodies for kWithheldS: it did not let go.
  void NoteWithheld(int player, std::int64_t tick) {
    Withhold(player, tick + kWithheldS * tick_hz_);
  }
  /// True if a difference of the player's states may be the effect of its own silence that has
  /// just ended. It then is for kReturnS; kExcusesAtOnce times, and once more each kExcuseEveryS:
  /// a silence must not excuse lies for ever. Not kept in a saved room: all return when it goes on.
  bool Excuse(int player, std::int64_t tick);
  /// Does so for kReturnS: after somebody's silence its states differ from those that the server
  /// has told everybody meanwhile. That is no doubt about its client.
  void NoteParted(int player, std::int64_t tick) { Withhold(player, tick + kReturnS * tick_hz_); }

  struct Change {
    int player = -1;
    TrustStep from = TrustStep::kTrusted, to = TrustStep::kTrusted;
  };
  /// Call once after each tick. Lets the scores leak; returns the steps that were taken.
  std::vector<Change> Update(std::int64_t tick);
  TrustStep step(int player) const { return At(player).step; }
  float score(int player) const { return At(player).score; }
  /// True for so long after NoteWithheld and NoteParted.
  bool Withholds(int player, std::int64_t tick) const { return tick < At(player).withheld_until; }
  /// True if the player's client may have authority.
  bool MayHold(int player, std::int64_t tick) const;
  /// True if only the inputs of the player's client count.
  bool InputsOnly(int player) const { return step(player) >= TrustStep::kInputsOnly; }
  void Persist(StateArchive& a);

  /// Scores at which a step is taken. The score loses kLeakPerS.
  static constexpr float kNoted = 1, kWatched = 4, kDistrusted = 8;
  static constexpr float kLeakPerS = 1;
  static constexpr int kHeldS = 30, kInputsOnlyS = 120, kRememberS = 600, kWithheldS = 30;
  /// Time after a silence in which differences are taken for its effects, s: a hand-over over any
  /// network. Longer lets a client lie unscored after each silence, though nobody believes it.
  static constexpr int kReturnS = 2;
  static constexpr int kExcusesAtOnce = 3, kExcuseEveryS = 30;

 private:
  struct Standing {
    TrustStep step = TrustStep::kTrusted;
    float score = 0;
    int falls = 0;                    // times that the server has taken its bodies, or more
    std::int64_t until = 0;           // end of such a step, tick
    std::int64_t forgotten = 0;       // tick at which the falls are forgotten
    std::int64_t withheld_until = 0;  // tick until which it may hold nothing
    std::int64_t excused_until = 0;
    std::int64_t excuses_paid = std::numeric_limits<std::int64_t>::min() / 2;  // tick
  };
  const Standing& At(int player) const { return standings_[static_cast<std::size_t>(player)]; }
  TrustStep Next(Standing* standing, std::int64_t tick) const;
  void Withhold(int player, std::int64_t until);

  const int tick_hz_;
  std::vector<Standing> standings_;  // by player
};

}  // namespace seam
