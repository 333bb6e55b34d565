// A run that grows: decodes the frames of a running session (render/view/view_deltas.h), and
// appends them to the columns of its views.

const TAPE_BYTES_MAX = 200e6;  // of all columns; the oldest ticks are dropped beyond that
const TAPE_TICKS_MAX = 10800;
const POSE_BYTES = 23;
const GAP_TICKS_MAX = 30;  // a longer gap between two frames is shown as one
const MOTIONS_PEER = 1024;

function grown(column, length, fill) {
  const made = new column.constructor(length).fill(fill);
  made.set(column.subarray(0, Math.min(length, column.length)));
  return made;
}

class Tape {
  constructor(run) {
    this.run = run;
    this.capacity = run.count;
    this.decoders = new Map();  // by peer: the bodies as last sent, by id
    this.last = new Map();      // by peer: index of its newest frame
    this.shifted = 0;           // ticks dropped so far
    this.compared = new Map();  // by peer: index up to which it is compared with the server
    this.server = run.views.find((view) => view.peer === 0);
    for (const view of run.views) {
      this.adopt(view);
      for (let i = run.count - 1; i >= 0 && !this.last.has(view.peer); --i)
        if (view.tracks.world[i] >= 0) this.last.set(view.peer, i);
    }
    this.reserve(Math.max(1024, 2 * run.count));
    this.compare();
  }

  // Gives a view a column of its distance from the server's view.
  adopt(view) {
    view.apart = new Float64Array(this.capacity).fill(NaN);
    view.truth = new Float64Array(this.capacity).fill(NaN);
    view.renewCurves();
  }

  // Returns the number of bodies in all views.
  bodies() {
    return this.run.views.reduce((sum, view) => sum + view.tracks.bodies.size, 0);
  }

  // Makes all columns that long.
  reserve(length) {
    this.capacity = length;
    for (const view of this.run.views) {
      view.tracks.world = grown(view.tracks.world, length, -1);
      view.tracks.count = length;
      view.apart = grown(view.apart, length, NaN);
      view.truth = grown(view.truth, length, NaN);
      view.renewCurves();
      for (const track of view.tracks.bodies.values()) {
        for (const name of ['has', 'x', 'y', 'a', 'owner', 'age'])
          track[name] = grown(track[name], length, 0);
        track.error = grown(track.error, length, -1);
      }
    }
  }

  // Drops the oldest ticks.
  shift(ticks) {
    const moved = (column, fill) => {
      column.copyWithin(0, ticks);
      column.fill(fill, column.length - ticks);
    };
    for (const view of this.run.views) {
      moved(view.tracks.world, -1);
      moved(view.apart, NaN);
      moved(view.truth, NaN);
      view.renewCurves();
      for (const track of view.tracks.bodies.values()) {
        for (const name of ['has', 'x', 'y', 'a', 'owner', 'age']) moved(track[name], 0);
        moved(track.error, -1);
      }
    }
    for (const path of this.run.motions.values()) path.splice(0, 3 * ticks);
    for (const places of [this.last, this.compared])
      for (const [peer, index] of places) places.set(peer, index - ticks);
    this.run.events = this.run.events.map((event) => ({...event, at: event.at - ticks}))
                          .filter((event) => event.at >= 0);
    this.run.first += ticks;
    this.run.count -= ticks;
    this.shifted += ticks;
  }

  viewOf(peer) {
    const known = this.run.views.find((view) => view.peer === peer);
    if (known) return known;
    const view = Object.assign(Object.create(View.prototype), {
      run: this.run,
      peer,
      name: peer === 0 ? 'server' : `peer ${peer}`,
      stats: [],
      strands: [],
      units: this.run.views[0].units,
      tracks: {
        first: this.run.first,
        count: this.capacity,
        world: new Int32Array(this.capacity).fill(-1),
        bodies: new Map(),
      },
    });
    this.adopt(view);
    this.run.views.push(view);
    this.run.views.sort((a, b) => a.peer - b.peer);
    if (peer === 0) this.server = view;
    return view;
  }

  trackOf(view, id) {
    let track = view.tracks.bodies.get(id);
    if (track) return track;
    const n = this.capacity;
    track = {
      id,
      spans: [],
      has: new Uint8Array(n),
      x: new Int32Array(n),
      y: new Int32Array(n),
      a: new Int32Array(n),
      owner: new Int16Array(n),
      age: new Int32Array(n),  // not sent
      error: new Int32Array(n).fill(-1),
    };
    view.tracks.bodies.set(id, track);
    return track;
  }

  // Reads all frames of an event.
  read(bytes) {
    const reader = new Reader(bytes, [0, bytes.length]);
    while (reader.at < reader.end) this.readFrame(reader);
    for (const [id, path] of this.run.motions) this.holdMotion(path, this.run.count);
    this.compare();
  }

  readFrame(reader) {
    const peer = reader.unsigned();
    const tick = reader.signed();
    const world = reader.unsigned();
    const alone = reader.unsigned() === 1;
    if (alone) this.decoders.set(peer, new Map());
    // Frames that follow one that this page has not seen are read and dropped.
    const known = this.decoders.get(peer);
    const bodies = known || new Map();
    this.readBodies(reader, bodies);
    if (!known) return;
    let index = tick - this.run.first;
    if (index < 0 || index > this.run.count + 100000) return;
    index -= this.makeRoom(index);
    if (peer === MOTIONS_PEER) {
      this.writeMotions(bodies, index);
    } else {
      this.writeView(this.viewOf(peer), world, bodies, index);
    }
    this.run.count = Math.max(this.run.count, index + 1);
  }

