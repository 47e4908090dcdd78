// The path of a body: what it has flown, and, fainter, what lies ahead. Samples on a straight line are left out, and
// vertices are relative to the first of their stretch, since float32 is not exact enough for all of a path.

import { BufferAttribute, BufferGeometry, Color, Group, Line, LineBasicMaterial, Vector3 } from "three";
import type { BodyData } from "../document";
import { type Instant, positionAt, sampleAt } from "../instant";
import { lineColour, type Theme } from "../theme";

const STRETCH = 2048; // vertices
const AHEAD = 0.45; // opacity
const BEND = 1e-3; // rad, at which a vertex is made
const SHORT = 0.02; // of the body: shorter steps are none

interface Stretch {
  rows: number[]; // of its vertices
  flown: Line;
  ahead: Line;
}

export class Path {
  readonly group = new Group();
  private readonly flown = new LineBasicMaterial();
  private readonly ahead = new LineBasicMaterial({ transparent: true, opacity: AHEAD, depthWrite: false });
  private readonly stretches: Stretch[] = [];
  private readonly last: Line<BufferGeometry, LineBasicMaterial>; // from the last vertex flown to now
  private readonly start = new Vector3();
  private readonly now = new Vector3();

  constructor(private readonly body: BodyData) {
    const { flown, ahead } = this;
    const vertices = bends(body);
    for (let first = 0; first < vertices.length - 1; first += STRETCH) {
      const rows = vertices.slice(first, first + STRETCH + 1);
      const at = this.at(rows[0]!);
      const points = rows.flatMap((row) => this.at(row).sub(at).toArray());
      const attribute = new BufferAttribute(new Float32Array(points), 3);
      const make = (material: LineBasicMaterial) => this.add(new BufferGeometry().setAttribute("position", attribute), material, at);
      this.stretches.push({ rows, flown: make(flown), ahead: make(ahead) });
    }
    const ends = new BufferAttribute(new Float32Array(6), 3);
    this.last = this.add(new BufferGeometry().setAttribute("position", ends), flown, this.start);
  }

  setTheme(theme: Theme): void {
    for (const material of [this.flown, this.ahead]) material.color = this.body.flight?.failed ? new Color(theme.failed) : lineColour(this.body.colour, theme);
  }

  show(instant: Instant): void {
    let before = -1;
    for (const { rows, flown, ahead } of this.stretches) {
      const passed = countUntil(rows, instant.row);
      if (passed > 0) before = rows[passed - 1]!;
      flown.visible = passed > 1;
      ahead.visible = passed < rows.length;
      flown.geometry.setDrawRange(0, passed);
      const from = Math.max(passed - 1, 0);
      ahead.geometry.setDrawRange(from, rows.length - from);
    }
    this.last.visible = before >= 0 && positionAt(this.body.position, instant, this.now);
    if (!this.last.visible) return;
    this.last.position.copy(this.at(before));
    const { x, y, z } = this.now.sub(this.last.position);
    (this.last.geometry.getAttribute("position") as BufferAttribute).setXYZ(1, x, y, z).needsUpdate = true;
  }

  private add(geometry: BufferGeometry, material: LineBasicMaterial, at: Vector3): Line<BufferGeometry, LineBasicMaterial> {
    const line = new Line(geometry, material);
    line.position.copy(at);
    line.frustumCulled = false;
    this.group.add(line);
    return line;
  }

  private at(row: number): Vector3 {
    sampleAt(this.body.position, row, this.start);
    return this.start.clone();
  }
}

// The samples at which a path bends, and both its ends; those without a position are left out.
function bends(body: BodyData): number[] {
  const short = SHORT * Math.max(...body.size);
  const [before, now, way, next] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
  const rows: number[] = [];
  let last = -1;
  for (let row = 0; row < body.position[0]!.length; row++) {
    if (!sampleAt(body.position, row, now)) continue;
    if (rows.length === 0) rows.push(row);
    else if (now.distanceTo(before) < short) continue;
    else {
      next.copy(now).sub(before).normalize();
      if (way.lengthSq() > 0 && way.dot(next) < Math.cos(BEND)) {
        rows.push(last);
        way.copy(next);
      } else if (way.lengthSq() === 0) way.copy(next);
    }
    before.copy(now);
    last = row;
  }
  if (last > (rows.at(-1) ?? last)) rows.push(last);
  return rows;
}

// How many of ascending numbers are at most as large as a number.
function countUntil(numbers: number[], most: number): number {
  let low = 0;
  let high = numbers.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (numbers[middle]! <= most) low = middle + 1;
    else high = middle;
  }
  return low;
}
