#include "common/sync/inputs/input_track.h"

#include <algorithm>

#include "common/scene/saved/persist_state.h"

namespace seam {

const InputTrack::Known* InputTrack::Find(std::int64_t tick) const {
  if (tick < oldest_ || tick > newest_ || newest_ < 0) return nullptr;
  const Known& known = ring_[Place(tick)];
  return known.tick == tick ? &known : nullptr;
}

const InputTrack::Known* InputTrack::Before(std::int64_t tick) const {
  if (newest_ < 0) return nullptr;
  for (tick = std::min(tick, newest_); tick >= oldest_; --tick) {
    const Known& known = ring_[Place(tick)];
    if (known.tick == tick) return &known;
  }
  return nullptr;
}

void InputTrack::Note(std::int64_t tick, const Input& input) {
  if (tick < 0 || tick < newest_ - kKeepTicks || knows(tick)) return;
  if (ring_.empty()) ring_.resize(static_cast<std::size_t>(kKeepTicks + 1));
  const bool next = tick > newest_;
  if (next && !(input == At(tick))) newest_change_ = tick;
  ring_[Place(tick)] = {tick, input};
  if (newest_ < 0) oldest_ = tick;
  newest_ = std::max(newest_, tick);
  oldest_ = std::max(std::min(oldest_, tick), newest_ - kKeepTicks);
  while (ring_[Place(oldest_)].tick != oldest_) ++oldest_;
  if (!next) FindNewestChange();
}

/// Recomputes the newest change: a late input may be a change, or turn the next one into none.
void InputTrack::FindNewestChange() {
  newest_change_ = -1;
  const Known* after = Before(newest_);
  while (after != nullptr && newest_change_ < 0) {
    const Known* const before = Before(after->tick - 1);
    const Input guess = before == nullptr ? Input{} : before->input;
    if (!(after->input == guess)) newest_change_ = after->tick;
    after = before;
  }
}

void InputTrack::Note(const Inputs& inputs) {
  for (std::size_t i = 0; i < inputs.drive.size(); ++i) {
    Note(inputs.first_tick + static_cast<std::int64_t>(i),
         Input{inputs.drive[i], inputs.lift[i], inputs.buttons[i]});
  }
}

Input InputTrack::At(std::int64_t tick) const {
  const Known* known = Before(tick);
  return known == nullptr ? Input{} : known->input;
}

bool InputTrack::DiffersFromPrediction(std::int64_t from) const {
  if (newest_ < 0 || from > newest_) return false;
  // In constant time, because servers ask for every player and receiver. A peer that knows nothing
  // before the oldest input assumes a neutral one.
  const bool changed = newest_change_ > oldest_ && newest_change_ >= from;
  return changed || (from <= oldest_ && !(At(oldest_) == Input{}));
}

int InputTrack::ButtonsBefore(std::int64_t tick) const {
  const Known* before = Before(tick - 1);
  return before == nullptr ? 0 : before->input.buttons;
}

std::int16_t InputTrack::TakePresses(std::int64_t tick) {
  int pressed = 0;
  const std::int64_t last = std::min(tick, newest_);
  for (std::int64_t t = std::max(presses_taken_until_ + 1, oldest_); t <= last && t >= 0; ++t) {
    const Known* known = Find(t);
    if (known == nullptr) continue;
    pressed |= known->input.buttons & ~ButtonsBefore(t);
    presses_taken_until_ = t;
  }
  return static_cast<std::int16_t>(pressed);
}

std::int16_t InputTrack::PressedAt(std::int64_t tick) const {
  const Known* now = Find(tick);
  if (now == nullptr) return 0;
  return static_cast<std::int16_t>(now->input.buttons & ~ButtonsBefore(tick));
}

Inputs InputTrack::Export(int player, int count) const {
  Inputs out;
  Export(player, count, &out);
  return out;
}

void InputTrack::Export(int player, int count, Inputs* to) const {
  to->player = player;
  to->first_tick = 0;
  to->drive.clear();
  to->lift.clear();
  to->buttons.clear();
  if (newest_ < 0) return;
  std::int64_t first = newest_;
  while (newest_ - first + 1 < count && knows(first - 1)) --first;
  to->first_tick = first;
  for (std::int64_t tick = first; tick <= newest_; ++tick) {
    const Input& input = Find(tick)->input;
    to->drive.push_back(input.drive);
    to->lift.push_back(input.lift);
    to->buttons.push_back(input.buttons);
  }
}

void InputTrack::Persist(StateArchive& a) {
  struct Run {
    std::int16_t after = 0, ticks = 0;  // unknown ticks before it, and ticks with this input
    Input input;
  };
  std::vector<Run> runs;
  std::int64_t end = oldest_;  // of the last run
  for (std::int64_t t = oldest_; newest_ >= 0 && t <= newest_; ++t) {
    const Known* const known = Find(t);
    if (known == nullptr) continue;
    const bool on = !runs.empty() && end == t && runs.back().input == known->input;
    if (!on) runs.push_back({static_cast<std::int16_t>(t - end), 0, known->input});
    ++runs.back().ticks;
    end = t + 1;
  }
  std::int64_t tick = oldest_;
  a.Int(&tick, -1, StateArchive::kTickMost);
  a.List(&runs, static_cast<std::size_t>(kKeepTicks + 1), [&](Run* run) {
    a.Int(&run->after, 0, kKeepTicks);
    a.Int(&run->ticks, 1, kKeepTicks + 1);
    seam::Persist(a, &run->input);
  });
  if (a.reading()) {
    *this = InputTrack();
    for (const Run& run : runs) {
      tick += run.after;
      for (int i = 0; i < run.ticks; ++i) Note(tick++, run.input);
    }
  }
  a.Tick(&presses_taken_until_);
}

}  // namespace seam