  readBodies(reader, bodies) {
    let id = -1;
    for (let k = reader.unsigned(); k > 0; --k) {
      id += reader.unsigned() + 1;
      bodies.delete(id);
    }
    for (const body of bodies.values())
      for (let k = 0; k < 3; ++k) body.pose[k] += body.step[k];
    id = -1;
    for (let k = reader.unsigned(); k > 0; --k) {
      const word = reader.unsigned();
      id += Math.floor(word / 2) + 1;
      const owner = word % 2 === 1 ? reader.unsigned() : -1;
      const rest = [reader.signed(), reader.signed(), reader.signed()];
      let body = bodies.get(id);
      if (!body) {
        bodies.set(id, {pose: rest, step: [0, 0, 0], owner});
        continue;
      }
      if (owner >= 0) body.owner = owner;
      for (let i = 0; i < 3; ++i) {
        body.pose[i] += rest[i];
        body.step[i] += rest[i];
      }
    }
  }

  // Returns the ticks that were dropped to make room for an index.
  makeRoom(index) {
    if (index < this.capacity) return 0;
    const most = Math.max(
        300, Math.min(TAPE_TICKS_MAX, TAPE_BYTES_MAX / POSE_BYTES / Math.max(1, this.bodies())));
    if (index < most) {
      this.reserve(Math.ceil(Math.min(most, 2 * index)) + 1);
      return 0;
    }
    const ticks = Math.min(this.run.count, index - this.capacity + Math.ceil(this.capacity / 4));
    this.shift(ticks);
    if (index - ticks >= this.capacity) this.reserve(index - ticks + 1);
    return ticks;
  }

  writeView(view, world, bodies, index) {
    const before = this.last.get(view.peer);
    const gap = before === undefined ? 0 : index - before;
    const near = gap > 1 && gap <= GAP_TICKS_MAX && before >= 0;
    view.tracks.world[index] = world;
    if (near) view.tracks.world.fill(view.tracks.world[before], before + 1, index);
    for (const [id, body] of bodies) {
      const track = this.trackOf(view, id);
      const [x, y, a] = body.pose;
      track.has[index] = 1;
      track.x[index] = x;
      track.y[index] = y;
      track.a[index] = a;
      track.owner[index] = body.owner;
      if (near && track.has[before]) fillGap(track, before, index);
    }
    this.last.set(view.peer, Math.max(index, before === undefined ? 0 : before));
  }

  writeMotions(bodies, index) {
    for (const [id, body] of bodies) {
      if (!this.run.motions.has(id)) this.run.motions.set(id, []);
      const path = this.run.motions.get(id);
      const known = Math.min(path.length / 3, index);
      for (let i = known; i <= index; ++i) {
        const blend = known === 0 ? 1 : (i - known + 1) / (index - known + 1);
        for (let k = 0; k < 3; ++k) {
          const from = known === 0 ? body.pose[k] : path[3 * (known - 1) + k];
          path[3 * i + k] = from + blend * (body.pose[k] - from);
        }
      }
    }
  }
  // Keeps a kinematic body where it was last known, until more is known.
  holdMotion(path, count) {
    while (path.length >= 3 && path.length < 3 * count) path.push(...path.slice(-3));
  }

  // Sets a view's error against the oracle at a tick.
  writeError(peer, tick, metres) {
    const view = this.run.views.find((one) => one.peer === peer);
    const index = tick - this.run.first;
    if (view && index >= 0 && index < this.capacity) view.truth[index] = metres;
  }

  // Compares views with the server's, tick by tick as both are known.
  compare() {
    if (!this.server) return;
    const known = this.last.get(0);
    for (const view of this.run.views) {
      const last = this.last.get(view.peer);
      if (view === this.server || known === undefined || last === undefined) continue;
      const done = this.compared.has(view.peer) ? this.compared.get(view.peer) : -1;
      for (let i = Math.max(0, done + 1); i <= Math.min(known, last); ++i) this.compareAt(view, i);
      this.compared.set(view.peer, Math.min(known, last));
    }
  }
  compareAt(view, index) {
    let sum = 0;
    let count = 0;
    for (const track of view.tracks.bodies.values()) {
      const other = this.server.tracks.bodies.get(track.id);
      if (!other || !track.has[index] || !other.has[index]) continue;
      const apart = Math.hypot(track.x[index] - other.x[index], track.y[index] - other.y[index]);
      track.error[index] = Math.round(apart / 1000 / view.units.error);
      sum += (apart / 1000) ** 2;
      ++count;
    }
    view.apart[index] = count > 0 ? Math.sqrt(sum / count) : NaN;
  }
}

// Fills the ticks between two known ones by straight lines.
function fillGap(track, from, to) {
  for (let i = from + 1; i < to; ++i) {
    const blend = (i - from) / (to - from);
    for (const column of [track.x, track.y, track.a])
      column[i] = Math.round(column[from] + blend * (column[to] - column[from]));
    track.owner[i] = track.owner[from];
    track.has[i] = 1;
  }
}
