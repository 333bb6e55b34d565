// Runs and views for the panels, the strip and the table. Ticks are counted from the recording's
// first one; lengths are metres.

const MEASURES = {
  error: {name: 'Error at the tick shown', unit: 'm', log: true, each: 'body and tick'},
  path: {name: 'Path error', unit: 'm', log: true, each: 'tick'},
  stutter: {name: 'Stutter', unit: 'm/s²', each: 'tick'},
  rtt: {name: 'Round trip', unit: 'ms', each: 'second'},
  loss: {name: 'Loss', unit: '%', each: 'second'},
  bytes: {name: 'Bytes', unit: 'kB/s', each: 'second'},
};

class View {
  constructor(run, head, bytes, units) {
    this.run = run;
    this.peer = head.peer;
    this.name = head.name;
    this.stats = head.stats;
    this.units = units;
    this.tracks = readTracks(bytes, head.tracks, true);
    this.stutter = head.stutter && readSeries(bytes, head.stutter, units.stutter);
    this.path = head.path && readSeries(bytes, head.path, units.error);
    this.strands = head.strands ? readStrands(bytes, head.strands) : [];
    this.curves = {};
  }
  // Live: curves of columns that grow, all others are made anew.
  renewCurves() {
    this.curves = {error: this.apart, truth: this.truth};
  }
  label() {
    return this.run.page.runs.length > 1 ? `${this.run.name} · ${this.name}` : this.name;
  }
  // Returns the world shown at a tick; the last known one where the view is missing.
  worldAt(tick) {
    for (let i = Math.min(Math.floor(tick), this.tracks.count - 1); i >= 0; --i)
      if (this.tracks.world[i] >= 0) return this.run.worlds[this.tracks.world[i]];
    return this.run.worlds[0];
  }
  // Returns the tick whose pose a body has in the view of a tick: that less its show age.
  tickShown(id, tick) {
    const track = this.tracks.bodies.get(id);
    if (!track) return tick;
    const i = Math.floor(tick);
    const now = track.age[i] || 0;
    const next = track.has[i + 1] ? track.age[i + 1] : now;
    return Math.max(0, tick - (now + (tick - i) * (next - now)) * this.units.age);
  }
  errorOf(id, tick) {
    const track = this.tracks.bodies.get(id);
    const units = track ? track.error[Math.floor(tick)] : undefined;
    return units === undefined || units < 0 ? null : units * this.units.error;
  }
  // Returns errors by tick, NaN where unknown.
  curve(measure) {
    return (this.curves[measure] = this.curves[measure] || this.makeCurve(measure));
  }
  makeCurve(measure) {
    const count = this.tracks.count;
    if (measure === 'error') return this.errorCurve();
    if (measure === 'path' || measure === 'stutter') {
      const series = this[measure];
      if (!series) return new Float64Array(count).fill(NaN);
      return series.root.map((value, i) => (series.count[i] > 0 ? value : NaN));
    }
    return this.statsCurve(measure);
  }
  errorCurve() {
    const sum = new Float64Array(this.tracks.count);
    const known = new Float64Array(this.tracks.count);
    for (const track of this.tracks.bodies.values()) {
      track.error.forEach((units, i) => {
        if (units < 0) return;
        sum[i] += (units * this.units.error) ** 2;
        ++known[i];
      });
    }
    return sum.map((value, i) => (known[i] > 0 ? Math.sqrt(value / known[i]) : NaN));
  }
  // Returns a curve by tick from the peer's counters, one step for each second.
  statsCurve(measure) {
    const curve = new Float64Array(this.tracks.count).fill(NaN);
    for (let k = 1; k < this.stats.length; ++k) {
      const [tick0, , , in0, out0] = this.stats[k - 1];
      const [tick1, rtt, loss, in1, out1] = this.stats[k];
      const seconds = (tick1 - tick0) / this.run.hz;
      if (seconds <= 0) continue;
      const value = measure === 'rtt' ? (rtt < 0 ? NaN : rtt / 1000) :
          measure === 'loss'          ? loss / 1e4 :
                                        (in1 - in0 + out1 - out0) / 1000 / seconds;
      const from = Math.max(0, tick0 - this.run.first);
      curve.fill(value, from, Math.max(from, tick1 - this.run.first));
    }
    return curve;
  }
}

class Run {
  constructor(page, head, bytes, index, units) {
    Object.assign(this, head);
    this.page = page;
    this.index = index;
    this.count = head.last - head.first + 1;
    this.oracle = head.truth && readTracks(bytes, head.truth, false);
    const drawn = readJson(bytes, head.world);
    this.camera = drawn.camera.map((mm) => mm / 1000);
    this.vehicles = drawn.vehicles;  // ids of the bodies of players' vehicles
    this.waters = drawn.waters;
    this.bricks = readBricks(bytes, head.bricks);
    this.regions = drawn.regions;
    this.held = drawn.held / 1000;  // margin around held bodies, m; 0: regions are fixed
    this.motions = new Map(drawn.motions.map((motion) => [motion.id, motion.path]));
    this.pool = drawn.bodies;  // all bodies of all worlds
    this.worlds = drawn.worlds.map((world) => makeWorld(world, this.pool));
    this.views = head.views.map((view) => new View(this, view, bytes, units));
    this.names = new Map(drawn.bodies.map((body) => [body.id, body.name]));
  }
  seconds(tick) {
    return (this.first + tick) / this.hz;
  }
  view(peer) {
    return this.views.find((view) => view.peer === peer) || this.views[0];
  }
}

