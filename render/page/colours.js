// Colours of authority, runs and errors, and the page's own by its theme.

const COLOURS = {
  peers: [],
  runs: [],
  theme: {}
};

function readTheme() {
  COLOURS.dark = matchMedia('(prefers-color-scheme: dark)').matches;
  const style = getComputedStyle(document.documentElement);
  for (const name
           of ['paper', 'panel', 'frame', 'grid', 'ink', 'faint', 'ground', 'ground-edge', 'water',
               'water-line', 'spark', 'accent'])
    COLOURS.theme[name] = style.getPropertyValue('--' + name).trim();
}

function parseColour(hex) {
  return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
}

function mixColours(a, b, share) {
  const from = parseColour(a);
  const to = parseColour(b);
  const hex = (value) => Math.round(value).toString(16).padStart(2, '0');
  return '#' + from.map((value, i) => hex(value + share * (to[i] - value))).join('');
}

function peerColour(peer) {
  return COLOURS.peers[Math.min(Math.max(peer, 0), COLOURS.peers.length - 1)];
}

function curveColour(index) {
  return themed(COLOURS.runs[index % COLOURS.runs.length]);
}

// Returns a lighter colour in the dark theme.
function themed(colour) {
  return COLOURS.dark ? mixColours(colour, '#ffffff', 0.35) : colour;
}

// Returns the colour at 0..1 of the perceptually uniform map of pictures (render/canvas/palette.h).
function heatColour(share) {
  const at = Math.min(Math.max(share, 0), 1) * (COLOURS.heat.length - 1);
  const i = Math.min(Math.floor(at), COLOURS.heat.length - 2);
  return mixColours(COLOURS.heat[i], COLOURS.heat[i + 1], at - i);
}

// Returns the heat of an error: a millimetre is 0, a metre 1, by the logarithm. The scale is fixed,
// so that colours of two pages can be compared.
const HEAT_MIN = 0.001;
const HEAT_MAX = 1;
function heatOf(error) {
  return Math.log(Math.max(error, HEAT_MIN) / HEAT_MIN) / Math.log(HEAT_MAX / HEAT_MIN);
}

function formatLength(metres) {
  if (metres === null || Number.isNaN(metres)) return '–';
  const size = Math.abs(metres);
  if (size < 0.00005) return '0 mm';
  if (size < 0.0995) return (metres * 1000).toFixed(1) + ' mm';
  if (size < 0.995) return (metres * 100).toFixed(1) + ' cm';
  return metres.toFixed(size < 9.95 ? 2 : 1) + ' m';
}

function formatValue(value, unit) {
  if (unit === 'm') return formatLength(value);
  if (value === null || Number.isNaN(value)) return '–';
  return `${value.toFixed(Math.abs(value) < 10 ? 2 : Math.abs(value) < 100 ? 1 : 0)} ${unit}`;
}
