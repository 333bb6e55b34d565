#pragma once
/// Received states by tick, for displayed bodies (snapshot interpolation in modes strict and
/// central, dead reckoning beyond the buffer zone), for pullers and for replays.

#include <cstdint>
#include <vector>

#include "common/scene/types.h"
#include "common/sync/table/body_column.h"

namespace seam {

class StateArchive;

/// Longest dead reckoning from a received state, s. If shorter than the age of the states, a fast
/// body stops and jumps; longer shows more that is wrong.
constexpr float kReckonMax = 1.0f;

/// Return the change of velocity (m/s) and of position (m) that a moderate acceleration causes over
/// `forward` s of extrapolation. It is assumed to last only a moment.
Vec2 SpeedGained(const Vec2& acceleration, float forward);
Vec2 ShiftGained(const Vec2& acceleration, float forward);

/// The last few states heard of each body. After an edit a body has those of the body that it came
/// from, moved rigidly.
class Snapshots {
 public:
  explicit Snapshots(const BodyTable& table);

  /// Keeps the state if it is newer than all states of this body. `falls`: gravity alone moves it.
  void Add(int body, std::int64_t tick, const BodyState& state, bool falls = false);
  /// Drops states after `tick`: they belong to another body.
  void ForgetAfter(int body, std::int64_t tick);

  /// Saves or loads the states of a body from tick `from` on, and its newest one before.
  void Persist(StateArchive& a, int body, std::int64_t from);

  bool has(int body) const { return newest_tick(body) >= 0; }
  /// -1 if there is none.
  std::int64_t newest_tick(int body) const { return rings_[body].newest_tick(); }
  /// Requires has(body).
  const BodyState& newest(int body) const { return rings_[body].newest(); }

  /// True if the newest state is of free fall. Requires has(body).
  bool falls(int body) const { return rings_[body].falls; }

  /// Returns the state of exactly this tick; nullptr if it is not kept.
  const BodyState* At(int body, std::int64_t tick) const;
  /// Returns the state at a (fractional) tick between two kept ones: dead-reckoned from the one
  /// before, with a share of its error at the one after that grows with time. A body `alone`, on
  /// which no joint acts, goes on so until its path comes nearest to that back from the one after,
  /// as where a blow was, then along that one. Along a parabola where gravity (m/s^2) alone has
  /// changed the velocity. Outside the kept range the oldest or newest. Requires has(body).
  BodyState Interpolate(int body, double tick, float dt, const Vec2& gravity, bool alone) const;
  /// Returns the common acceleration of the last two intervals between states, m/s^2. 0 if they
  /// oppose each other, if one is too large to last or too long, or if the newest state is not of
  /// `tick`.
  Vec2 Acceleration(int body, std::int64_t tick, float dt) const;
  /// Returns the newest state extrapolated by its velocity for at most `max_s`, and by a moderate
  /// acceleration that has lasted two intervals. Requires has(body).
  BodyState Extrapolate(int body, std::int64_t tick, float dt, float max_s) const;
  /// Like Extrapolate, with the acceleration of the last interval alone. For pullers of simulated
  /// bodies: it reacts at once, and the next pull undoes an error.
  BodyState ExtrapolateNewest(int body, std::int64_t tick, float dt, float max_s) const;
  /// Returns the time for which a state of `from` is extrapolated to `tick`, s.
  static float Forward(std::int64_t from, std::int64_t tick, float dt, float max_s);

 private:
  struct Stamped {
    std::int64_t tick = 0;
    BodyState state;
  };
  /// The newest kKeep states of a body in one block of memory, as large as needed: a room hears of
  /// thousands of bodies a second, and the cost of an entry is its cache miss. The newest is also
  /// kept in the ring itself, beside its tick, because most callers want only that.
  class alignas(64) Ring {
   public:
    void Push(const Stamped& stamped);
    void DropNewest();
    std::size_t size() const { return size_; }
    std::int64_t newest_tick() const { return newest_tick_; }  ///< -1 when none
    const BodyState& newest() const { return newest_; }        ///< requires size() > 0
    /// Replaces each state by `to(state)`.
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
    std::uint16_t next_ = 0, size_ = 0;  // slot of the next state, and number of states
  };
  /// Acceleration between the state `back` from the newest and the one before it.
  static Vec2 AccelerationBefore(std::size_t back, const Ring& ring, float dt);
  static BodyState Onward(const Ring& ring, std::int64_t tick, float dt, float max_s,
                          const Vec2& acceleration);
  static Ring AfterEdit(const BodyOrigin& origin, Ring* before);

  BodyColumn<Ring> rings_;
};

}  // namespace seam
