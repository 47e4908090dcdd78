// The ground: a plane or a sphere with a grid in metres, as a patch around the point below what the camera looks at.
//
// On a sphere the grid is laid along and across the great circle of the flight, with distances along the ground.

import { BufferAttribute, BufferGeometry, Color, Matrix4, Mesh, ShaderMaterial, Vector2, Vector3 } from "three";
import type { SceneData } from "../document";
import { groundFragment, groundVertex } from "./ground_shader";
import type { Theme } from "../theme";

const SECTORS = 64;
const NEAREST = 1; // m, of the innermost ring
const FARTHEST = 3e5; // m, of a plane
const GROWTH = 1.5; // from ring to ring
const WIDEST = Math.PI / 60; // rad, between two rings of a sphere
const SHADE = 0.45; // darkness of a shadow on the ground
const REPEAT = 100; // of the heavy lines: positions count modulo so many

// Where a point is against the ground: its height, and the frame at the point below.
export interface Foot {
  height: number;
  point: Vector3;
  up: Vector3;
  along: Vector3;
}

export class Ground {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  readonly radius: number; // m, infinite for a plane
  private readonly centre = new Vector3();
  private readonly level: number;
  private readonly normal: Vector3;
  spacing = 1; // m, of the fine lines; heavy ones are ten times as far apart

  constructor(private readonly scene: SceneData) {
    const ground = scene.ground!;
    this.radius = ground.radius ?? Infinity;
    this.level = -scene.origin[2];
    this.normal = new Vector3(...(ground.normal ?? [0, 1, 0]));
    if (ground.centre) this.centre.set(...ground.centre).sub(new Vector3(...scene.origin));
    this.mesh = new Mesh(patch(this.radius), material(this.radius));
    this.mesh.frustumCulled = false;
  }

  setTheme(theme: Theme): void {
    const { uniforms } = this.mesh.material;
    uniforms["base"]!.value = new Color(theme.ground).convertLinearToSRGB();
    uniforms["haze"]!.value = new Color(theme.haze).convertLinearToSRGB();
    uniforms["line"]!.value = new Color(theme.grid).convertLinearToSRGB();
  }

  footOf(position: Vector3): Foot {
    if (!Number.isFinite(this.radius)) {
      const point = new Vector3(position.x, position.y, this.level);
      return { height: position.z - this.level, point, up: new Vector3(0, 0, 1), along: new Vector3(1, 0, 0) };
    }
    const up = position.clone().sub(this.centre);
    const height = up.length() - this.radius;
    up.normalize();
    const point = this.centre.clone().addScaledVector(up, this.radius);
    return { height, point, up, along: this.normal.clone().cross(up).normalize() };
  }

  // The shadow of a body of this radius (m), upright below it.
  shade(position: Vector3, radius: number): void {
    const { height, point } = this.footOf(position);
    const at = this.mesh.worldToLocal(point);
    (this.mesh.material.uniforms["shadow"]!.value as Vector3).set(at.x, at.y, radius + 0.1 * Math.max(height, 0));
    this.mesh.material.uniforms["shade"]!.value = SHADE / (1 + height / (10 * radius));
  }

  // Whether the ground is between two points.
  hides(from: Vector3, to: Vector3): boolean {
    if (!Number.isFinite(this.radius)) return (from.z - this.level) * (to.z - this.level) < 0;
    const start = from.clone().sub(this.centre);
    const way = to.clone().sub(from);
    const share = Math.min(Math.max(-start.dot(way) / way.lengthSq(), 0), 1);
    return start.addScaledVector(way, share).length() < this.radius - 0.5;
  }

  // Lays the patch below a point, with a grid for a camera at this distance (m) from the ground.
  lay(position: Vector3, distance: number): void {
    const { point, up, along } = this.footOf(position);
    const across = up.clone().cross(along);
    this.mesh.position.copy(point);
    this.mesh.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(along, across, up));
    this.mesh.updateMatrixWorld();
    const decade = Math.log10(Math.max(distance, 1e-3) / 3);
    this.spacing = 10 ** Math.floor(decade);
    const { uniforms } = this.mesh.material;
    uniforms["spacing"]!.value = this.spacing;
    uniforms["fine"]!.value = 1 - (decade - Math.floor(decade));
    const repeat = REPEAT * 10 * this.spacing;
    const [first, second, tilt] = this.coordinates(point, up);
    (uniforms["offset"]!.value as Vector2).set(first % repeat, second % repeat);
    uniforms["tilt"]!.value = tilt;
  }

  // Distances (m) along and across the great circle, and the angle (rad) across it; of a plane x and y.
  private coordinates(point: Vector3, up: Vector3): [number, number, number] {
    const [x, y] = this.scene.origin;
    if (!Number.isFinite(this.radius)) return [point.x + x, point.y + y, 0];
    const zero = new Vector3(0, 0, 1);
    const angle = Math.atan2(this.normal.clone().cross(zero).dot(up), zero.dot(up));
    return [this.radius * angle, 0, Math.asin(Math.min(Math.max(this.normal.dot(up), -1), 1))];
  }
}

function material(radius: number): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: groundVertex,
    fragmentShader: groundFragment,
    uniforms: {
      radius: { value: Number.isFinite(radius) ? radius : 0 },
      spacing: { value: 1 },
      fine: { value: 1 },
      offset: { value: new Vector2() },
      tilt: { value: 0 },
      shadow: { value: new Vector3() },
      shade: { value: 0 },
      base: { value: new Color() },
      haze: { value: new Color() },
      line: { value: new Color() },
    },
  });
}

// Rings around the origin, farther apart with distance, whose z is that of the sphere below its tangent plane.
function patch(radius: number): BufferGeometry {
  const round = Number.isFinite(radius);
  const farthest = round ? Math.PI * radius : FARTHEST;
  const arcs = [NEAREST];
  for (let arc = NEAREST; arc < farthest; arcs.push(arc)) arc = Math.min(GROWTH * arc, arc + WIDEST * radius, farthest);
  const positions = new Float32Array(3 * (1 + arcs.length * SECTORS));
  const faces: number[] = [];
  for (const [ring, arc] of arcs.entries()) {
    const distance = round ? radius * Math.sin(arc / radius) : arc;
    const drop = round ? 2 * radius * Math.sin(arc / (2 * radius)) ** 2 : 0;
    for (let sector = 0; sector < SECTORS; sector++) {
      const angle = (2 * Math.PI * sector) / SECTORS;
      const at = 1 + ring * SECTORS + sector;
      positions.set([distance * Math.cos(angle), distance * Math.sin(angle), -drop], 3 * at);
      const beside = 1 + ring * SECTORS + ((sector + 1) % SECTORS);
      if (ring === 0) faces.push(0, at, beside);
      else faces.push(at - SECTORS, at, beside, at - SECTORS, beside, beside - SECTORS);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setIndex(faces);
  return geometry;
}
