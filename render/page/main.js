// The page: layout of the panels, and the actions of clicks, drags and keys.

const $ = (id) => document.getElementById(id);
// True for elements that use the keys of a text or a list themselves.
const takesKeys = (at) =>
    at.tagName === 'SELECT' || (at.tagName === 'INPUT' && at.type !== 'range');

class Page {
  constructor(head, bytes) {
    this.load(head, bytes);
    this.strip = new Strip($('strip'));
    this.marks = new Marks($('marks'));
    this.losses = new Losses($('losses'));
    this.drawing = false;
    this.word = 'error';  // for the distance that the page measures
    this.firstPanels();
    this.player = new Player(this.runs, () => this.changed());
    this.firstMoment();
    readFragment(this.runs);
  }

  load(head, bytes) {
    const units = {error: head.error_unit, age: head.age_unit, stutter: head.stutter_unit};
    Object.assign(COLOURS, head.colours);
    for (const run of head.runs)
      for (const [peer, colour] of run.colours) COLOURS.peers[peer] = colour;
    this.runs = [];  // a run asks how many there are
    for (const run of head.runs) this.runs.push(new Run(this, run, bytes, this.runs.length, units));
    for (const run of this.runs) {
      run.events = run.events.map((event) => ({...event, at: event.tick - run.first}));
    }
  }

  // Shows two views side by side: of two runs, or of one run's first and last client; in a large
  // room of its first client and the server, because clients may show only held bodies.
  firstPanels() {
    const [first, second] = this.runs;
    const clientOf = (run) => (run.views.find((view) => view.peer > 0) || run.views[0]).peer;
    state.panels = [{run: 0, peer: clientOf(first)}];
    if (second) {
      state.panels.push({run: 1, peer: clientOf(second)});
    } else if (first.views.length > 1) {
      const others = first.views.filter((view) => view.peer !== state.panels[0].peer);
      state.panels.push({run: 0, peer: others[first.views.length > 9 ? 0 : others.length - 1].peer});
    }
  }

  // Jumps to the strongest impact on the panels, fitting the bodies that move around it; without
  // one, to the first tick that all panels show.
  firstMoment() {
    const views = this.views();
    const first = (view) => Math.max(0, view.tracks.world.findIndex((world) => world >= 0));
    state.tick = Math.max(...views.map(first));
    const impacts = this.events().filter((event) => event.kind === 'impact');
    if (impacts.length === 0) return;
    state.tick = impacts.reduce((most, event) => (event.size > most.size ? event : most)).at;
    const box = actionBox(views[0], state.tick, []);
    const rects = this.layout($('world').clientWidth, $('world').clientHeight);
    if (box) state.camera = fitBox(box, rects[0]);
  }

  views() {
    return state.panels.map(({run, peer}) => this.runs[run].view(peer));
  }
  // Returns the events of the runs on the panels, each once.
  events() {
    const runs = new Set(this.views().map((view) => view.run));
    return [...runs]
        .flatMap((run) => run.events)
        .filter((event) => event.at >= 0)
        .sort((a, b) => a.at - b.at);
  }
  range() {
    return state.range || [0, this.player.last];
  }

  // Draws once before the next frame, whatever the number of changes.
  changed() {
    if (this.drawing) return;
    this.drawing = true;
    requestAnimationFrame((now) => {
      this.drawing = false;
      this.draw(now);
    });
  }

  // Returns the panels' rectangles on the canvas: in the columns that show the scene largest.
  layout(width, height) {
    const count = state.mode === 'side' ? state.panels.length : 1;
    const [minX, minY, maxX, maxY] = this.views()[0].run.camera;
    const aspect = Math.min((maxX - minX) / Math.max(maxY - minY, 1), 5);
    let best = null;
    for (let columns = 1; columns <= count; ++columns) {
      const rows = Math.ceil(count / columns);
      const [w, h] = [(width - columns + 1) / columns, (height - rows + 1) / rows];
      const score = Math.min(w / aspect, h);
      if (!best || score > best.score) best = {columns, rows, w, h, score};
    }
    return Array.from({length: count}, (_, i) => ({
                                         x: (i % best.columns) * (best.w + 1),
                                         y: Math.floor(i / best.columns) * (best.h + 1),
                                         width: best.w,
                                         height: best.h,
                                       }));
  }

