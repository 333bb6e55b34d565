// The strip: a measure over time, a curve for each view, with the marks of events above.

const STRIP = {
  left: 52,
  right: 12,
  top: 8,
  bottom: 18
};
const EVENT_KINDS = {
  'impact': {name: 'Impact', colour: '#c41e3a'},
  'correction': {name: 'Jump', colour: '#d2691e'},
  'hand-over': {name: 'Hand-over', colour: '#7a48b4'},
  'edit': {name: 'Edit', colour: '#b07800'},
  'gap': {name: 'Gap', colour: '#5a6472'},
  'join': {name: 'Join, leave', colour: '#007880'},
  'note': {name: 'Note', colour: '#8a8f98'},
  'warning': {name: 'Warning', colour: '#c41e3a'},
};

class Strip {
  constructor(canvas) {
    this.canvas = canvas;
  }
  // Converts ticks to px and back.
  x(tick) {
    return STRIP.left + this.plotWidth() * tick / Math.max(1, this.last);
  }
  tickAt(px) {
    const share = (px - STRIP.left) / this.plotWidth();
    return Math.round(Math.min(Math.max(share, 0), 1) * this.last);
  }
  plotWidth() {
    return this.width - STRIP.left - STRIP.right;
  }
  prepare(last) {
    this.last = last;
    const ratio = window.devicePixelRatio || 1;
    this.width = this.canvas.clientWidth;
    this.height = this.canvas.clientHeight;
    this.canvas.width = Math.round(this.width * ratio);
    this.canvas.height = Math.round(this.height * ratio);
    const c = this.canvas.getContext('2d');
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, this.width, this.height);
    return c;
  }
  y(value) {
    const {log, low, high} = this.scale;
    const plot = this.height - STRIP.top - STRIP.bottom;
    const share = log ? Math.log(Math.max(value, low) / low) / Math.log(high / low) : value / high;
    return STRIP.top + plot * (1 - Math.min(Math.max(share, 0), 1));
  }
  findScale(curves, measure) {
    let most = 0;
    for (const curve of curves)
      for (const value of curve)
        if (value > most) most = value;
    if (MEASURES[measure].log) {
      const high = Math.max(0.1, 10 ** Math.ceil(Math.log10(Math.max(most, 1e-9)) - 1e-9));
      this.scale = {log: true, low: 0.001, high};
      return;
    }
    const decade = 10 ** Math.floor(Math.log10(Math.max(most, 1e-6)));
    const high = [1, 2, 5, 10].map((k) => k * decade).find((step) => step >= most);
    this.scale = {log: false, low: 0, high: most > 0 ? high : 1};
  }
  drawAxes(c, measure, seconds) {
    const {log, low, high} = this.scale;
    c.font = '11px system-ui, sans-serif';
    c.lineWidth = 1;
    const lines = log ? [] : [0, high / 2, high];
    if (log)
      for (let v = low; v <= high * 1.001; v *= 10) lines.push(v);
    for (const value of lines) {
      const y = Math.round(this.y(value)) + 0.5;
      c.strokeStyle = COLOURS.theme.grid;
      c.beginPath();
      c.moveTo(STRIP.left, y);
      c.lineTo(this.width - STRIP.right, y);
      c.stroke();
      c.fillStyle = COLOURS.theme.faint;
      c.textAlign = 'right';
      const text = log ? (value === low ? '≤ ' : '') + axisLength(value) :
          value === 0  ? '0' :
                         String(Number(value.toPrecision(3)));
      c.fillText(text, STRIP.left - 6, y + 3.5);
    }
    c.textAlign = 'center';
    const least = (seconds(this.last) - seconds(0)) * 70 / this.plotWidth();
    const decade = 10 ** Math.floor(Math.log10(least));
    const step = [1, 2, 5, 10].map((k) => k * decade).find((s) => s >= least);
    for (let s = Math.ceil(seconds(0) / step - 1e-9) * step; s <= seconds(this.last) + 1e-9;
         s += step) {
      const x = this.x((s - seconds(0)) / (seconds(this.last) - seconds(0)) * this.last);
      c.fillStyle = COLOURS.theme.faint;
      c.fillText(`${Number(s.toFixed(2))} s`, x, this.height - 4);
    }
  }
  drawCurve(c, curve, colour) {
    c.strokeStyle = colour;
    c.lineWidth = 1.6;
    c.lineJoin = 'round';
    c.beginPath();
    let open = false;
    curve.forEach((value, tick) => {
      if (Number.isNaN(value)) {
        open = false;
        return;
      }
      const x = this.x(tick);
      const y = this.y(value);
      if (open) {
        c.lineTo(x, y);
      } else {
        c.moveTo(x, y);
      }
      open = true;
    });
    c.stroke();
  }
  // `zero`: the tick at which all curves have their event, or nothing.
  draw(curves, measure, tick, range, seconds, last, zero) {
    const c = this.prepare(last);
    this.findScale(curves, measure);
    if (range) {
      c.fillStyle = COLOURS.theme.accent;
      c.globalAlpha = 0.14;
      const left = this.x(range[0]);
      c.fillRect(
          left, STRIP.top, Math.max(1, this.x(range[1]) - left),
          this.height - STRIP.top - STRIP.bottom);
      c.globalAlpha = 1;
    }
    this.drawAxes(c, measure, seconds);
    if (zero !== undefined) this.drawUpright(c, zero, COLOURS.theme.faint, [4, 3]);
    curves.forEach((curve, i) => this.drawCurve(c, curve, curveColour(i)));
    if (tick >= 0 && tick <= last) this.drawUpright(c, tick, COLOURS.theme.ink, []);
  }
  drawUpright(c, tick, colour, dash) {
    c.strokeStyle = colour;
    c.setLineDash(dash);
    c.lineWidth = 1.2;
    c.beginPath();
    c.moveTo(this.x(tick), STRIP.top - 4);
    c.lineTo(this.x(tick), this.height - STRIP.bottom);
    c.stroke();
    c.setLineDash([]);
  }
}

