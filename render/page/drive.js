// Drives a player from a page of a running session: keys and a gamepad become inputs, which go to
// the server of the page with the token of its address.

const DRIVE_KEYS = {
  ArrowRight: 'right',
  d: 'right',
  ArrowLeft: 'left',
  a: 'left',
  ArrowUp: 'up',
  w: 'up',
  ArrowDown: 'down',
  s: 'down',
  ' ': '0',
};
for (let i = 0; i < 10; ++i) DRIVE_KEYS[i] = String(i);
const REPEAT_MS = 250;  // inputs that are held are sent again, or the server lets go of them

class Driver {
  constructor(source, token) {
    this.source = source;
    this.token = token;
    this.on = true;
    this.held = new Set();
    this.sent = '0 0 0';
    this.sent_ms = 0;
    this.number = 0;
    document.addEventListener('keydown', (event) => this.key(event, true), true);
    document.addEventListener('keyup', (event) => this.key(event, false), true);
    for (const [where, what] of [
             [window, 'blur'], [window, 'pagehide'], [document, 'visibilitychange']])
      where.addEventListener(what, () => this.letGo());
    setInterval(() => this.send(), 1000 / 60);
  }
  // Keys of the player do not reach the page while it drives.
  key(event, down) {
    const what = DRIVE_KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    const modified = event.ctrlKey || event.metaKey || event.altKey;
    const others = modified || takesKeys(event.target) || $('help').open;
    if (!this.on || !what || (others && (down || !this.held.has(what)))) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    if (down) {
      this.held.add(what);
    } else {
      this.held.delete(what);
    }
    this.send();
  }
  letGo() {
    this.held.clear();
    this.send();
  }
  // Returns "DRIVE LIFT BUTTONS" of keys and gamepads.
  inputs() {
    const axis = (more, less) => (this.held.has(more) ? 1 : 0) - (this.held.has(less) ? 1 : 0);
    let [drive, lift, buttons] = [axis('right', 'left'), axis('up', 'down'), 0];
    for (let i = 0; i < 10; ++i) buttons |= this.held.has(String(i)) ? 1 << i : 0;
    for (const pad of navigator.getGamepads ? navigator.getGamepads() : []) {
      if (!pad) continue;
      const steady = (value) => (Math.abs(value || 0) < 0.12 ? 0 : value);
      drive = drive || steady(pad.axes[0]);
      lift = lift || -steady(pad.axes[1]);
      pad.buttons.slice(0, 10).forEach((button, i) => (buttons |= button.pressed ? 1 << i : 0));
    }
    return `${Math.round(127 * drive)} ${Math.round(127 * lift)} ${buttons}`;
  }
  send() {
    const inputs = this.on ? this.inputs() : '0 0 0';
    const now = performance.now();
    if (inputs === this.sent && (inputs === '0 0 0' || now - this.sent_ms < REPEAT_MS)) return;
    this.sent = inputs;
    this.sent_ms = now;
    this.number = Math.max(this.number + 1, Math.floor(1000 * Date.now()));
    fetch(`drive?token=${this.token}`, {
      method: 'POST',
      body: `${this.number} ${inputs}`,
      keepalive: true,
    })
        .then((answer) => {
          if (!answer.ok) sayLive(`Driving is refused: ${answer.statusText}.`);
        })
        .catch(() => {});  // the source says that the view is gone
  }
}

// Returns the id of the vehicle of a view's player; null where none is known.
function vehicleOf(view) {
  const world = view.worldAt(view.run.count - 1);
  const owned = (id) => {
    const track = view.tracks.bodies.get(id);
    const last = track ? track.has.lastIndexOf(1) : -1;
    return last >= 0 && Math.floor(track.owner[last] / 3) === view.peer;
  };
  const all =
      view.run.vehicles.filter((id) => world.byId.has(id) && world.byId.get(id).player >= 0);
  const found =
      all.filter(owned).concat(all.filter((id) => world.byId.get(id).player === view.peer - 1));
  return found.length > 0 ? found[0] : null;
}

function wireDrive(source) {
  const token = new URLSearchParams(location.search).get('token');
  if (!token || source.player === '') return;
  const driver = (source.driver = new Driver(source, token));
  source.page.player.lag_s = DRIVER_LAG_SECONDS;
  const button = element(
      'button', `Drive ${source.player}`,
      {type: 'button', title: 'Arrows or WASD drive and lift, space and 0-9 press; or a gamepad'});
  button.setAttribute('aria-pressed', 'true');
  button.addEventListener('click', () => {
    driver.on = !driver.on;
    driver.letGo();
    button.setAttribute('aria-pressed', String(driver.on));
    button.blur();
  });
  const group = element('div', '', {className: 'group'});
  group.append(button);
  document.querySelector('.bar').prepend(group);
  followVehicle(source);
}

// Puts the camera on the driven vehicle, once both are known.
function followVehicle(source) {
  const {page, player} = source;
  const view = page.runs[0].views.find((one) => one.name.startsWith(`${player} (`));
  const id = view ? vehicleOf(view) : null;
  if (id === null) return setTimeout(() => followVehicle(source), 250);
  livePanels(page, player);
  source.renamed();
  state.follow = id;
  state.camera = {x: 0, y: 0, height: 16};
  page.changed();
}
