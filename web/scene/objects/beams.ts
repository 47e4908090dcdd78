// Lines from a point to a point, or to the ground below.

import { BufferAttribute, BufferGeometry, Group, Line, LineDashedMaterial, Vector3 } from "three";
import { type LineData, pointOf, type SceneData } from "../document";
import type { Ground } from "./ground";
import type { Instant } from "../instant";
import { lineColour, type Theme } from "../theme";

const COLOUR = "#c92a2a";
const DASHES = 40; // in a line, whatever its length

export class Beams {
  readonly group = new Group();
  private readonly beams: { line: Line<BufferGeometry, LineDashedMaterial>; data: LineData }[];
  private readonly start = new Vector3();
  private readonly end = new Vector3();

  constructor(
    private readonly scene: SceneData,
    private readonly ground: Ground | null,
  ) {
    this.beams = (scene.lines ?? []).map((data) => {
      const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(6), 3));
      const line = new Line(geometry, new LineDashedMaterial());
      line.frustumCulled = false;
      this.group.add(line);
      return { line, data };
    });
  }

  setTheme(theme: Theme): void {
    for (const { line } of this.beams) line.material.color = lineColour(COLOUR, theme);
  }

  show(instant: Instant): void {
    for (const { line, data } of this.beams) {
      line.visible = !(data.condition?.[instant.row] === 0) && this.ends(data, instant);
      if (!line.visible) continue;
      line.position.copy(this.start);
      const way = this.end.sub(this.start);
      const points = line.geometry.getAttribute("position") as BufferAttribute;
      points.setXYZ(1, way.x, way.y, way.z).needsUpdate = true;
      line.computeLineDistances();
      line.material.dashSize = line.material.gapSize = way.length() / DASHES;
    }
  }

  private ends({ start, end }: LineData, instant: Instant): boolean {
    if (!pointOf(this.scene, start, instant, this.start)) return false;
    if (end !== undefined) return pointOf(this.scene, end, instant, this.end);
    if (this.ground) this.end.copy(this.ground.footOf(this.start).point);
    return this.ground !== null;
  }
}
