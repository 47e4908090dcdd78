// Mouse, touch and keys on the view. One finger up or down scrolls the page, sideways turns the camera; two fingers zoom
// and tilt. The wheel zooms once the view has the focus, else it scrolls the page.

import type { Camera } from "./camera";

const TURN = Math.PI; // rad over the view's width
const WHEEL = 0.0015; // of the zoom's exponent, per pixel
const KEY_TURN = Math.PI / 24; // rad
const KEY_ZOOM = 1.25;
const KEY_PAN = 0.08; // of the view's height

export function listen(view: HTMLElement, camera: Camera, changed: () => void): void {
  const pointers = new Map<number, PointerEvent>();
  view.addEventListener("pointerdown", (event) => {
    pointers.set(event.pointerId, event);
    view.setPointerCapture(event.pointerId);
    view.focus({ preventScroll: true });
  });
  for (const name of ["pointerup", "pointercancel"] as const) {
    view.addEventListener(name, (event) => pointers.delete(event.pointerId));
  }
  view.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const right = (event.clientX - before.clientX) / view.clientWidth;
    const down = (event.clientY - before.clientY) / view.clientHeight;
    const other = [...pointers.values()].find(({ pointerId }) => pointerId !== event.pointerId);
    if (other) {
      const apart = (to: PointerEvent) => Math.hypot(to.clientX - other.clientX, to.clientY - other.clientY);
      camera.zoom(apart(before) / Math.max(apart(event), 1));
      camera.turn((-TURN * right) / 2, (TURN * down) / 2);
    } else if (event.buttons & 2 || event.shiftKey) camera.pan(-right * (view.clientWidth / view.clientHeight), down);
    else camera.turn(-TURN * right, event.pointerType === "touch" ? 0 : TURN * down);
    pointers.set(event.pointerId, event);
    changed();
  });
  view.addEventListener("contextmenu", (event) => event.preventDefault());
  view.addEventListener(
    "wheel",
    (event) => {
      if (document.activeElement !== view) return;
      event.preventDefault();
      camera.zoom(Math.exp(WHEEL * event.deltaY * (event.deltaMode ? 30 : 1)));
      changed();
    },
    { passive: false },
  );
  view.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || !pressed(event, camera)) return;
    event.preventDefault();
    changed();
  });
}

// Whether the key moves the camera.
function pressed({ key, shiftKey }: KeyboardEvent, camera: Camera): boolean {
  const [right, upwards] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[key] ?? [0, 0];
  if (right || upwards) {
    if (shiftKey) camera.pan(KEY_PAN * right!, KEY_PAN * upwards!);
    else camera.turn(KEY_TURN * right!, KEY_TURN * upwards!);
  } else if (key === "+" || key === "=") camera.zoom(1 / KEY_ZOOM);
  else if (key === "-") camera.zoom(KEY_ZOOM);
  else if (key === "0") camera.reset();
  else return false;
  return true;
}
