// The camera: around the followed body in axes of the horizon (follow) or of its motion (chase), or around any point.

import { PerspectiveCamera, Quaternion, Vector3 } from "three";
import type { BodyData, SceneData } from "./document";
import type { Foot, Ground } from "./objects/ground";
import { type Instant, positionAt, sampleAt } from "./instant";

export type Mode = "follow" | "chase" | "free";

const STEEPEST = (89 * Math.PI) / 180;
const LOWEST = 0.05; // of the distance: the camera stays so far above the ground
const NEAR = 0.01; // of the distance
const ASIDE = 0.6; // rad, of the free camera from the side of the body
const [LOW, HIGH] = [0.35, 1.2]; // rad, its elevation
const UP = { x: new Vector3(1, 0, 0), y: new Vector3(0, 1, 0), z: new Vector3(0, 0, 1) };
const FORWARD = { x: new Vector3(0, 1, 0), y: new Vector3(1, 0, 0), z: new Vector3(1, 0, 0) };

export class Camera {
  readonly view: PerspectiveCamera;
  readonly target = new Vector3();
  mode: Mode = "follow";
  azimuth = 0;
  elevation = 0;
  distance = 1;
  private readonly whole: { middle: Vector3; radius: number };
  private motion: Float32Array | null = null;
  private readonly position = new Vector3(); // of the body
  private readonly up = new Vector3();
  private readonly forward = new Vector3();

  constructor(
    private readonly scene: SceneData,
    private followed: BodyData,
    private readonly ground: Ground | null,
  ) {
    this.view = new PerspectiveCamera((scene.camera.field * 180) / Math.PI, 1, 0.1, 1e4);
    this.whole = wholeOf(scene);
    this.follow(followed);
  }

  follow(body: BodyData): void {
    this.followed = body;
    this.motion = motionOf(body);
    this.reset();
  }

  setMode(mode: Mode): void {
    this.mode = mode;
    this.reset();
  }

  reset(): void {
    const { azimuth, elevation, diagonals, field, room } = this.scene.camera;
    this.azimuth = this.mode === "chase" ? Math.PI : azimuth;
    this.elevation = elevation;
    this.distance = Math.max(diagonals * Math.hypot(...this.followed.size), (room * extentOf(this.scene, this.followed)) / Math.sin(field / 2));
    if (this.mode === "free") {
      this.distance = Math.max((1.05 * this.whole.radius) / Math.sin(field / 2), this.distance);
      this.target.copy(this.whole.middle);
      this.lookFromBody();
    }
  }

  // From the side on which the body is now, and aside of it.
  private lookFromBody(): void {
    const away = this.position.clone().sub(this.target);
    if (away.length() < 0.1 * this.whole.radius) return;
    this.level();
    const across = this.up.clone().cross(this.forward);
    const [a, b, c] = [this.forward, across, this.up].map((axis) => axis.dot(away) / away.length());
    this.azimuth = Math.atan2(b!, a!) + ASIDE;
    this.elevation = Math.min(Math.max(Math.asin(c!), LOW), HIGH);
  }

  turn(azimuth: number, elevation: number): void {
    this.azimuth += azimuth;
    this.elevation = Math.min(Math.max(this.elevation + elevation, -STEEPEST), STEEPEST);
  }

  zoom(factor: number): void {
    const smallest = 0.8 * Math.max(...this.followed.size);
    this.distance = Math.min(Math.max(this.distance * factor, smallest), 20 * (this.whole.radius + smallest));
  }

  // Moves the point looked at across the view, by fractions of its height; the camera is then free.
  pan(right: number, upwards: number): void {
    this.mode = "free";
    const height = 2 * this.distance * Math.tan(this.scene.camera.field / 2);
    const axis = new Vector3();
    this.view.matrixWorld.extractBasis(axis, new Vector3(), new Vector3());
    this.target.addScaledVector(axis, right * height);
    this.view.matrixWorld.extractBasis(new Vector3(), axis, new Vector3());
    this.target.addScaledVector(axis, upwards * height);
  }

  // Up and forward at the target: of the horizon there, of the frame where it is deep inside of the ground's sphere.
  private level(): void {
    const foot = this.ground?.footOf(this.target);
    const near = foot && !(foot.height < -0.5 * this.ground!.radius);
    this.up.copy(near ? foot.up : UP[this.scene.up]);
    this.forward.copy(near ? foot.along : FORWARD[this.scene.up]);
  }

