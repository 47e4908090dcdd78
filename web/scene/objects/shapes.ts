// The shapes of bodies: each fills its extents along the body's axes (m). A lander stands on z = 0, others are centred.

import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Color,
  CylinderGeometry,
  DoubleSide,
  LatheGeometry,
  Mesh,
  MeshLambertMaterial,
  Quaternion,
  Vector2,
  Vector3,
} from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { SHIP } from "../../generated/colours";
import type { BodyData, Triple } from "../document";

const { foil: FOIL, metal: METAL, dark: DARK, shield: SHIELD, panel: PANEL, mark: MARK } = SHIP;
const BUILDERS: Record<string, (pieces: BufferGeometry[], size: Triple) => void> = {
  box,
  capsule,
  cylinder,
  lander,
  satellite,
};

// One mesh, since each costs time in a software renderer.
export function makeShape({ shape, size, at, panels }: BodyData): Mesh {
  const pieces: BufferGeometry[] = [];
  BUILDERS[shape]?.(pieces, size);
  for (const piece of pieces) piece.translate(...at);
  for (const panel of panels ?? []) add(pieces, new BoxGeometry(...panel.size), PANEL, panel.at);
  return new Mesh(mergeGeometries(pieces), new MeshLambertMaterial({ vertexColors: true, side: DoubleSide }));
}

function add(pieces: BufferGeometry[], geometry: BufferGeometry, colour: string, at: Triple = [0, 0, 0]): void {
  const piece = geometry.toNonIndexed().translate(...at);
  piece.deleteAttribute("uv");
  const { count } = piece.getAttribute("position");
  const components = new Color(colour).toArray();
  const colours = Float32Array.from({ length: 3 * count }, (_, index) => components[index % 3]!);
  piece.setAttribute("color", new BufferAttribute(colours, 3));
  pieces.push(piece);
}

// Of extents 1 so far.
function scale(pieces: BufferGeometry[], [x, y, z]: Triple): void {
  for (const piece of pieces) piece.scale(x, y, z);
}

// A cylinder, or a cone, from the plane z = low to z = high.
function upright(bottom: number, top: number, low: number, high: number, sides = 32): BufferGeometry {
  const geometry = new CylinderGeometry(top, bottom, high - low, sides);
  return geometry.rotateX(Math.PI / 2).translate(0, 0, (low + high) / 2);
}

function strut(pieces: BufferGeometry[], from: Vector3, to: Vector3, radius: number): void {
  const direction = to.clone().sub(from);
  const geometry = new CylinderGeometry(radius, radius, direction.length(), 8);
  geometry.applyQuaternion(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), direction.normalize()));
  const middle = from.clone().add(to).multiplyScalar(0.5);
  add(pieces, geometry, METAL, [middle.x, middle.y, middle.z]);
}

// Its +x face has a mark, its +z face a lid.
function box(pieces: BufferGeometry[], [x, y, z]: Triple): void {
  add(pieces, new BoxGeometry(0.94 * x, y, 0.96 * z), METAL, [-0.03 * x, 0, -0.02 * z]);
  add(pieces, new BoxGeometry(0.06 * x, 0.5 * y, 0.5 * z), MARK, [0.47 * x, 0, 0]);
  add(pieces, new BoxGeometry(0.6 * x, 0.6 * y, 0.04 * z), DARK, [-0.05 * x, 0, 0.48 * z]);
}

// Along z, with a stripe on +x.
function cylinder(pieces: BufferGeometry[], size: Triple): void {
  add(pieces, upright(0.5, 0.5, -0.5, 0.42), METAL);
  add(pieces, upright(0.5, 0.3, 0.42, 0.5), DARK);
  add(pieces, upright(0.501, 0.501, -0.3, -0.24), DARK);
  const stripe = new CylinderGeometry(0.502, 0.502, 0.88, 6, 1, true, Math.PI / 2 - 0.12, 0.24);
  add(pieces, stripe.rotateX(Math.PI / 2), MARK, [0, 0, -0.05]);
  scale(pieces, size);
}