  drawWorlds(c, width, height) {
    const views = this.views();
    const rects = this.layout(width, height);
    this.rects = rects;
    const at = (view) => Math.min(state.tick, view.run.count - 1);
    const camera = cameraAt(views[0], at(views[0]), rects[0]);
    this.camera = camera;
    const title = (i, side, text) =>
        ({text: text || views[i].label(), colour: curveColour(i), side});
    if (state.mode === 'side') {
      views.forEach((view, i) => {
        const titles = views.length > 1 ? [title(i, 'left')] : [];
        drawPanel(c, rects[i], camera, view, at(view), titles, this.word);
      });
      return;
    }
    const second = views[1] || views[0];
    const [rect] = rects;
    if (state.mode === 'difference') {
      const titles = [title(0, 'left'), title(1, 'right', `from ${second.label()}`)];
      drawPanel(c, rect, camera, views[0], at(views[0]), titles, 'apart', second);
      return;
    }
    const titles = [title(0, 'left'), title(1, 'right', second.label())];
    drawPanel(c, rect, camera, second, at(second), titles, this.word);
    c.save();
    c.beginPath();
    c.rect(0, 0, state.wipe * width, height);
    c.clip();
    drawPanel(c, rect, camera, views[0], at(views[0]), titles, this.word);
    c.restore();
  }

  draw(now_ms) {
    this.around = this.aroundEvent(this.views());
    // Losses lie below a strip of the same time.
    this.losses.place(this.around ? [] : [...new Set(this.views().map((view) => view.run))]);
    const canvas = $('world');
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const c = canvas.getContext('2d');
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.drawWorlds(c, width, height);
    if (this.hand) this.hand.draw(c);
    const views = this.views();
    this.drawStrip(views);
    this.marks.draw(this.events(), state.tick, this.player.last);
    this.losses.draw(state.tick, this.player.last);
    this.drawControls(views);
    // Tables are slow to lay out: updated four times a second while playing.
    const moving = state.playing || state.live;
    if (!moving || !(now_ms - this.tables_ms < 250)) {
      this.tables_ms = now_ms;
      this.drawTables(views);
      if (!this.tape) writeFragment();
    }
  }

  // Draws all of time, or the time around an event, where ticks count from the strip's left end.
  drawStrip(views) {
    const curves = views.map((view) => view.curve(state.measure));
    const [{run}] = views;
    $('around').setAttribute('aria-pressed', String(this.around !== null));
    $('around-text').textContent = this.around ? this.around.text(views) : '';
    if (!this.around) {
      this.strip.draw(
          curves, state.measure, state.tick, state.range, (tick) => run.seconds(tick),
          this.player.last);
      return;
    }
    const {around} = this;
    const shifted = (tick) => Math.min(Math.max(tick - around.first, 0), around.last);
    const [from, to] = state.range || [0, -1];
    const seen = from <= around.first + around.last && to >= around.first;
    this.strip.draw(
        curves.map((curve, i) => around.cut(curve, i)), state.measure, state.tick - around.first,
        seen ? [shifted(from), shifted(to)] : null, (tick) => around.seconds(tick), around.last,
        around.before);
  }
  // Returns the event around which the strip is; null where it shows all of time.
  aroundEvent(views) {
    if (state.around === null) return null;
    const event = nearestEvent(views[0].run, state.around);
    return event ? new Around(event, views) : null;
  }
  toggleAround() {
    const event = nearestEvent(this.views()[0].run, state.tick);
    state.around = state.around === null && event ? event.at : null;
    if (!event) this.tell('no event is known');
    this.changed();
  }
  // Returns the tick under a place of the strip.
  stripTick(px) {
    const tick = this.strip.tickAt(px) + (this.around ? this.around.first : 0);
    return Math.min(Math.max(tick, 0), this.player.last);
  }

