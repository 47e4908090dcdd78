// The shapes of bodies: each fills its extents along the body's axes (m). A lander stands on z = 0, others are centred.

import {
  BoxGeometry,
  BufferGeometry,
  CylinderGeometry,
  DoubleSide,
  Group,
  LatheGeometry,
  Mesh,
  MeshLambertMaterial,
  Quaternion,
  Vector2,
  Vector3,
} from "three";
import type { Triple } from "../document";

const material = (color: string) => new MeshLambertMaterial({ color, side: DoubleSide });
const FOIL = material("#c8a040");
const METAL = material("#c9ced4");
const DARK = material("#4a4f57");
const SHIELD = material("#6b4a36");
const PANEL = material("#27408b");
const MARK = material("#d9480f");

const BUILDERS: Record<string, (group: Group, size: Triple) => void> = { box, capsule, cylinder, lander, satellite };

export function makeShape(shape: string, size: Triple, at: Triple): Group {
  const group = new Group();
  BUILDERS[shape]?.(group, size);
  group.position.set(...at);
  return group;
}

function add(group: Group, geometry: BufferGeometry, of: MeshLambertMaterial, at: Triple = [0, 0, 0]): Mesh {
  const mesh = new Mesh(geometry, of);
  mesh.position.set(...at);
  group.add(mesh);
  return mesh;
}

// A cylinder, or a cone, from the plane z = low to z = high.
function upright(bottom: number, top: number, low: number, high: number, sides = 32): BufferGeometry {
  const geometry = new CylinderGeometry(top, bottom, high - low, sides);
  return geometry.rotateX(Math.PI / 2).translate(0, 0, (low + high) / 2);
}

function strut(group: Group, from: Vector3, to: Vector3, radius: number): void {
  const direction = to.clone().sub(from);
  const mesh = add(group, new CylinderGeometry(radius, radius, direction.length(), 8), METAL);
  mesh.position.copy(from).add(to).multiplyScalar(0.5);
  mesh.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), direction.normalize()));
}

// Its +x face has a mark, its +z face a lid.
function box(group: Group, [x, y, z]: Triple): void {
  add(group, new BoxGeometry(0.94 * x, y, 0.96 * z), METAL, [-0.03 * x, 0, -0.02 * z]);
  add(group, new BoxGeometry(0.06 * x, 0.5 * y, 0.5 * z), MARK, [0.47 * x, 0, 0]);
  add(group, new BoxGeometry(0.6 * x, 0.6 * y, 0.04 * z), DARK, [-0.05 * x, 0, 0.48 * z]);
}

// Along z, with a stripe on +x.
function cylinder(group: Group, [x, y, z]: Triple): void {
  const whole = new Group();
  whole.scale.set(x, y, z);
  add(whole, upright(0.5, 0.5, -0.5, 0.42), METAL);
  add(whole, upright(0.5, 0.3, 0.42, 0.5), DARK);
  add(whole, upright(0.501, 0.501, -0.3, -0.24), DARK);
  const stripe = new CylinderGeometry(0.502, 0.502, 0.88, 6, 1, true, Math.PI / 2 - 0.12, 0.24);
  add(whole, stripe.rotateX(Math.PI / 2), MARK, [0, 0, -0.05]);
  group.add(whole);
}

// Its heat shield is towards +x, its window towards +y.
function capsule(group: Group, [x, y, z]: Triple): void {
  const whole = new Group();
  whole.scale.set(x, y, z);
  const profile = [[0, -0.5], [0.2, -0.5], [0.24, -0.46], [0.5, 0.22], [0.48, 0.28]].map(([r, h]) => new Vector2(r, h));
  const shield = Array.from({ length: 13 }, (_, k) => {
    const angle = ((1 - k / 12) * Math.PI) / 2;
    return new Vector2(0.48 * Math.sin(angle), 0.28 + 0.22 * Math.cos(angle));
  });
  const about = (points: Vector2[]) => new LatheGeometry(points, 48).rotateZ(-Math.PI / 2);
  add(whole, about(profile), METAL);
  add(whole, about(shield), SHIELD);
  const window = add(whole, new BoxGeometry(0.16, 0.04, 0.14), DARK, [0, 0.405, 0]);
  window.rotation.z = -0.36;
  add(whole, new BoxGeometry(0.3, 0.01, 0.03), MARK, [-0.1, -0.37, 0]).rotation.z = 0.36;
  group.add(whole);
}

// An octagonal stage on four legs, its engine below, its deck above; x, y are the width over the pads.
function lander(group: Group, [x, y, z]: Triple): void {
  const whole = new Group();
  whole.scale.set(x, y, z);
  add(whole, upright(0.3, 0.3, 0.3, 0.68, 8).rotateZ(Math.PI / 8), FOIL);
  add(whole, upright(0.3, 0.2, 0.68, 0.8, 8).rotateZ(Math.PI / 8), METAL);
  add(whole, upright(0.1, 0.1, 0.8, 0.92), METAL);
  add(whole, upright(0.02, 0.02, 0.92, 1), DARK);
  add(whole, upright(0.12, 0.05, 0.14, 0.3), DARK);
  add(whole, new BoxGeometry(0.02, 0.2, 0.2), MARK, [0.285, 0, 0.49]);
  for (let leg = 0; leg < 4; leg++) {
    const angle = Math.PI / 4 + (leg * Math.PI) / 2;
    const out = new Vector3(Math.cos(angle), Math.sin(angle), 0);
    const across = new Vector3(-out.y, out.x, 0).multiplyScalar(0.14);
    const foot = out.clone().multiplyScalar(0.6).setZ(0.04);
    strut(whole, out.clone().multiplyScalar(0.28).setZ(0.62), foot, 0.014);
    for (const side of [1, -1]) {
      strut(whole, out.clone().multiplyScalar(0.26).addScaledVector(across, side).setZ(0.34), foot, 0.01);
    }
    add(whole, upright(0.07, 0.05, 0, 0.04, 16), METAL, [foot.x, foot.y, 0]);
  }
  group.add(whole);
}

// A bus with two panels along the longer of y and z; its +x end has a mark.
function satellite(group: Group, [x, y, z]: Triple): void {
  const alongZ = z > y;
  const [span, depth] = alongZ ? [z, y] : [y, z];
  const whole = new Group();
  const width = Math.min(depth, 0.36 * span);
  add(whole, new BoxGeometry(0.96 * x, width, depth), METAL, [-0.02 * x, 0, 0]);
  add(whole, new BoxGeometry(0.04 * x, 0.5 * width, 0.5 * depth), MARK, [0.48 * x, 0, 0]);
  const length = (span - width) / 2;
  for (const side of [1, -1]) {
    const middle = side * (width / 2 + length / 2);
    add(whole, new BoxGeometry(0.03 * x, length, 0.06 * depth), DARK, [0, middle, 0]);
    for (const part of [-1, 0, 1]) {
      const at: Triple = [0, middle + (part * length) / 3.3, 0];
      add(whole, new BoxGeometry(0.5 * x, length / 3.6, 0.03 * depth), PANEL, at);
    }
  }
  if (alongZ) whole.rotation.x = Math.PI / 2;
  group.add(whole);
}
