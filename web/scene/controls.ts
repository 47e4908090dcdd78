// Buttons, slider and menus below the view.

import { format } from "../page/numbers";
import type { Camera, Mode } from "./camera";
import type { BodyData } from "./document";
import { button, make } from "../page/elements";
import type { Playback } from "./playback";

const MODES: [Mode, string, string][] = [
  ["follow", "Follow", "Camera at the body, level with the horizon"],
  ["chase", "Chase", "Camera behind the body, along its motion"],
  ["free", "Free", "Camera anywhere, the whole path in view"],
];
const ZOOM = 1.4;
const TILT = Math.PI / 18; // rad

export interface Wishes {
  playback: Playback;
  camera: Camera;
  bodies: BodyData[];
  axes: boolean; // are shown at first
  followed(): BodyData;
  follow(body: BodyData): void;
  setAxes(shown: boolean): void;
  changed(): void;
}

export class Controls {
  readonly element = make("div", { class: "scene-controls" });
  private readonly play: HTMLButtonElement;
  private readonly slider: HTMLInputElement;
  private readonly modes: HTMLButtonElement[];
  private readonly menu: HTMLSelectElement | null; // of bodies

  constructor(private readonly wishes: Wishes) {
    const { playback, camera, changed } = wishes;
    this.play = button("Play", () => playback.toggle());
    this.slider = make("input", { type: "range", min: 0, max: playback.times.length - 1, step: 1, "aria-label": "time" });
    this.slider.addEventListener("input", () => {
      if (playback.playing) playback.pause();
      playback.row = this.slider.valueAsNumber;
    });
    this.modes = MODES.map(([mode, label, title]) => {
      const element = button(label, () => (camera.setMode(mode), changed()));
      element.title = title;
      return element;
    });
    this.menu = this.bodyMenu();
    const step = (rows: number) => () => {
      if (playback.playing) playback.pause();
      playback.row += rows;
    };
    const move = (act: () => void) => () => (act(), changed());
    const line = (label: string, ...children: Node[]) =>
      make("div", { role: "group", "aria-label": label, class: "scene-group" }, ...children);
    const time = line(
      "time",
      this.play,
      button("−1", step(-1), "−1 sample"),
      button("+1", step(1), "+1 sample"),
      this.slider,
      this.speedMenu(),
    );
    time.classList.add("scene-time");
    this.element.append(time, line("camera", ...(this.menu ? [this.menu] : []), ...this.modes));
    this.element.append(
      line(
        "view",
        button("+", move(() => camera.zoom(1 / ZOOM)), "closer"),
        button("−", move(() => camera.zoom(ZOOM)), "farther"),
        button("↻", move(() => camera.turn(TILT, 0)), "turn"),
        button("↑", move(() => camera.turn(0, TILT)), "look from higher"),
        button("↓", move(() => camera.turn(0, -TILT)), "look from lower"),
        button("Reset", move(() => camera.reset()), "reset the view"),
        this.axesButton(),
      ),
    );
    this.show();
  }

  show(): void {
    const { playback, camera, bodies, followed } = this.wishes;
    if (this.menu) this.menu.value = String(bodies.indexOf(followed()));
    this.play.textContent = playback.playing ? "Pause" : "Play";
    this.slider.value = String(playback.row);
    this.slider.setAttribute("aria-valuetext", `${format(playback.instant.time, 6)} s`);
    for (const [index, [mode]] of MODES.entries()) {
      this.modes[index]!.setAttribute("aria-pressed", String(camera.mode === mode));
    }
  }

  private speedMenu(): HTMLElement {
    const { playback } = this.wishes;
    const options = playback.speeds.map((speed) => make("option", { value: speed }, `${speed}×`));
    const menu = make("select", { "aria-label": "speed" }, ...options);
    menu.value = String(playback.speed);
    menu.addEventListener("change", () => (playback.speed = Number(menu.value)));
    return menu;
  }

  private bodyMenu(): HTMLSelectElement | null {
    const { bodies, follow } = this.wishes;
    if (bodies.length < 2) return null;
    const menu = make("select", { "aria-label": "body" }, ...bodies.map(({ name }, index) => make("option", { value: index }, name)));
    menu.addEventListener("change", () => follow(bodies[Number(menu.value)]!));
    return menu;
  }

  private axesButton(): HTMLElement {
    let shown = this.wishes.axes;
    const element = button("Axes", () => {
      shown = !shown;
      element.setAttribute("aria-pressed", String(shown));
      this.wishes.setAxes(shown);
    });
    element.title = "axes of the bodies: x red, y green, z blue";
    element.setAttribute("aria-pressed", String(shown));
    return element;
  }
}
