#pragma once
/// Received states by tick: for what is displayed rather than simulated (the snapshot interpolation
/// of modes strict and central, dead reckoning beyond the buffer zone), for pulls and for replays.

#include <cstdint>
#include <deque>
#include <vector>

#include "common/scene/types.h"
#include "common/topology/body_remap.h"

namespace seam {

/// Dead reckoning of what is displayed goes no further than this, s. If it is shorter than the age
/// of the states, a fast body stops and jumps; longer shows more that is wrong.
constexpr float kReckonMax = 1.0f;

/// By how much a moderate acceleration changes the velocity (m/s) and the position (m) of what is
/// reckoned for `forward` s: it is thought to last for a moment only.
Vec2 SpeedGained(const Vec2& acceleration, float forward);
Vec2 ShiftGained(const Vec2& acceleration, float forward);

/// The last few states heard of each body.
class Snapshots {
 public:
  explicit Snapshots(int body_count);

  /// Keeps the state if it is newer than what it has of this body. `falls`: gravity alone moves it.
  void Add(int body, std::int64_t tick, const BodyState& state, bool falls = false);
  /// The bodies have changed: what was heard of those they come from is carried over.
  void Remap(const std::vector<BodyOrigin>& origins);
  /// What was heard of later ticks was of another body.
  void ForgetAfter(int body, std::int64_t tick);

  bool has(int body) const { return newest_tick(body) >= 0; }
  /// -1 when none.
  std::int64_t newest_tick(int body) const {
    return rings_[static_cast<std::size_t>(body)].newest_tick();
  }
  /// Requires has(body).
  const BodyState& newest(int body) const {
    return rings_[static_cast<std::size_t>(body)].newest();
  }

  /// Whether the newest state is of free fall. Requires has(body).
  bool falls(int body) const { return rings_[static_cast<std::size_t>(body)].falls; }

  /// The state of exactly this tick; nullptr when it is not kept.
  const BodyState* At(int body, std::int64_t tick) const;
  /// Interpolated at a (fractional) tick; the oldest or newest kept state outside of what is known:
  /// never extrapolated. Requires has(body).
  BodyState Interpolate(int body, double tick) const;
  /// What the last two intervals between states have in common, m/s^2; 0 where they are opposed,
  /// one is too large to go on or too long, or the newest state is not of `tick`.
  Vec2 Acceleration(int body, std::int64_t tick, float dt) const;
  /// The newest state moved on by its velocity for at most `max_s`, and by a moderate acceleration
  /// that has lasted for two intervals. Requires has(body).
  BodyState Extrapolate(int body, std::int64_t tick, float dt, float max_s) const;
  /// The same by the last interval alone. For what is simulated and pulled there: it answers at
  /// once, and what comes of it the next pull undoes.
  BodyState ExtrapolateNewest(int body, std::int64_t tick, float dt, float max_s) const;
  /// For how long a state of `from` is moved on to `tick`, s.
  static float Forward(std::int64_t from, std::int64_t tick, float dt, float max_s);

 private:
  struct Stamped {
    std::int64_t tick = 0;
    BodyState state;
  };
  /// The newest kKeep of a body, in one piece of memory that is as large as they need: a room hears
  /// of thousands of bodies in a second, and what an entry costs is the memory that it is in. The
  /// newest lies in the ring itself, too, beside its tick: most who ask want no other.
  class alignas(64) Ring {
   public:
    void Push(const Stamped& stamped);
    void DropNewest();
    std::size_t size() const { return size_; }
    std::int64_t newest_tick() const { return newest_tick_; }  ///< -1 when none
    const BodyState& newest() const { return newest_; }        ///< requires size() > 0
    /// All states become what `to(state)` says.
    template <class To>
    void Change(const To& to) {
      for (std::size_t k = 0; k < size_; ++k) {
        BodyState& state = slots_[SlotOf(k)].state;
        state = to(state);
      }
      if (size_ > 0) newest_ = FromNewest(0).state;
    }
    /// 0 is the newest. Requires back < size().
    const Stamped& FromNewest(std::size_t back) const { return slots_[SlotOf(back)]; }
    bool falls = false;  ///< of the newest

   private:
    std::size_t SlotOf(std::size_t back) const {
      const std::size_t slot = next_ + slots_.size() - 1 - back;
      return slot >= slots_.size() ? slot - slots_.size() : slot;
    }
    void Grow();
    std::int64_t newest_tick_ = -1;
    BodyState newest_;
    std::vector<Stamped> slots_;
    std::uint16_t next_ = 0, size_ = 0;  // where the next goes, and how many there are
  };
  /// Between the state that is so many back and the one before it.
  static Vec2 AccelerationBefore(std::size_t back, const Ring& ring, float dt);
  static BodyState Onward(const Ring& ring, std::int64_t tick, float dt, float max_s,
                          const Vec2& acceleration);
  std::vector<Ring> rings_;
};

/// How far in the past to display so that the next snapshot has nearly always arrived: the age
/// that 19 of 20 snapshots stay below, plus one interval. Changes slowly, because a jump of it is a
/// stutter.
class DisplayDelay {
 public:
  explicit DisplayDelay(int interval_ticks) : interval_ticks_(interval_ticks) {}
  /// A snapshot was `age_ticks` old when it came.
  void AddAge(std::int64_t age_ticks);
  /// Called once a tick; returns the delay in ticks.
  double Advance();
  double ticks() const { return delay_; }

 private:
  int interval_ticks_;
  std::deque<std::int64_t> ages_;
  double delay_ = -1;
};

}  // namespace seam
