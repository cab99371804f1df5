// Pointers, wheel and keys, as calls of a viewer: move, zoom, turn, lean, and commands by name.

const wheelStep = 0.0016, pinchStep = 0.01;  // of the zoom's logarithm, per pixel of the wheel
const lineHeight = 16;                        // pixels of a wheel that counts lines
const turnThreshold = 0.15;                   // radians before two fingers turn the picture
const keyStep = 0.12;                         // of the window
export const turnStep = Math.PI / 12;
const leanStep = Math.PI / 18;

export function listenToPointers(stage, viewer) {
  const pointers = new Map();
  let turned = 0;
  const place = (event) => {
    const box = stage.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };

  const dragOne = (from, to, event) => {
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    if (event.shiftKey || event.buttons === 2) {
      viewer.turn(-dx * 0.006, ...viewer.middle);
      viewer.lean(-dy * 0.006);
    } else {
      viewer.move(from[0], from[1], dx, dy);
    }
  };

  const dragTwo = (from, to, other) => {
    const length = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]), angle = (p) => Math.atan2(p[1] - other[1], p[0] - other[0]);
    const centre = [(to[0] + other[0]) / 2, (to[1] + other[1]) / 2], before = [(from[0] + other[0]) / 2, (from[1] + other[1]) / 2];
    viewer.move(...before, centre[0] - before[0], centre[1] - before[1]);
    viewer.zoom(length(to) / Math.max(1, length(from)), ...centre);
    const by = Math.atan2(Math.sin(angle(to) - angle(from)), Math.cos(angle(to) - angle(from)));
    turned += by;
    if (Math.abs(turned) > turnThreshold)
      viewer.turn(by, ...centre);
  };

  stage.addEventListener('pointerdown', (event) => {
    if (event.target.closest('#divider, #message'))
      return;
    stage.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, place(event));
    stage.classList.add('moving');
    turned = 0;
  });
  stage.addEventListener('pointermove', (event) => {
    const from = pointers.get(event.pointerId), to = place(event);
    if (!from) {
      viewer.point(...to);
      return;
    }
    pointers.set(event.pointerId, to);
    const others = [...pointers.entries()].filter(([id]) => id !== event.pointerId);
    others.length === 0 ? dragOne(from, to, event) : dragTwo(from, to, others[0][1]);
  });
  const release = (event) => {
    if (pointers.delete(event.pointerId) && pointers.size === 0) {
      stage.classList.remove('moving');
      viewer.point(...place(event));
    }
  };
  stage.addEventListener('pointerup', release);
  stage.addEventListener('pointercancel', release);
  stage.addEventListener('pointerleave', () => viewer.point(null));
  stage.addEventListener('contextmenu', (event) => event.preventDefault());
  stage.addEventListener('dblclick', (event) => viewer.zoom(2, ...place(event)));
  stage.addEventListener('wheel', (event) => {
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? lineHeight : 1);
    viewer.zoom(Math.exp(-pixels * (event.ctrlKey ? pinchStep : wheelStep)), ...place(event));
  }, {passive: false});
}

export function listenToKeys(viewer) {
  const step = (x, y) => viewer.move(...viewer.middle, -x * keyStep * viewer.shortSide, -y * keyStep * viewer.shortSide);
  const keys = {
    ArrowLeft: () => step(-1, 0), ArrowRight: () => step(1, 0), ArrowUp: () => step(0, -1), ArrowDown: () => step(0, 1),
    '+': () => viewer.zoom(1.25, ...viewer.middle), '=': () => viewer.zoom(1.25, ...viewer.middle),
    '-': () => viewer.zoom(0.8, ...viewer.middle), '_': () => viewer.zoom(0.8, ...viewer.middle),
    0: () => viewer.command('fit'), 1: () => viewer.command('one'), f: () => viewer.command('finest'),
    r: () => viewer.turn(turnStep, ...viewer.middle), R: () => viewer.turn(-turnStep, ...viewer.middle),
    t: () => viewer.lean(leanStep), T: () => viewer.lean(-leanStep),
    v: () => viewer.command('view'), s: () => viewer.command('split'), g: () => viewer.command('ground'),
    i: () => viewer.point(...viewer.middle), '?': () => viewer.command('help'),
  };
  document.addEventListener('keydown', (event) => {
    const action = keys[event.key];
    const isElsewhere = event.target.closest?.('select, dialog, #divider') && event.key !== '?';
    if (!action || isElsewhere || event.ctrlKey || event.metaKey || event.altKey)
      return;
    event.preventDefault();
    action();
  });
}


