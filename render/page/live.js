// A page of a running session: events of the server (render/view/live_feed.h) become ticks of its
// one run, and the page follows the newest tick unless the viewer pauses or goes back.

const LAG_SECONDS = 0.15;  // the page shows ticks so long after they came, so that it is smooth
const DRIVER_LAG_SECONDS = 0.05;
const SILENT_SECONDS = 2;  // after that it says that nothing comes
const ERROR_UNIT_M = 1e-4;  // of the errors against the oracle that are sent
const TABLE_SECONDS = 10;  // of the past in tables and ranges

class LivePlayer extends Player {
  constructor(page) {
    super(page.runs, () => page.changed());
    this.page = page;
    this.shown_ms = null;
    this.lag_s = LAG_SECONDS;
  }
  go(tick) {
    state.live = false;
    super.go(tick);
  }
  pause() {
    state.live = false;
    super.pause();
  }
  toggle() {
    if (state.live) return this.pause();
    if (!state.playing && state.tick >= this.last) return this.follow();
    super.toggle();
  }
  follow() {
    state.playing = false;
    state.live = true;
    this.shown_ms = null;
    this.changed();
  }
  // Follows the newest tick evenly, whatever the rhythm in which ticks come.
  advance(now_ms) {
    const passed_s = this.shown_ms === null ? 0 : Math.min((now_ms - this.shown_ms) / 1000, 0.25);
    this.shown_ms = now_ms;
    if (state.playing && state.tick >= this.last) this.follow();
    if (!state.live) return;
    const target = Math.max(0, this.last - this.lag_s * this.hz);
    const even = state.tick + passed_s * this.hz;
    const off = target - even;
    const jump = Math.abs(off) > this.hz / 2;
    const next = jump ? target : even + off * Math.min(1, 3 * passed_s);
    state.tick = Math.min(Math.max(next, jump ? 0 : state.tick), this.last);
    this.changed();
  }
}

function sayLive(text) {
  $('live-state').textContent = text;
  $('live-state').hidden = text === '';
}

// Shows the driven player's view and the server's; without a driver all views of a small room.
function livePanels(page, player) {
  const [run] = page.runs;
  const own = run.views.find((view) => view.name.startsWith(`${player} (`));
  const server = run.views.find((view) => view.peer === 0);
  const few = run.views.length <= 4 ? run.views : [run.views.find((view) => view.peer > 0), server];
  const chosen = own ? [own, server] : few;
  state.panels = chosen.filter(Boolean).map((view) => ({run: 0, peer: view.peer}));
}

// The connection of a page with its server.
class LiveSource {
  constructor() {
    this.page = null;
    this.player = '';
    this.heard_ms = performance.now();
    this.events = 0;
    this.bytes = 0;
    this.work = Promise.resolve();  // events are handled one after the other
    this.source = new EventSource('live');
    const kinds =
        ['waiting', 'start', 'worlds', 'peers', 'frames', 'marks', 'stats', 'errors', 'control'];
    for (const kind of kinds)
      this.source.addEventListener(kind, (event) => this.queue(kind, event.data));
    this.source.onerror = () => sayLive('The view is gone; trying again.');
    requestAnimationFrame((now) => this.frame(now));
  }
  queue(kind, data) {
    ++this.events;
    this.bytes += data.length;
    this.work = this.work.then(() => this[kind](data)).catch((error) => {
      sayLive(`This page cannot go on: ${error.message}`);
      this.source.close();
      throw error;
    });
  }

