// Plumes of thrust and flames of jets, children of their body.

import { BufferAttribute, Color, ConeGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, Vector3 } from "three";
import type { BodyData, JetData, ThrustData, Triple } from "../document";
import { type Instant, scalarAt } from "../instant";
import type { Theme } from "../theme";

const WIDTH = 0.07; // radius of a plume over its full length
const JET = 0.25; // the longest flame of a jet over the body's largest extent
const ABOVE = 1e-9; // of the largest: less is nothing

export class Flames {
  readonly group = new Group();
  private readonly material = new MeshBasicMaterial({ vertexColors: true, transparent: true, side: DoubleSide, forceSinglePass: true, depthWrite: false });
  private readonly plumes: { mesh: Mesh; thrust: ThrustData; full: number }[];
  private readonly jets: { flames: [Mesh[], Mesh[]]; jet: JetData; full: number }[];

  constructor(body: BodyData) {
    const extent = Math.max(...body.size);
    this.plumes = (body.thrusts ?? []).map((thrust) => ({
      mesh: this.add(thrust.at, thrust.along, 1),
      thrust,
      full: thrust.length,
    }));
    this.jets = (body.jets ?? []).map((jet) => ({ flames: [this.pair(jet, 1), this.pair(jet, -1)], jet, full: JET * extent }));
  }

  setTheme(theme: Theme): void {
    this.material.color = new Color(theme.flame);
  }

  // Between `since` and the instant a short pulse may have come and gone: it is shown, too.
  show(instant: Instant, since: Instant, times: ArrayLike<number>): void {
    for (const { mesh, thrust, full } of this.plumes) {
      setLength(mesh, (full * scalarAt(thrust.values, instant)) / (thrust.largest || 1), full);
    }
    for (const { flames, jet, full } of this.jets) {
      const value = jet.pulse ? firing(jet, instant, since, times) : jet.values[instant.row]! / (jet.largest || 1);
      for (const mesh of flames[0]) setLength(mesh, full * Math.max(value, 0), full);
      for (const mesh of flames[1]) setLength(mesh, full * Math.max(-value, 0), full);
    }
  }

  // A flame at a point, against the direction in which it pushes; of sign -1 the other way.
  private add(at: Triple, along: Triple, sign: number): Mesh {
    const mesh = new Mesh(cone(), this.material);
    mesh.position.set(...at);
    mesh.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...along).multiplyScalar(-sign));
    this.group.add(mesh);
    return mesh;
  }

  // The flames of a jet that pushes by this sign: one, or of a couple two.
  private pair(jet: JetData, sign: number): Mesh[] {
    const mirrored = jet.at.map((component) => -component) as Triple;
    const first = this.add(jet.at, jet.along, sign);
    return jet.couple ? [first, this.add(mirrored, jet.along, -sign)] : [first];
  }
}

// 1, 0 or -1: whether a pulse is on, or was since the last picture.
function firing(jet: JetData, instant: Instant, since: Instant, times: ArrayLike<number>): number {
  const first = Math.min(since.row, instant.row);
  for (let row = instant.row; row >= first; row--) {
    const left = jet.values[row]!;
    const from = row === since.row ? since.time : times[row]!;
    if (left !== 0 && (row < instant.row ? from : instant.time) - times[row]! < Math.abs(left)) return Math.sign(left);
  }
  return 0;
}

function setLength(mesh: Mesh, length: number, full: number): void {
  mesh.visible = length > ABOVE * full;
  const width = WIDTH * full * Math.sqrt(Math.min(1, length / full));
  mesh.scale.set(width, length, width);
}

// From the origin along y, of length and radius 1, transparent at its end.
function cone(): ConeGeometry {
  const geometry = new ConeGeometry(1, 1, 20, 1, true);
  geometry.translate(0, 0.5, 0);
  const points = geometry.getAttribute("position");
  const colours = new Float32Array(4 * points.count);
  for (let point = 0; point < points.count; point++) colours.set([1, 1, 1, points.getY(point) > 0.5 ? 0 : 0.9], 4 * point);
  geometry.setAttribute("color", new BufferAttribute(colours, 4));
  return geometry;
}