function makeWorld(world, bodies) {
  const moving = world.moving.map((index) => bodies[index]);
  const anchored = world.anchored.map(([index, x, y, a]) => ({body: bodies[index], x, y, a}));
  return {
    moving,
    anchored,
    joints: world.joints,
    holes: world.holes,
    byId: new Map(moving.map((body) => [body.id, body])),
    anchoredById: new Map(anchored.map((entry) => [entry.body.id, entry])),
  };
}

// Returns [x, y, angle] in metres and radians, interpolated linearly between ticks; null where the
// body is not known.
function poseOf(track, tick) {
  if (!track) return null;
  const i = Math.max(0, Math.floor(tick));
  if (i >= track.has.length || !track.has[i]) return null;
  const blend = tick - i;
  const j = blend > 0 && i + 1 < track.has.length && track.has[i + 1] ? i + 1 : i;
  const mix = (column) => (column[i] + blend * (column[j] - column[i])) / 1000;
  return [mix(track.x), mix(track.y), mix(track.a)];
}

// Returns the regions where they are not fixed, the box around the bodies under each client's
// authority in a view: [{peer, corners}] by peer, corners in millimetres.
function heldRegions(view, tick) {
  const boxes = new Map();
  if (view.run.held === 0) return [];
  for (const body of view.worldAt(tick).moving) {
    const track = view.tracks.bodies.get(body.id);
    const pose = poseOf(track, tick);
    const peer = pose ? Math.floor(track.owner[Math.floor(tick)] / 3) : 0;
    if (peer <= 0) continue;
    const reach = body.reach / 1000 + view.run.held;
    const box = boxes.get(peer) || [Infinity, Infinity, -Infinity, -Infinity];
    boxes.set(peer, [
      Math.min(box[0], pose[0] - reach),
      Math.min(box[1], pose[1] - reach),
      Math.max(box[2], pose[0] + reach),
      Math.max(box[3], pose[1] + reach),
    ]);
  }
  return [...boxes].sort((a, b) => a[0] - b[0]).map(([peer, box]) => {
    const [x0, y0, x1, y1] = box.map((m) => 1000 * m);
    return {peer, corners: [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]};
  });
}

function anchoredPose(run, entry, tick) {
  const path = run.motions.get(entry.body.id);
  if (!path) return [entry.x / 1000, entry.y / 1000, entry.a / 1000];
  const i = Math.min(run.count - 1, Math.max(0, Math.floor(tick)));
  const j = Math.min(run.count - 1, i + 1);
  const blend = tick - i;
  return [0, 1, 2].map((k) => (path[3 * i + k] * (1 - blend) + path[3 * j + k] * blend) / 1000);
}

// Returns the least value that at least `share` of all do not exceed, as in seam-measure.
function percentile(values, share) {
  if (values.length === 0) return NaN;
  const sorted = Float64Array.from(values).sort();
  return sorted[Math.max(1, Math.ceil(share * sorted.length)) - 1];
}

// Returns {rms, p95, max, count} of a measure over views, from tick `from` to `to`, both included;
// equals the output of seam-measure --more --from --to for the same views.
function rangeStats(views, measure, from, to) {
  const values = [];
  let sum = 0;
  let count = 0;
  for (const view of views) {
    if (measure === 'error') {
      for (const track of view.tracks.bodies.values()) {
        for (let i = from; i <= to; ++i) {
          if (track.error[i] >= 0) values.push(track.error[i] * view.units.error);
        }
      }
      continue;
    }
    // All three ticks of a difference must lie in the range.
    const begin = measure === 'stutter' ? from + 2 : from;
    const curve = view.curve(measure);
    const weights = view[measure] && view[measure].count;
    for (let i = begin; i <= to; ++i) {
      if (Number.isNaN(curve[i])) continue;
      values.push(curve[i]);
      const weight = weights ? weights[i] : 1;
      sum += weight * curve[i] ** 2;
      count += weight;
    }
  }
  if (measure === 'error') {
    for (const value of values) sum += value * value;
    count = values.length;
  }
  const max = values.reduce((most, value) => Math.max(most, value), -Infinity);
  return {
    rms: count > 0 ? Math.sqrt(sum / count) : NaN,
    p95: percentile(values, 0.95),
    max: values.length > 0 ? max : NaN,
    count,
  };
}

// Returns tick and body of the largest error of some views; null if none is known.
function worstMoment(views) {
  let worst = null;
  for (const view of views) {
    for (const track of view.tracks.bodies.values()) {
      track.error.forEach((units, tick) => {
        if (units >= 0 && !(worst && units <= worst.units))
          worst = {units, tick, view, id: track.id};
      });
    }
  }
  return worst;
}

// Returns the first tick at which a body of some views is a centimetre or more from the oracle.
const DIVERGED = 0.01;
function firstDivergence(views) {
  let first = null;
  for (const view of views) {
    for (const track of view.tracks.bodies.values()) {
      const tick = track.error.findIndex((units) => units * view.units.error >= DIVERGED);
      if (tick >= 0 && (!first || tick < first.tick)) first = {tick, view, id: track.id};
    }
  }
  return first;
}
