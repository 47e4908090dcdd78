// A scene as a whole: what is in it, and a new picture of it whenever something has changed.

import { Color, DirectionalLight, Group, HemisphereLight, Quaternion, Scene, Vector3, WebGLRenderer } from "three";
import { announceTime, followTime } from "../page/time";
import { announceTrial, followTrial } from "../page/trial";
import { Arrows } from "./objects/arrows";
import { Beams } from "./objects/beams";
import { Camera } from "./camera";
import { Controls } from "./controls";
import type { BodyData, SceneData } from "./document";
import { make } from "../page/elements";
import { Flames } from "./objects/flames";
import { bodyAxes, Triad } from "./objects/frames";
import { Ground } from "./objects/ground";
import { type Instant, attitudeAt, positionAt } from "./instant";
import { Marks } from "./marks";
import { Path } from "./objects/path";
import { Playback } from "./playback";
import { listen } from "./pointer";
import { Readout } from "./readout";
import { makeShape } from "./objects/shapes";
import { Directions } from "./objects/directions";
import { followTheme, themeOf } from "./theme";

const NAME = "scene"; // of this script in events
const ANNOUNCED = 60; // ms, at least between two times of a run that plays
const SHARPEST = 2; // pixels of the picture for one of the page

interface Shown {
  data: BodyData;
  group: Group;
  flames: Flames;
  path: Path;
  axes: Group;
}

export class View {
  readonly element: HTMLElement;
  private readonly stage = make("div", {
    class: "scene-view",
    tabindex: 0,
    role: "application",
    "aria-roledescription": "three-dimensional view",
  });
  private readonly scene = new Scene();
  private readonly sun = new DirectionalLight("#ffffff", 2.2);
  private readonly camera: Camera;
  private readonly playback: Playback;
  private readonly controls: Controls;
  private readonly ground: Ground | null;
  private readonly directions: Directions | null;
  private readonly beams: Beams;
  private readonly arrows: Arrows;
  private readonly marks: Marks;
  private readonly triad: Triad;
  private readonly readout: Readout;
  private readonly shown: Shown[];
  private followed: BodyData;
  private pictures = 0;
  private pending = 0;
  private isFar = false; // from the screen
  private drawn: Instant;
  private announced = -Infinity;
  private fromElsewhere = false;

  constructor(
    data: SceneData,
    private readonly renderer: WebGLRenderer,
  ) {
    this.followed = data.bodies[0]!;
    this.ground = data.ground ? new Ground(data) : null;
    this.camera = new Camera(data, this.followed, this.ground);
    if (data.bodies[0]!.flight) this.camera.setMode("free");
    this.playback = new Playback(data.time, () => this.timeChanged());
    this.drawn = this.playback.instant;
    this.directions = this.ground ? null : new Directions(data.up);
    this.beams = new Beams(data, this.ground);
    this.arrows = new Arrows(data, this.ground);
    this.marks = new Marks(data.bodies, data.sites ?? []);
    this.triad = new Triad(data.axes);
    this.readout = new Readout(data);
    this.shown = data.bodies.map((body) => this.add(body));
    if (this.ground) this.scene.add(this.ground.mesh);
    if (this.directions) this.scene.add(this.directions.lines);
    this.scene.add(this.beams.group, this.arrows.group, new HemisphereLight("#ffffff", "#9a9388", 1.8), this.sun, this.sun.target);
    this.controls = new Controls({
      playback: this.playback,
      camera: this.camera,
      bodies: data.bodies,
      axes: !this.ground,
      followed: () => this.followed,
      follow: (body) => {
        this.follow(body);
        if (body.flight) announceTrial(body.flight, NAME);
      },
      setAxes: (visible) => this.setAxes(visible),
      changed: () => this.changed(),
    });
    this.setAxes(!this.ground);
    this.stage.setAttribute("aria-label", `${data.title}: arrow keys turn, plus and minus zoom, 0 resets, shift moves`);
    this.stage.append(renderer.domElement, this.marks.element, this.arrows.element, this.readout.values, this.triad.element, this.readout.scale);
    this.element = make("div", {}, this.stage, this.controls.element);
    this.listen();
  }

  private add(data: BodyData): Shown {
    const group = new Group();
    const flames = new Flames(data);
    const axes = bodyAxes(1.1 * Math.max(...data.size));
    group.add(makeShape(data), flames.group, axes);
    const path = new Path(data);
    this.scene.add(group, path.group);
    return { data, group, flames, path, axes };
  }

