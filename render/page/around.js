// The strip around one event: the curves of all panels over each other, each view's run laid so
// that its own event is at 0 s.

const AROUND_SECONDS = {
  before: 0.5,
  after: 2
};
const AROUND_KINDS = ['impact', 'hand-over', 'correction', 'edit', 'note', 'warning'];

// Returns the run's event that is nearest to a tick since its first; of one kind, if one is given.
function nearestEvent(run, tick, kind) {
  const events = run.events.filter(
      (event) => event.at >= 0 && (kind ? event.kind === kind : AROUND_KINDS.includes(event.kind)));
  if (events.length === 0) return null;
  const far = (event) => Math.abs(event.at - tick);
  return events.reduce((best, event) => (far(event) < far(best) ? event : best));
}

class Around {
  // `event`: of the first panel's run. Of other runs the event of its kind that is nearest in time.
  constructor(event, views) {
    const [first] = views;
    this.event = event;
    this.kind = event.kind;
    this.hz = first.run.hz;
    this.before = Math.round(AROUND_SECONDS.before * this.hz);
    this.last = this.before + Math.round(AROUND_SECONDS.after * this.hz);
    this.first = event.at - this.before;  // the tick of the first panel at the strip's left end
    const time_s = first.run.seconds(event.at);
    this.events = views.map((view) => {
      if (view.run === first.run) return event;
      return nearestEvent(view.run, time_s * view.run.hz - view.run.first, event.kind);
    });
  }
  seconds(tick) {
    return (tick - this.before) / this.hz;
  }
  // Returns a view's curve over the strip; NaN where it has no value, or its run no such event.
  cut(curve, i) {
    const cut = new Float64Array(this.last + 1).fill(NaN);
    const event = this.events[i];
    for (let k = 0; event && k <= this.last; ++k) {
      const value = curve[event.at - this.before + k];
      if (value !== undefined) cut[k] = value;
    }
    return cut;
  }
  text(views) {
    const name = EVENT_KINDS[this.kind].name.toLowerCase();
    const runs = new Map(views.map((view, i) => [view.run, this.events[i]]));
    const several = runs.size > 1;
    const moments = [...runs].map(([run, event]) => {
      const when = event ? `${run.seconds(event.at).toFixed(2)} s` : 'none';
      return several ? `${run.name} ${when}` : when;
    });
    return `0 s is the ${name} at ${moments.join(', ')}`;
  }
}

// Returns a row for each view and tick of the strip around an event.
function aroundCsv(around, views, measure) {
  const lines = ['run,view,event,event_s,after_s,measure,value'];
  views.forEach((view, i) => {
    const event = around.events[i];
    if (!event) return;
    around.cut(view.curve(measure), i).forEach((value, k) => {
      if (Number.isNaN(value)) return;
      lines.push([
        csvText(view.run.name),
        csvText(view.name),
        around.kind,
        view.run.seconds(event.at).toFixed(4),
        around.seconds(k).toFixed(4),
        `${measure}_${MEASURES[measure].unit.replace(/[^A-Za-z]+/g, '_')}`,
        Number(value.toPrecision(6)),
      ].join(','));
    });
  });
  return lines.join('\n') + '\n';
}
