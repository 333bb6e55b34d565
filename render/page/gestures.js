// Wheel, drags and pinches: the camera, the divider of a wipe, the strip and the marks.

// Calls move(dx, dy, event) while a pointer is dragged over an element.
function onDrag(target, begin, move, end) {
  target.addEventListener('pointerdown', (down) => {
    if (down.button !== 0) return;
    target.setPointerCapture(down.pointerId);
    let [x, y] = [down.clientX, down.clientY];
    begin(down);
    const onMove = (event) => {
      move(event.clientX - x, event.clientY - y, event);
      [x, y] = [event.clientX, event.clientY];
    };
    const onEnd = (event) => {
      target.removeEventListener('pointermove', onMove);
      target.removeEventListener('pointerup', onEnd);
      target.removeEventListener('pointercancel', onEnd);
      if (end) end(event);
    };
    target.addEventListener('pointermove', onMove);
    target.addEventListener('pointerup', onEnd);
    target.addEventListener('pointercancel', onEnd);
  });
}

const pointIn = (target, event) => {
  const box = target.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
};

function wireCamera(page) {
  const canvas = $('world');
  let held = false;  // the pointer drags a body, not the camera
  onDrag(
      canvas,
      (event) => {
        held = Boolean(page.hand) && page.hand.take(...pointIn(canvas, event), event.pointerType);
        if (!held) state.camera = {...page.camera};
      },
      (dx, dy, event) => {
        if (held) return page.hand.move(...pointIn(canvas, event));
        const scale = page.rects[0].height / state.camera.height;
        state.follow = null;
        state.camera.x -= dx / scale;
        state.camera.y += dy / scale;
        page.changed();
      },
      () => held && page.hand.letGo());
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    const [x, y] = pointIn(canvas, event);
    const rect =
        page.rects.find((r) => x >= r.x && x <= r.x + r.width && y >= r.y && y <= r.y + r.height) ||
        page.rects[0];
    zoom(page, Math.exp(event.deltaY * 0.0015), new Viewport(rect, page.camera), x, y);
  }, {passive: false});
  wirePinch(page, canvas);
  onDrag($('divider'), () => {}, (dx) => setWipe(page, state.wipe + dx / canvas.clientWidth));
  $('divider').addEventListener('keydown', (event) => {
    const way = {ArrowLeft: -0.02, ArrowRight: 0.02}[event.key];
    if (way) setWipe(page, state.wipe + way);
    if (way) event.stopPropagation();
  });
}

function setWipe(page, share) {
  state.wipe = Math.min(Math.max(share, 0), 1);
  page.changed();
}

// Zooms about a point that keeps its place.
function zoom(page, factor, viewport, px, py) {
  const [x, y] = [viewport.worldX(px), viewport.worldY(py)];
  const camera = {...page.camera};
  const height = Math.min(Math.max(camera.height * factor, 0.2), 5000);
  const share = height / camera.height;
  if (state.follow === null) {
    camera.x = x + (camera.x - x) * share;
    camera.y = y + (camera.y - y) * share;
  }
  state.camera = {...camera, height};
  page.changed();
}

// Two fingers zoom.
function wirePinch(page, canvas) {
  const fingers = new Map();
  const apart = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  };
  canvas.addEventListener(
      'pointerdown', (event) => fingers.set(event.pointerId, pointIn(canvas, event)));
  canvas.addEventListener('pointermove', (event) => {
    if (!fingers.has(event.pointerId)) return;
    const before = fingers.size === 2 ? apart() : 0;
    fingers.set(event.pointerId, pointIn(canvas, event));
    if (fingers.size !== 2 || before < 1) return;
    const [a, b] = [...fingers.values()];
    zoom(
        page, before / Math.max(apart(), 1), new Viewport(page.rects[0], page.camera),
        (a[0] + b[0]) / 2, (a[1] + b[1]) / 2);
  });
  for (const name of ['pointerup', 'pointercancel'])
    canvas.addEventListener(name, (event) => fingers.delete(event.pointerId));
}

function wireStrip(page) {
  const canvas = $('strip');
  let beginPx = 0;
  let dragged = false;
  onDrag(
      canvas,
      (event) => {
        [beginPx] = pointIn(canvas, event);
        dragged = false;
      },
      (dx, dy, event) => {
        const [px] = pointIn(canvas, event);
        const [begin, end] = [page.stripTick(beginPx), page.stripTick(px)];
        if (Math.abs(px - beginPx) > 3) dragged = true;
        if (dragged) state.range = [Math.min(begin, end), Math.max(begin, end)];
        page.changed();
      },
      () => {
        if (!dragged) page.player.go(page.stripTick(beginPx));
      });
  canvas.addEventListener('pointermove', (event) => {
    const {around} = page;
    const tick = page.strip.tickAt(pointIn(canvas, event)[0]);
    const unit = MEASURES[state.measure].unit;
    const values = page.views().map((view, i) => {
      const curve = view.curve(state.measure);
      const value = (around ? around.cut(curve, i) : curve)[tick];
      return `${view.label()} ${formatValue(value === undefined ? NaN : value, unit)}`;
    });
    const when = around ? around.seconds(tick) : page.runs[0].seconds(tick);
    $('strip-text').textContent = `${when.toFixed(3)} s: ${values.join(' · ')}`;
  });
  canvas.addEventListener('pointerleave', () => ($('strip-text').textContent = ''));
  $('losses').addEventListener('pointermove', (event) => {
    const [x, y] = pointIn($('losses'), event);
    const text = page.losses.textAt(x, y, (tick) => page.views()[0].run.seconds(tick));
    $('strip-text').textContent = text;
  });
  $('losses').addEventListener('pointerleave', () => ($('strip-text').textContent = ''));
  onDrag($('losses'), (event) => {
    page.player.pause();
    page.player.go(page.losses.tickAt(pointIn($('losses'), event)[0]));
  }, () => {});
  onDrag($('marks'), (event) => goToMark(page, pointIn($('marks'), event)[0]), () => {});
}

// Jumps to the event under the pointer, or to the tick.
function goToMark(page, px) {
  const near = page.events()
                   .map((event) => ({event, far: Math.abs(page.marks.x(event.at) - px)}))
                   .sort((a, b) => a.far - b.far)[0];
  page.player.pause();
  page.player.go(near && near.far < 6 ? near.event.at : page.marks.tickAt(px));
  if (near && near.far < 6) page.tell(page.eventText(near.event));
}