  private listen(): void {
    listen(this.stage, this.camera, () => this.changed());
    this.stage.addEventListener("keydown", (event) => {
      if (event.key !== " ") return;
      event.preventDefault();
      this.playback.toggle();
    });
    followTime(NAME, (time) => {
      if (!Number.isFinite(time)) return;
      if (this.playback.playing) this.playback.pause();
      this.fromElsewhere = true;
      this.playback.seek(time);
      this.fromElsewhere = false;
    });
    followTrial(NAME, ({ variant, trial }) => {
      const body = this.shown.find(({ data: { flight } }) => flight?.variant === variant && flight.trial === trial);
      if (body) this.follow(body.data);
    });
    followTheme(() => this.paint());
    new ResizeObserver(() => this.resize()).observe(this.stage);
  }

  private paint(): void {
    const colours = themeOf(this.stage);
    this.scene.background = new Color(colours.sky);
    this.ground?.setTheme(colours);
    this.directions?.setTheme(colours);
    this.beams.setTheme(colours);
    this.arrows.setTheme(colours);
    for (const { flames, path } of this.shown) {
      flames.setTheme(colours);
      path.setTheme(colours);
    }
    this.changed();
  }

  private follow(body: BodyData): void {
    this.followed = body;
    this.camera.follow(body);
    this.changed();
  }

  private setAxes(visible: boolean): void {
    for (const { axes } of this.shown) axes.visible = visible;
    this.changed();
  }

  private timeChanged(): void {
    this.changed();
    const now = performance.now();
    if (this.fromElsewhere || (this.playback.playing && now - this.announced < ANNOUNCED)) return;
    this.announced = now;
    announceTime(this.playback.instant.time, NAME);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.stage;
    if (!clientWidth || !clientHeight) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, SHARPEST));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.view.aspect = clientWidth / clientHeight;
    this.paint(); // what is not in the page has no colours yet
  }

  // Nothing is drawn while the view is far from the screen.
  set isNear(near: boolean) {
    this.isFar = !near;
    if (near) this.changed();
    else if (this.playback.playing) this.playback.pause();
  }

  // Asks for one new picture.
  changed(): void {
    this.controls?.show();
    if (this.isFar) return;
    this.pending ||= requestAnimationFrame(() => {
      this.pending = 0;
      this.draw();
    });
  }

  private draw(): void {
    const { instant } = this.playback;
    let attitude: Quaternion | null = null;
    for (const { data, group, flames, path } of this.shown) {
      const known = positionAt(data.position, instant, group.position);
      group.visible = attitudeAt(data.attitude, instant, group.quaternion) && known;
      flames.show(instant, this.playback.playing ? this.drawn : instant, this.playback.times);
      path.show(instant);
      if (data === this.followed) attitude = group.quaternion;
    }
    this.drawn = instant;
    this.beams.show(instant);
    const { ground, camera } = this;
    camera.place(instant, attitude);
    ground?.lay(camera.target, Math.max(ground.footOf(camera.view.position).height, 0.2 * camera.distance));
    ground?.shade(this.shown.find(({ data }) => data === this.followed)!.group.position, 0.4 * Math.max(...this.followed.size));
    this.directions?.show(camera.view);
    this.arrows.show(instant, camera, this.stage.clientWidth, this.stage.clientHeight);
    this.light();
    this.renderer.render(this.scene, camera.view);
    this.overlay(instant);
    this.element.dataset["drawn"] = String(++this.pictures);
  }

  private light(): void {
    this.sun.target.position.copy(this.camera.target);
    const [right, back] = [0, 2].map((column) => new Vector3().setFromMatrixColumn(this.camera.view.matrixWorld, column));
    const towards = right!.multiplyScalar(-0.7).addScaledVector(back!, 0.6).add(this.camera.view.up);
    this.sun.position.copy(this.camera.target).addScaledVector(towards, 100);
  }

  private overlay(instant: Instant): void {
    const { clientWidth: width, clientHeight: height } = this.stage;
    this.marks.show(instant, this.followed, this.camera, this.ground, width, height);
    this.triad.show(this.camera.view);
    const position = new Vector3();
    const known = positionAt(this.followed.position, instant, position);
    this.readout.showValues(instant, this.followed, known && this.ground ? this.ground.footOf(position) : null);
    const visible = 2 * this.camera.distance * Math.tan((this.camera.view.fov * Math.PI) / 360);
    this.readout.showScale(visible / Math.max(height, 1), width, this.ground);
  }
}
