// The viewer's choices, stored in the address, so that a link shows the same page.

const LAYERS = {
  truth: {name: 'Oracle', key: 'o', hint: 'outline of the truth where the view differs'},
  dots: {name: 'Dots', key: 'd', hint: 'a dot per tick: uneven dots are stutter'},
  vectors: {name: 'Vectors', key: 'v', hint: 'from the truth to what is shown'},
  heat: {name: 'Heat', key: 'h', hint: 'bodies coloured by their error'},
  regions: {name: 'Regions', key: 'r', hint: 'regions and buffer zones'},
  names: {name: 'Names', key: 'n', hint: 'names of bodies'},
  onion: {name: 'Onion', key: 'k', hint: 'outlines of the last 0.75 s, the older the paler'},
  contacts: {name: 'Contacts', key: 'c', hint: 'impacts of the last half second'},
};
const SPEEDS = [1 / 16, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4];
const MODES = {
  side: 'Side by side',
  wipe: 'Wipe',
  difference: 'Difference'
};

const state = {
  panels: [],  // {run, peer}
  mode: 'side',
  wipe: 0.5,  // share of the width that shows the first panel
  tick: 0,
  speed: 1,
  playing: false,
  live: false,   // follows the newest tick of a running session
  camera: null,  // {x, y, height}: m; null: fit the scene
  follow: null,  // id of a body
  layers: {truth: true, dots: false, vectors: false, heat: false, contacts: true},
  measure: 'error',
  range: null,   // [tick, tick], both included
  around: null,  // tick of the first panel's event around which the strip is; null: all of time
};

function writeFragment() {
  const words = [
    't=' + Math.round(state.tick * 100) / 100,
    'v=' + state.panels.map((panel) => `${panel.run}.${panel.peer}`).join(','),
    'm=' + state.mode,
    'l=' + Object.keys(LAYERS).filter((name) => state.layers[name]).join(','),
    's=' + state.measure,
  ];
  if (state.speed !== 1) words.push('x=' + state.speed);
  if (state.mode === 'wipe') words.push('w=' + state.wipe.toFixed(3));
  if (state.follow !== null) words.push('f=' + state.follow);
  if (state.range) words.push('r=' + state.range.join(','));
  if (state.around !== null) words.push('e=' + state.around);
  if (state.camera)
    words.push('c=' + ['x', 'y', 'height'].map((k) => state.camera[k]).join(','));  // exactly
  history.replaceState(null, '', '#' + words.join('&'));
}

const numbersOf = (text) => text.split(',').map(Number);

// Applies the choices that are valid for these runs; the rest stays as it is.
function readFragment(runs) {
  const words = new Map(
      location.hash.slice(1).split('&').map((word) => [word.split('=')[0], word.split('=')[1]]));
  const last = Math.max(...runs.map((run) => run.count - 1));
  const within = (tick) => Math.min(Math.max(tick, 0), last);
  const number = (key) => (words.get(key) ? Number(words.get(key)) : NaN);
  if (words.get('v')) {
    const panels = words.get('v').split(',').map((word) => {
      const [run, peer] = word.split('.').map(Number);
      return {run, peer};
    });
    const known = panels.filter(
        ({run, peer}) => runs[run] && runs[run].views.some((view) => view.peer === peer));
    if (known.length > 0) state.panels = known;
  }
  if (!Number.isNaN(number('t'))) state.tick = within(number('t'));
  if (Object.hasOwn(MODES, words.get('m') || '')) state.mode = words.get('m');
  if (Object.hasOwn(MEASURES, words.get('s') || '')) state.measure = words.get('s');
  if (SPEEDS.includes(number('x'))) state.speed = number('x');
  if (number('w') >= 0 && number('w') <= 1) state.wipe = number('w');
  if (Number.isInteger(number('f'))) state.follow = number('f');
  if (words.has('l')) {
    const on = (words.get('l') || '').split(',');
    for (const name of Object.keys(LAYERS)) state.layers[name] = on.includes(name);
  }
  const range = numbersOf(words.get('r') || '');
  if (range.length === 2 && range.every(Number.isInteger))
    state.range = [within(Math.min(...range)), within(Math.max(...range))];
  state.around = Number.isInteger(number('e')) ? number('e') : null;
  const camera = numbersOf(words.get('c') || '');
  if (camera.length === 3 && camera.every(Number.isFinite) && camera[2] > 0)
    state.camera = {x: camera[0], y: camera[1], height: camera[2]};
}
