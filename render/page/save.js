// Downloads: a picture as PNG or SVG, and numbers as CSV.

function saveBlob(blob, name) {
  const link = element('a', '', {href: URL.createObjectURL(blob), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

function escapeXml(text) {
  return String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
}

// Records drawing calls of a canvas's context as SVG: those that shapes.js and panel.js use.
class SvgContext {
  constructor(width, height) {
    this.parts = [];
    this.path = '';
    this.dash = [];
    this.groups = [0];
    this.clips = 0;
    this.size = [width, height];
    this.globalAlpha = 1;
    this.lineWidth = 1;
    this.font = '11px sans-serif';
    this.textAlign = 'left';
  }
  number(value) {
    return +value.toFixed(2);
  }
  save() {
    this.groups.push(0);
  }
  restore() {
    this.parts.push('</g>'.repeat(this.groups.pop()));
  }
  beginPath() {
    this.path = '';
  }
  moveTo(x, y) {
    this.path += `M${this.number(x)} ${this.number(y)}`;
  }
  lineTo(x, y) {
    this.path += `L${this.number(x)} ${this.number(y)}`;
  }
  closePath() {
    this.path += 'Z';
  }
  arc(x, y, r) {
    const [left, right, top, radius] = [x - r, x + r, y, r].map((v) => this.number(v));
    this.path += `M${right} ${top}A${radius} ${radius} 0 1 1 ${left} ${top}` +
        `A${radius} ${radius} 0 1 1 ${right} ${top}`;
  }
  rect(x, y, width, height) {
    const [left, top, w, h] = [x, y, width, height].map((v) => this.number(v));
    this.path += `M${left} ${top}h${w}v${h}h${- w}Z`;
  }
  clip() {
    const id = 'clip' + this.clips++;
    this.parts.push(
        `<clipPath id="${id}"><path d="${this.path}"/></clipPath><g clip-path="url(#${id})">`);
    ++this.groups[this.groups.length - 1];
  }
  setLineDash(dash) {
    this.dash = dash;
  }
  paint(kind) {
    if (!this.path) return;
    const dash = this.dash.length > 0 ? ` stroke-dasharray="${this.dash.join(' ')}"` : '';
    const look = kind === 'fill' ?
        `fill="${escapeXml(this.fillStyle)}"` :
        `fill="none" stroke="${escapeXml(this.strokeStyle)}" stroke-width="${this.lineWidth}"${
            dash}`;
    this.parts.push(`<path d="${this.path}" ${look} opacity="${this.number(this.globalAlpha)}"/>`);
  }
  fill() {
    this.paint('fill');
  }
  stroke() {
    this.paint('stroke');
  }
  fillRect(x, y, width, height) {
    const path = this.path;
    this.path = '';
    this.rect(x, y, width, height);
    this.fill();
    this.path = path;
  }
  text(text, x, y, look) {
    const anchor = {left: 'start', center: 'middle', right: 'end'}[this.textAlign];
    const [size] = this.font.match(/\d+/g).slice(-1);
    const weight = this.font.startsWith('600') ? 600 : 400;
    this.parts.push(
        `<text x="${this.number(x)}" y="${this.number(y)}" font-family="system-ui, sans-serif" ` +
        `font-size="${size}" font-weight="${weight}" text-anchor="${anchor}" ${look}>` +
        `${escapeXml(text)}</text>`);
  }
  fillText(text, x, y) {
    this.text(text, x, y, `fill="${escapeXml(this.fillStyle)}"`);
  }
  strokeText(text, x, y) {
    this.text(
        text, x, y,
        `fill="none" stroke="${escapeXml(this.strokeStyle)}" stroke-width="${this.lineWidth}"`);
  }
  document() {
    const [width, height] = this.size;
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
        `viewBox="0 0 ${width} ${height}">${this.parts.join('\n')}</svg>\n`;
  }
}

function csvText(text) {
  return /[",\n\r]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
}

// Returns a row for each tick, view and body: the page's poses, rounded to millimetres.
function csvOf(views, range) {
  const lines = ['run,tick,time_s,view,body,x,y,angle,error_m'];
  for (const view of views) {
    const {run} = view;
    for (let i = range[0]; i <= range[1]; ++i) {
      for (const track of view.tracks.bodies.values()) {
        if (!track.has[i]) continue;
        const error = view.errorOf(track.id, i);
        const pose = [track.x, track.y, track.a].map((column) => (column[i] / 1000).toFixed(3));
        const name = run.names.get(track.id) || `body ${track.id}`;
        lines.push([
          csvText(run.name),
          run.first + i,
          run.seconds(i).toFixed(4),
          csvText(view.name),
          csvText(name),
          ...pose,
          error === null ? '' : error.toFixed(4),
        ].join(','));
      }
    }
  }
  return lines.join('\n') + '\n';
}