  drawControls(views) {
    const run = views[0].run;
    const tick = Math.floor(state.tick);
    $('clock').textContent = `${run.seconds(state.tick).toFixed(3)} s · tick ${run.first + tick}`;
    $('scrub').value = tick;
    const moving = state.playing || state.live;
    $('play').textContent = moving ? '❚❚' : '▶';
    $('play').setAttribute('aria-label', moving ? 'Pause' : 'Play');
    $('live').setAttribute('aria-pressed', String(state.live));
    $('speed').value = state.speed;
    $('divider').hidden = state.mode !== 'wipe';
    $('divider').style.left = `${100 * state.wipe}%`;
    $('divider').setAttribute('aria-valuenow', Math.round(100 * state.wipe));
    $('unfollow').hidden = state.follow === null;
    for (const button of document.querySelectorAll('[data-layer]'))
      button.setAttribute('aria-pressed', String(Boolean(state.layers[button.dataset.layer])));
    for (const button of document.querySelectorAll('[data-mode]'))
      button.setAttribute('aria-pressed', String(state.mode === button.dataset.mode));
    $('measure').value = state.measure;
    document.querySelectorAll('.panel-head output').forEach((output, i) => {
      const error = views[i].curve('error')[tick];
      output.textContent =
          error === undefined || Number.isNaN(error) ? '' : `${this.word} ${formatLength(error)}`;
    });
  }

  drawTables(views) {
    const range = this.range();
    const run = views[0].run;
    const measure = MEASURES[state.measure];
    $('range-hint').textContent = `${measure.name}, ${run.seconds(range[0]).toFixed(2)} to ${
                                      run.seconds(range[1]).toFixed(2)} s` +
        ` (ticks ${run.first + range[0]}–${run.first + range[1]}); p95 and max over each ${
                                      measure.each}.` +
        (state.range ? '' : ' Drag over the curve to mark a range.');
    $('range-clear').hidden = !state.range;
    const key = [state.measure, range, JSON.stringify(state.panels)].join(' ');
    if (key !== this.rangeKey) fillRangeTable($('range-body'), views, state.measure, range);
    this.rangeKey = key;
    $('bodies-hint').textContent = `The largest ${this.word} on any panel. A click follows a body.`;
    fillBodyTable($('bodies-body'), views, state.tick, range, (id) => this.follow(id));
  }

  follow(id) {
    state.follow = state.follow === id ? null : id;
    if (state.follow !== null && !state.camera)
      state.camera = {...this.camera, height: Math.min(this.camera.height, 12)};
    this.changed();
  }
  fitAction() {
    state.follow = null;
    const view = this.views()[0];
    const box = actionBox(view, state.tick, view.run.vehicles);
    if (box) state.camera = fitBox(box, this.rects[0]);
    this.changed();
  }
  fitScene() {
    state.follow = null;
    state.camera = null;
    this.changed();
  }

  // Moves to a body at a tick, near enough to see its displayed and its true place.
  showBody({tick, view, id}, text) {
    this.player.pause();
    state.follow = null;
    const poses = [view.tracks, view.run.oracle]
                      .map((tracks) => tracks && poseOf(tracks.bodies.get(id), tick))
                      .filter(Boolean);
    const [x, y] = [0, 1].map((k) => poses.map((pose) => pose[k]));
    const body = view.worldAt(tick).byId.get(id);
    const reach = Math.max(3, body ? 1.2 * body.reach / 1000 : 0);
    const [minX, minY] = [x, y].map((places) => Math.min(...places) - reach);
    const [maxX, maxY] = [x, y].map((places) => Math.max(...places) + reach);
    const box = [minX, minY, maxX, maxY];
    if (poses.length > 0) state.camera = fitBox(box, this.rects[0]);
    this.tell(text);
    this.player.go(tick);
  }
  goWorst() {
    const worst = worstMoment(this.views());
    if (!worst) return this.tell(`no ${this.word} is known`);
    if (worst.units === 0) return this.tell(`the ${this.word} is 0 on all views shown`);
    const {view, id} = worst;
    const error = formatLength(worst.units * view.units.error);
    this.showBody(worst, `worst: ${view.run.names.get(id)} is ${error} off on ${view.label()}`);
  }
  goDivergence() {
    const first = firstDivergence(this.views());
    if (!first) return this.tell('no body is ever 1 cm from the oracle');
    const {view, id} = first;
    this.showBody(first, `first: ${view.run.names.get(id)} is 1 cm off on ${view.label()}`);
  }
  goEvent(way) {
    const event = this.player.jump(this.events(), way);
    this.tell(event ? this.eventText(event) : 'no further event');
  }
  eventText(event) {
    const run = this.runs.find((one) => one.events.includes(event));
    const view =
        event.peer >= 0 && event.kind === 'impact' ? ` · ${run.view(event.peer).name}` : '';
    return `${run.seconds(event.at).toFixed(2)} s: ${event.text}${view}`;
  }
  tell(text) {
    $('event-text').textContent = text;
  }
}