// Its heat shield is towards +x, its window towards +y.
function capsule(pieces: BufferGeometry[], size: Triple): void {
  const profile = [[0, -0.5], [0.2, -0.5], [0.24, -0.46], [0.5, 0.22], [0.48, 0.28]].map(([r, h]) => new Vector2(r, h));
  const shield = Array.from({ length: 13 }, (_, k) => {
    const angle = ((1 - k / 12) * Math.PI) / 2;
    return new Vector2(0.48 * Math.sin(angle), 0.28 + 0.22 * Math.cos(angle));
  });
  const about = (points: Vector2[]) => new LatheGeometry(points, 48).rotateZ(-Math.PI / 2);
  add(pieces, about(profile), METAL);
  add(pieces, about(shield), SHIELD);
  add(pieces, new BoxGeometry(0.16, 0.04, 0.14).rotateZ(-0.36), DARK, [0, 0.405, 0]);
  add(pieces, new BoxGeometry(0.3, 0.01, 0.03).rotateZ(0.36), MARK, [-0.1, -0.37, 0]);
  scale(pieces, size);
}

// An octagonal stage on four legs, its engine below, its deck above; x, y are the width over the pads.
function lander(pieces: BufferGeometry[], size: Triple): void {
  add(pieces, upright(0.3, 0.3, 0.3, 0.68, 8).rotateZ(Math.PI / 8), FOIL);
  add(pieces, upright(0.3, 0.2, 0.68, 0.8, 8).rotateZ(Math.PI / 8), METAL);
  add(pieces, upright(0.1, 0.1, 0.8, 0.92), METAL);
  add(pieces, upright(0.02, 0.02, 0.92, 1), DARK);
  add(pieces, upright(0.12, 0.05, 0.14, 0.3), DARK);
  add(pieces, new BoxGeometry(0.02, 0.2, 0.2), MARK, [0.285, 0, 0.49]);
  for (let leg = 0; leg < 4; leg++) {
    const angle = Math.PI / 4 + (leg * Math.PI) / 2;
    const out = new Vector3(Math.cos(angle), Math.sin(angle), 0);
    const across = new Vector3(-out.y, out.x, 0).multiplyScalar(0.14);
    const foot = out.clone().multiplyScalar(0.6).setZ(0.04);
    strut(pieces, out.clone().multiplyScalar(0.28).setZ(0.62), foot, 0.014);
    for (const side of [1, -1]) {
      strut(pieces, out.clone().multiplyScalar(0.26).addScaledVector(across, side).setZ(0.34), foot, 0.01);
    }
    add(pieces, upright(0.07, 0.05, 0, 0.04, 16), METAL, [foot.x, foot.y, 0]);
  }
  scale(pieces, size);
}

// A bus with two panels along the longer of y and z; its +x end has a mark.
function satellite(pieces: BufferGeometry[], [x, y, z]: Triple): void {
  const alongZ = z > y;
  const [span, depth] = alongZ ? [z, y] : [y, z];
  const width = Math.min(depth, 0.36 * span);
  add(pieces, new BoxGeometry(0.96 * x, width, depth), METAL, [-0.02 * x, 0, 0]);
  add(pieces, new BoxGeometry(0.04 * x, 0.5 * width, 0.5 * depth), MARK, [0.48 * x, 0, 0]);
  const length = (span - width) / 2;
  for (const side of [1, -1]) {
    const middle = side * (width / 2 + length / 2);
    add(pieces, new BoxGeometry(0.03 * x, length, 0.06 * depth), DARK, [0, middle, 0]);
    for (const part of [-1, 0, 1]) {
      const at: Triple = [0, middle + (part * length) / 3.3, 0];
      add(pieces, new BoxGeometry(0.5 * x, length / 3.6, 0.03 * depth), PANEL, at);
    }
  }
  if (alongZ) for (const piece of pieces) piece.rotateX(Math.PI / 2);
}
