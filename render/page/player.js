// Time: moves the tick by the clock, the keys and the buttons.

class Player {
  constructor(runs, changed) {
    this.runs = runs;
    this.changed = changed;
    this.last = Math.max(...runs.map((run) => run.count - 1));
    this.hz = runs[0].hz;
    this.before_ms = null;
  }
  go(tick) {
    state.tick = Math.min(Math.max(tick, 0), this.last);
    this.changed();
  }
  step(ticks) {
    this.pause();
    this.go(ticks < 0 ? Math.ceil(state.tick) + ticks : Math.floor(state.tick) + ticks);
  }
  toggle() {
    if (state.playing) return this.pause();
    if (state.tick >= this.last) state.tick = 0;
    state.playing = true;
    this.before_ms = null;
    requestAnimationFrame((now) => this.frame(now));
    this.changed();
  }
  pause() {
    state.playing = false;
    state.tick = Math.round(state.tick);
    this.changed();
  }
  frame(now_ms) {
    if (!state.playing) return;
    const passed_s = this.before_ms === null ? 0 : Math.min((now_ms - this.before_ms) / 1000, 0.25);
    this.before_ms = now_ms;
    state.tick += passed_s * this.hz * state.speed;
    if (state.tick >= this.last) {
      state.tick = this.last;
      state.playing = false;
    }
    this.changed();
    if (state.playing) requestAnimationFrame((now) => this.frame(now));
  }
  faster(steps) {
    const at = SPEEDS.indexOf(state.speed) + steps;
    state.speed = SPEEDS[Math.min(Math.max(at, 0), SPEEDS.length - 1)];
    this.changed();
  }
  // Jumps to the next event after (or before) now; an event's `at` counts ticks as state.tick does.
  jump(events, way) {
    const found = way > 0 ? events.find((event) => event.at > state.tick) :
                            [...events].reverse().find((event) => event.at < state.tick);
    this.pause();
    if (found) this.go(found.at);
    return found;
  }
}

function speedName(speed) {
  return speed < 1 ? `1/${1 / speed}` : String(speed);
}