function axisLength(metres) {
  if (metres < 0.0095) return `${Math.round(metres * 1000)} mm`;
  return metres < 0.95 ? `${Math.round(metres * 100)} cm` : `${Math.round(metres)} m`;
}

const LOSS_ROW_PX = 24;
// Lost messages over time: a row for each channel, a mark for each loss.
class Losses extends Strip {
  // Returns rows of [label, [[from, to, lost, kind], ...]] in ticks since the first.
  rowsOf(runs) {
    const rows = new Map();
    for (const run of runs) {
      for (const [kind, channel, from, to, lost] of run.losses) {
        const short = channel.replace(/^SEAM\.[^.]*\./, '');
        const label = runs.length > 1 ? `${run.name} · ${short}` : short;
        if (!rows.has(label)) rows.set(label, []);
        rows.get(label).push([from - run.first, to - run.first, lost, kind]);
      }
    }
    return [...rows].sort((a, b) => (a[0] < b[0] ? -1 : 1));
  }
  // Sets rows and height of the canvas. Call before the widths of the other canvases are read,
  // since the page may get a scroll bar.
  place(runs) {
    this.rows = this.rowsOf(runs);
    this.canvas.hidden = this.rows.length === 0;
    this.canvas.style.height = `${LOSS_ROW_PX * this.rows.length + 4}px`;
  }
  draw(tick, last) {
    const {rows} = this;
    if (rows.length === 0) return;
    const c = this.prepare(last);
    c.font = '11px system-ui, sans-serif';
    c.textAlign = 'left';
    rows.forEach(([label, losses], i) => {
      const y = LOSS_ROW_PX * i + 2;
      c.fillStyle = COLOURS.theme.grid;
      c.fillRect(STRIP.left, y + 16, this.plotWidth(), 2);
      const most = Math.max(...losses.map((loss) => loss[2]));
      c.fillStyle = COLOURS.theme.spark;
      for (const [from, to, lost, kind] of losses) {
        c.globalAlpha = kind === 'network' ? 0.35 : 1;  // an estimate, smeared over seconds
        const tall = 4 + 8 * lost / most;
        const left = this.x(Math.max(0, from));
        c.fillRect(left, y + 17 - tall / 2, Math.max(2, this.x(to) - left), tall);
      }
      c.globalAlpha = 1;
      c.fillStyle = COLOURS.theme.faint;
      c.fillText(`lost: ${label}`, STRIP.left, y + 9);
    });
    c.fillStyle = COLOURS.theme.ink;
    c.fillRect(this.x(tick) - 0.6, 0, 1.2, this.height);
  }
  // Returns a text about the loss at a place of the canvas; nothing where there is none.
  textAt(x, y, seconds) {
    const row = this.rows && this.rows[Math.floor(y / LOSS_ROW_PX)];
    if (!row) return '';
    const tick = this.tickAt(x);
    const near = (loss) => Math.max(loss[0] - tick, tick - loss[1], 0);
    const loss = row[1].reduce((a, b) => (near(b) < near(a) ? b : a));
    if (near(loss) > this.last / 60) return '';
    const what = {bus: 'messages', view: 'ticks', input: 'ticks', network: 'datagrams, about'};
    return `${row[0]}: ${loss[2]} ${what[loss[3]]}, ${seconds(Math.max(0, loss[0])).toFixed(2)} to ${
        seconds(loss[1]).toFixed(2)} s`;
  }
}

// The marks: one line for each event, by kind. A click jumps to the nearest.
class Marks extends Strip {
  draw(events, tick, last) {
    const c = this.prepare(last);
    const middle = this.height / 2;
    c.fillStyle = COLOURS.theme.grid;
    c.fillRect(STRIP.left, middle - 1, this.plotWidth(), 2);
    for (const event of events) {
      const kind = EVENT_KINDS[event.kind];
      const tall = event.kind === 'impact' ? Math.min(1, 0.4 + Math.sqrt(event.size) / 8) : 0.7;
      c.fillStyle = themed(kind.colour);
      c.globalAlpha = 0.85;
      c.fillRect(Math.round(this.x(event.at)) - 1, middle - tall * middle, 2, 2 * tall * middle);
    }
    c.globalAlpha = 1;
    c.fillStyle = COLOURS.theme.ink;
    c.beginPath();
    c.moveTo(this.x(tick) - 5, 0);
    c.lineTo(this.x(tick) + 5, 0);
    c.lineTo(this.x(tick), 7);
    c.closePath();
    c.fill();
    c.fillRect(this.x(tick) - 0.6, 0, 1.2, this.height);
  }
}
