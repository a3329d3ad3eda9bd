// Turns, moves and zooms the picture by mouse, fingers and keys.

function makeTurning(view) {
  const canvas = view.canvas;
  const pointers = new Map();
  const span = () => (view.camera.top - view.camera.bottom) / canvas.clientHeight; // length of a pixel
  const flat = () => view.packing.dimension === 2;
  const turn = (x, y) => {
    if (flat()) return move(x, y);
    view.yaw -= 0.008 * x;
    view.pitch = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, view.pitch + 0.008 * y));
    view.ask();
  };
  const move = (x, y) => {
    view.shift[0] += x * span();
    view.shift[1] -= y * span();
    view.ask();
  };
  const zoom = factor => {
    view.zoom = Math.min(200, Math.max(0.3, view.zoom * factor));
    view.ask();
  };
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, distance: Math.hypot(a.x - b.x, a.y - b.y) || 1};
  };

  canvas.addEventListener('pointerdown', event => {
    if (!view.packing) return;
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  });
  canvas.addEventListener('pointermove', event => {
    const old = pointers.get(event.pointerId);
    if (!old) return;
    const now = {x: event.clientX, y: event.clientY};
    if (pointers.size === 2) {
      const before = spread();
      pointers.set(event.pointerId, now);
      const after = spread();
      move(after.x - before.x, after.y - before.y);
      zoom(after.distance / before.distance);
      return;
    }
    pointers.set(event.pointerId, now);
    (event.shiftKey || event.buttons === 2 ? move : turn)(now.x - old.x, now.y - old.y);
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, event => pointers.delete(event.pointerId));
  canvas.addEventListener('contextmenu', event => event.preventDefault());
  canvas.addEventListener('wheel', event => {
    if (document.activeElement !== canvas || !view.packing) return; // the page must scroll past
    event.preventDefault();
    zoom(Math.exp(-0.0015 * event.deltaY));
  }, {passive: false});
  canvas.addEventListener('keydown', event => {
    if (!view.packing) return;
    const steps = {ArrowLeft: [-12, 0], ArrowRight: [12, 0], ArrowUp: [0, -12], ArrowDown: [0, 12]};
    if (steps[event.key]) (event.shiftKey ? move : turn)(...steps[event.key]);
    else if (event.key === '+' || event.key === '=') zoom(1.2);
    else if (event.key === '-') zoom(1 / 1.2);
    else return;
    event.preventDefault();
  });
}
