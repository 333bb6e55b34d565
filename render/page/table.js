// Tables: bodies by error, and measures over a range of time. Texts of a recording are inserted as
// text nodes only.

const TABLE_ROWS_MAX = 100;

function element(name, text, properties) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  return Object.assign(made, properties);
}

function swatch(colour) {
  const made = element('span', '', {className: 'swatch'});
  made.style.background = colour;
  return made;
}

// A body in one view: its error now and the greatest in the range.
function bodyRow(view, track, tick, [from, to]) {
  let worst = -1;
  for (let i = from; i <= Math.min(to, track.error.length - 1); ++i)
    worst = Math.max(worst, track.error[i]);
  return {
    id: track.id,
    name: view.run.names.get(track.id) || `body ${track.id}`,
    owner: Math.floor(track.owner[Math.floor(tick)] / 3),
    now: view.errorOf(track.id, tick),
    worst: worst < 0 ? null : worst * view.units.error,
    here: track.has[Math.floor(tick)] === 1,
  };
}

// Returns the bodies of all views with the largest error of any view, the largest first, bodies
// that are not shown last.
function bodyRows(views, tick, range) {
  const rows = new Map();
  for (const view of views) {
    for (const track of view.tracks.bodies.values()) {
      const row = bodyRow(view, track, tick, range);
      const known = rows.get(track.id) || row;
      const most = (key) => (row[key] === null ? known[key] : Math.max(row[key], known[key] || 0));
      rows.set(
          track.id,
          {...known, now: most('now'), worst: most('worst'), here: known.here || row.here});
    }
  }
  return [...rows.values()].sort(
      (a, b) => b.here - a.here || (b.now || 0) - (a.now || 0) || (b.worst || 0) - (a.worst || 0));
}

function fillBodyTable(body, views, tick, range, onFollow) {
  const rows = bodyRows(views, tick, range).slice(0, TABLE_ROWS_MAX);
  body.replaceChildren(...rows.map((row) => {
    const line = element('tr');
    const name = element('td');
    const button = element('button', row.name, {type: 'button', className: 'body-name'});
    button.setAttribute('aria-pressed', String(state.follow === row.id));
    button.addEventListener('click', () => onFollow(row.id));
    name.append(swatch(peerColour(row.owner)), button);
    line.append(
        name, element('td', row.here ? formatLength(row.now) : 'not shown'),
        element('td', formatLength(row.worst)));
    line.classList.toggle('followed', state.follow === row.id);
    return line;
  }));
}

// Returns a row for each view on a panel, and one for all views of its run.
function rangeRows(views, measure, range) {
  const runs = [...new Set(views.map((view) => view.run))];
  const rows = views.map((view, i) => ({name: view.label(), colour: curveColour(i), of: [view]}));
  for (const run of runs)
    rows.push({name: `${runs.length > 1 ? run.name + ' · ' : ''}all views`, of: run.views});
  return rows.map((row) => ({...row, ...rangeStats(row.of, measure, range[0], range[1])}));
}

function fillRangeTable(body, views, measure, range) {
  const unit = MEASURES[measure].unit;
  body.replaceChildren(...rangeRows(views, measure, range).map((row) => {
    const line = element('tr');
    const name = element('td');
    if (row.colour) name.append(swatch(row.colour));
    name.append(row.name);
    line.append(name, ...['rms', 'p95', 'max'].map((key) => {
      const cell = element('td', formatValue(row[key], unit));
      cell.dataset.value = row[key];
      return cell;
    }));
    return line;
  }));
}