  // Puts the camera at a time.
  place(instant: Instant, attitude: Quaternion | null): void {
    positionAt(this.followed.position, instant, this.position);
    if (this.mode !== "free") this.target.copy(this.position);
    this.level();
    if (this.mode === "chase") this.turnToMotion(instant, attitude);
    const across = this.up.clone().cross(this.forward);
    const level = Math.cos(this.elevation);
    const offset = this.forward
      .clone()
      .multiplyScalar(level * Math.cos(this.azimuth))
      .addScaledVector(across, level * Math.sin(this.azimuth))
      .addScaledVector(this.up, Math.sin(this.elevation))
      .multiplyScalar(this.distance);
    const { view } = this;
    view.position.copy(this.target).add(offset);
    if (this.ground) {
      const { height, up } = this.ground.footOf(view.position);
      const lowest = Math.min(LOWEST * this.distance, 2);
      if (height < lowest) view.position.addScaledVector(up, lowest - height);
    }
    view.up.copy(this.up);
    view.lookAt(this.target);
    view.near = NEAR * this.distance;
    view.far = this.farthest(this.ground?.footOf(view.position));
    view.updateProjectionMatrix();
    view.updateMatrixWorld();
  }

  // How far (m) the ground and all that has flown can be seen.
  private farthest(foot: Foot | undefined): number {
    const around = this.view.position.distanceTo(this.whole.middle) + 2 * this.whole.radius + 10 * this.distance;
    if (!foot) return around;
    const radius = this.scene.ground?.radius;
    const height = Math.max(foot.height, 1);
    return Math.max(around, radius ? 3 * Math.sqrt(height * (2 * radius + height)) : 4e5 + 2 * height);
  }

  // Forward is where the body moves along the ground; of a body that does not move it is its own axis.
  private turnToMotion(instant: Instant, attitude: Quaternion | null): void {
    if (this.motion) {
      const forward = new Vector3().fromArray(this.motion, 3 * instant.row);
      forward.addScaledVector(this.up, -forward.dot(this.up));
      if (forward.lengthSq() > 1e-6) this.forward.copy(forward.normalize());
    } else if (attitude) {
      this.up.copy(UP[this.scene.up]).applyQuaternion(attitude);
      this.forward.copy(FORWARD[this.scene.up]).applyQuaternion(attitude);
    }
  }
}

// How far (m) other bodies reach from one at the start.
function extentOf(scene: SceneData, body: BodyData): number {
  const [from, to] = [new Vector3(), new Vector3()];
  if (!sampleAt(body.position, 0, from)) return 0;
  let extent = 0;
  for (const other of scene.bodies) {
    if (other === body || !sampleAt(other.position, 0, to)) continue;
    extent = Math.max(extent, to.distanceTo(from) + Math.hypot(...other.size) / 2);
  }
  return extent;
}

// A ball around all positions.
function wholeOf(scene: SceneData): { middle: Vector3; radius: number } {
  const low = new Vector3(Infinity, Infinity, Infinity);
  const high = new Vector3(-Infinity, -Infinity, -Infinity);
  const point = new Vector3();
  let largest = 0;
  for (const { position, size } of scene.bodies) {
    largest = Math.max(largest, ...size);
    for (let row = 0; row < scene.time.length; row++) {
      if (sampleAt(position, row, point)) {
        low.min(point);
        high.max(point);
      }
    }
  }
  if (low.x > high.x) return { middle: new Vector3(), radius: 2 * largest };
  return { middle: low.clone().add(high).multiplyScalar(0.5), radius: low.distanceTo(high) / 2 + 2 * largest };
}

// Unit vectors of motion by sample, each over as many samples as it takes to move by a tenth of the body; null where it
// never does.
function motionOf(body: BodyData): Float32Array | null {
  const rows = body.position[0]!.length;
  const result = new Float32Array(3 * rows);
  const [before, now] = [new Vector3(), new Vector3()];
  const far = 0.1 * Math.max(...body.size);
  const last = new Vector3();
  let first = -1;
  let known = sampleAt(body.position, 0, before);
  for (let row = 1; row < rows; row++) {
    if (!sampleAt(body.position, row, now)) continue;
    if (!known) {
      before.copy(now);
      known = true;
    } else if (now.distanceTo(before) > far) {
      last.copy(now).sub(before).normalize();
      before.copy(now);
      if (first < 0) first = row;
    }
    last.toArray(result, 3 * row);
  }
  if (first < 0) return null;
  for (let row = 0; row < first; row++) result.copyWithin(3 * row, 3 * first, 3 * first + 3);
  return result;
}
