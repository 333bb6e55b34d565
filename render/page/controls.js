// Buttons, lists and keys, connected to the page once it has its data.

const KEYS = [
  ['Space', 'play or pause'],
  ['← →', 'one tick'],
  ['Shift ← →', 'event before, next event'],
  ['Home End', 'first tick, last tick'],
  ['- +', 'slower, faster'],
  ['w', 'worst moment'],
  ['g', 'first divergence'],
  ['e', 'curves around the nearest event, all panels over each other'],
  ['f 0', 'fit to the action, to the scene'],
  ['Esc', 'stop following'],
  ['o d v h r n k c', 'layers: oracle, dots, vectors, heat, regions, names, onion, contacts'],
  ['drag, wheel', 'a drag moves the camera, the wheel zooms; all panels together'],
];

function addToggles(page) {
  for (const [name, layer] of Object.entries(LAYERS)) {
    const button =
        element('button', layer.name, {type: 'button', title: `${layer.hint} (${layer.key})`});
    button.dataset.layer = name;
    button.addEventListener('click', () => toggleLayer(page, name));
    $('layers').append(button);
  }
  for (const [mode, name] of Object.entries(MODES)) {
    const button = element('button', name, {type: 'button'});
    button.dataset.mode = mode;
    button.addEventListener('click', () => setMode(page, mode));
    $('modes').append(button);
  }
}

function toggleLayer(page, name) {
  state.layers[name] = !state.layers[name];
  page.changed();
}

// Wipe and difference compare the first two panels.
function setMode(page, mode) {
  state.mode = mode;
  if (mode !== 'side' && state.panels.length < 2) state.panels.push(otherPanel(page));
  addPanelHeads(page);
  page.changed();
}

function otherPanel(page) {
  const shown = (run, peer) => state.panels.some((p) => p.run === run && p.peer === peer);
  for (const run of page.runs)
    for (const view of run.views)
      if (!shown(run.index, view.peer)) return {run: run.index, peer: view.peer};
  return {...state.panels[0]};
}

function panelHead(page, panel, index) {
  const head = element('div', '', {className: 'panel-head'});
  const select = element('select');
  select.setAttribute('aria-label', `View of panel ${index + 1}`);
  for (const run of page.runs)
    for (const view of run.views)
      select.append(element('option', view.label(), {value: `${run.index}.${view.peer}`}));
  select.value = `${panel.run}.${panel.peer}`;
  select.addEventListener('change', () => {
    [panel.run, panel.peer] = select.value.split('.').map(Number);
    page.changed();
  });
  head.append(swatch(curveColour(index)), select, element('output'));
  const close = element('button', '×', {type: 'button', title: 'Close this panel'});
  close.hidden = state.panels.length < 2;
  close.addEventListener('click', () => {
    state.panels.splice(index, 1);
    if (state.panels.length < 2) state.mode = 'side';
    addPanelHeads(page);
    page.changed();
  });
  const add = element('button', '+', {type: 'button', title: 'Add a panel'});
  add.hidden = index !== state.panels.length - 1 || state.panels.length >= 12;
  add.addEventListener('click', () => {
    state.panels.push(otherPanel(page));
    addPanelHeads(page);
    page.changed();
  });
  head.append(close, add);
  return head;
}

function addPanelHeads(page) {
  const heads = state.panels.map((panel, index) => panelHead(page, panel, index));
  $('panel-heads').replaceChildren(...heads);
}

function addLegend(page) {
  const kinds = new Set(page.runs.flatMap((run) => run.events.map((event) => event.kind)));
  const entries = [];
  for (const [kind, look] of Object.entries(EVENT_KINDS)) {
    if (!kinds.has(kind)) continue;
    const entry = element('span');
    entry.append(swatch(themed(look.colour)), look.name);
    entries.push(entry);
  }
  $('legend').replaceChildren(...entries);
}

// Explains the colours of bodies: whose machine simulates them.
function addOwners(page) {
  const views = page.runs.flatMap((run) => run.views);
  const named = new Map(views.map((view) => [view.peer, view.name]));
  const entries = [...named].sort((a, b) => a[0] - b[0]).slice(0, 12).map(([peer, name]) => {
    const entry = element('span');
    entry.append(swatch(peerColour(peer)), name);
    return entry;
  });
  const more = named.size > 12 ? `and ${named.size - 12} more; ` : '';
  $('owners').replaceChildren(
      element('span', 'Simulated by'), ...entries,
      element('span', `${more}paler in views that only follow or show it`));
}