  waiting(data) {
    sayLive(`Waiting for ${JSON.parse(data)}.`);
  }
  async start(data) {
    const {player, oracle, data: packed} = JSON.parse(data);
    const {head, bytes} = splitData(await inflate(packed));
    const first = this.page === null;
    this.player = player;
    if (first) {
      MEASURES.error.name = 'Apart from the server\'s view';
      for (const layer of ['truth', 'vectors']) {
        delete LAYERS[layer];
        delete state.layers[layer];
      }
      delete MEASURES.path;
      delete MEASURES.stutter;
      if (oracle === 'beside')
        MEASURES.truth = {
          name: 'Error against the oracle, at the tick shown',
          unit: 'm',
          log: true,
          each: 'tick',
        };
      this.late = oracle === 'late';
      this.page = openPage(head, bytes);
      this.page.player = new LivePlayer(this.page);
      this.page.word = 'distance';
      for (const cell of document.querySelectorAll('th'))
        if (cell.textContent === 'error now') cell.textContent = 'distance now';
      $('diverge').hidden = true;
      this.page.range = () => state.range || [
        Math.max(0, this.page.player.last - TABLE_SECONDS * this.page.player.hz),
        this.page.player.last
      ];
      $('live').hidden = false;
      document.addEventListener('keydown', (event) => {
        if (event.key === 'l' && !takesKeys(event.target)) this.page.player.follow();
      });
      $('live').addEventListener('click', () => this.page.player.follow());
      wireDrive(this);
      this.controls = new Control(this, new URLSearchParams(location.search).get('token'));
    } else {
      this.page.load(head, bytes);
      titles(this.page);
    }
    const {page} = this;
    page.tape = new Tape(page.runs[0]);
    page.player.runs = page.runs;
    const known = (panel) => page.runs[0].views.some((view) => view.peer === panel.peer);
    if (first || !state.panels.every(known)) livePanels(page, player);
    if (first) {
      state.camera = null;
      state.range = null;
      state.layers.dots = true;
    }
    sayLive('');
    document.title = document.title.replace('review', 'live');
    this.renamed();
    this.grew();
    page.player.follow();
    this.said();
  }
  worlds(data) {
    const [run] = this.page.runs;
    const {body, bodies, world, worlds} = JSON.parse(data);
    run.pool.splice(body, bodies.length, ...bodies);
    for (const one of bodies) run.names.set(one.id, one.name);
    worlds.forEach((one, i) => (run.worlds[world + i] = makeWorld(one, run.pool)));
  }
  peers(data) {
    const names = new Map(JSON.parse(data));
    for (const [peer] of names) this.page.tape.viewOf(peer);
    for (const view of this.page.runs[0].views)
      if (names.has(view.peer)) view.name = names.get(view.peer);
    this.renamed();
  }
  frames(data) {
    if (!this.page) return;
    this.heard_ms = performance.now();
    const text = atob(data);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    this.page.tape.read(bytes);
    this.grew();
  }
  marks(data) {
    const [run] = this.page.runs;
    for (const event of JSON.parse(data)) run.events.push({...event, at: event.tick - run.first});
    if (run.events.length > 2000) run.events.splice(0, 1000);
    addLegend(this.page);
    this.said();
  }
  // Shows the newest line of the room, and keeps a warning in sight.
  said() {
    const {events} = this.page.runs[0];
    const line = events.findLast((event) => event.kind === 'note' || event.kind === 'warning');
    const warning = events.findLast((event) => event.kind === 'warning');
    if (line && line !== this.line && state.live) this.page.tell(this.page.eventText(line));
    this.line = line;
    this.warning = warning ? warning.text : '';
  }
  stats(data) {
    for (const [peer, row] of JSON.parse(data)) {
      const view = this.page.runs[0].view(peer);
      if (view.peer === peer) view.stats.push(row);
      view.renewCurves();
    }
  }
  errors(data) {
    if (!this.page) return;
    const {behind, rows} = JSON.parse(data);
    this.behind_s = behind;
    for (const [peer, tick, units] of rows)
      this.page.tape.writeError(peer, tick, units * ERROR_UNIT_M);
    this.page.changed();
  }

  // The present values of what an operator changes.
  control(data) {
    if (!this.page) return;
    const first = this.controls.values === null;
    this.controls.show(JSON.parse(data));
    this.page.runs[0].network = this.controls.values.impair;
    titles(this.page);
    document.title = document.title.replace('review', 'live');
    if (first && this.controls.token) wireHand(this.page, this.controls);
  }

  renamed() {
    addPanelHeads(this.page);
    addOwners(this.page);
  }
  grew() {
    const {page} = this;
    const dropped = page.tape.shifted;
    page.tape.shifted = 0;
    state.tick = Math.max(0, state.tick - dropped);
    if (state.range) state.range = state.range.map((tick) => Math.max(0, tick - dropped));
    if (state.around !== null) state.around -= dropped;
    page.player.last = page.runs[0].count - 1;
    $('scrub').max = page.player.last;
    page.changed();
  }
  frame(now_ms) {
    requestAnimationFrame((now) => this.frame(now));
    if (!this.page) return;
    this.page.player.advance(now_ms);
    const silent_s = (performance.now() - this.heard_ms) / 1000;
    if (this.source.readyState !== EventSource.OPEN) return;
    sayLive(
        silent_s > SILENT_SECONDS ? `Nothing has come for ${Math.floor(silent_s)} s: ` +
                'the session is over or stands still.' :
            this.late    ? 'No errors against the oracle: the view began after the session.' :
            this.warning ? `Warning: ${this.warning}` :
            this.behind_s > 2 ? `The oracle is ${Math.floor(this.behind_s)} s late.` :
                                '');
  }
}

function followLive() {
  $('title').textContent = 'Seam2D live';
  document.title = 'Seam2D live';
  window.live = new LiveSource();
}