function wireButtons(page) {
  const click = (id, act) => $(id).addEventListener('click', act);
  click('play', () => page.player.toggle());
  click('back', () => page.player.step(-1));
  click('forward', () => page.player.step(1));
  click('previous', () => page.goEvent(-1));
  click('next', () => page.goEvent(1));
  click('worst', () => page.goWorst());
  click('diverge', () => page.goDivergence());
  click('fit-scene', () => page.fitScene());
  click('fit-action', () => page.fitAction());
  click('around', () => page.toggleAround());
  click('unfollow', () => page.follow(state.follow));
  click('range-clear', () => {
    state.range = null;
    page.changed();
  });
  click('help-open', () => $('help').showModal());
  for (const [keys, meaning] of KEYS) $('keys').append(element('dt', keys), element('dd', meaning));
  for (const speed of SPEEDS)
    $('speed').append(element('option', speedName(speed), {value: speed}));
  $('speed').addEventListener('change', () => {
    state.speed = Number($('speed').value);
    page.changed();
  });
  for (const [name, measure] of Object.entries(MEASURES))
    $('measure').append(element('option', `${measure.name} (${measure.unit})`, {value: name}));
  $('measure').value = state.measure;
  $('measure').addEventListener('change', () => {
    state.measure = $('measure').value;
    page.changed();
  });
  $('scrub').max = page.player.last;
  $('scrub').addEventListener('input', () => {
    state.playing = false;
    page.player.go(Number($('scrub').value));
  });
}

function wireSaving(page) {
  const name =
      page.runs.map((run) => run.name).join('-').replace(/[^A-Za-z0-9_-]/g, '_').slice(0, 80);
  const file = (ending) => `${name || 'review'}-tick${Math.floor(state.tick)}.${ending}`;
  $('save-png')
      .addEventListener('click', () => $('world').toBlob((blob) => saveBlob(blob, file('png'))));
  $('save-svg')
      .addEventListener(
          'click', () => saveBlob(new Blob([svgOf(page)], {type: 'image/svg+xml'}), file('svg')));
  $('save-csv').addEventListener('click', () => {
    const views = page.views();
    const csv =
        page.around ? aroundCsv(page.around, views, state.measure) : csvOf(views, page.range());
    saveBlob(new Blob([csv], {type: 'text/csv'}), file('csv'));
  });
}

function svgOf(page) {
  const [width, height] = [$('world').clientWidth, $('world').clientHeight];
  const svg = new SvgContext(width, height);
  page.drawWorlds(svg, width, height);
  return svg.document();
}

function wireKeys(page) {
  const acts = {
    ' ': () => page.player.toggle(),
    'ArrowLeft': (event) => (event.shiftKey ? page.goEvent(-1) : page.player.step(-1)),
    'ArrowRight': (event) => (event.shiftKey ? page.goEvent(1) : page.player.step(1)),
    'Home': () => page.player.go(0),
    'End': () => page.player.go(page.player.last),
    '-': () => page.player.faster(-1),
    '+': () => page.player.faster(1),
    '=': () => page.player.faster(1),
    'w': () => page.goWorst(),
    'g': () => page.goDivergence(),
    'f': () => page.fitAction(),
    '0': () => page.fitScene(),
    'e': () => page.toggleAround(),
    'Escape': () => state.follow !== null && page.follow(state.follow),
    '?': () => $('help').showModal(),
  };
  for (const [name, layer] of Object.entries(LAYERS))
    acts[layer.key] = () => toggleLayer(page, name);
  document.addEventListener('keydown', (event) => {
    const at = event.target;
    if (event.ctrlKey || event.metaKey || event.altKey || $('help').open) return;
    if (takesKeys(at) || (at.tagName === 'BUTTON' && event.key === ' ')) return;
    if (!Object.hasOwn(acts, event.key)) return;
    event.preventDefault();
    acts[event.key](event);
  });
}

function titles(page) {
  const [run] = page.runs;
  const scenes = [...new Set(page.runs.map((one) => one.title || one.scene))];
  $('title').textContent = scenes.join(', ');
  document.title = `${scenes.join(', ')} · Seam2D review`;
  const labels = page.runs.map((one) => `${one.name}: ${one.label}`).join('; ');
  const network = run.network ? ` · network ${run.network}` : '';
  $('subtitle').textContent = `${labels}${network} · ${run.hz} ticks/s`;
  const damage = page.runs.flatMap((one) => one.damage.map((line) => `${one.name}: ${line}`));
  $('damage').textContent = `Damaged, so figures may be wrong: ${damage.join('; ')}.`;
  $('damage').hidden = damage.length === 0;
}

function openPage(head, bytes) {
  const page = new Page(head, bytes);
  window.review = {page, state};
  titles(page);
  addToggles(page);
  addPanelHeads(page);
  addLegend(page);
  addOwners(page);
  wireButtons(page);
  wireCamera(page);
  wireStrip(page);
  wireSaving(page);
  wireKeys(page);
  new ResizeObserver(() => page.changed()).observe($('world'));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    readTheme();
    addPanelHeads(page);
    addLegend(page);
    addOwners(page);
    page.changed();
  });
  window.addEventListener('hashchange', () => {
    readFragment(page.runs);
    addPanelHeads(page);
    page.changed();
  });
  page.changed();
  return page;
}

async function start() {
  readTheme();
  const data = $('data').textContent.trim();
  if (data === '') return followLive();
  const {head, bytes} = splitData(await inflate(data));
  openPage(head, bytes);
}

start().catch((error) => {
  $('failure').textContent =
      `This page cannot be shown: ${error.message}. It needs a browser of 2023 or later.`;
  $('failure').hidden = false;
  throw error;
});
