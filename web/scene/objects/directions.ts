// The directions of the frame where there is no ground: circles every 30 degrees, infinitely far away.

import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, type PerspectiveCamera } from "three";
import type { SceneData } from "../document";
import type { Theme } from "../theme";

const APART = Math.PI / 6;
const STEP = Math.PI / 60;
const FAINT = 0.35;

export class Directions {
  readonly lines: LineSegments<BufferGeometry, LineBasicMaterial>;

  constructor(up: SceneData["up"]) {
    const points: number[] = [];
    const put = (azimuth: number, elevation: number) => {
      const level = Math.cos(elevation);
      const [a, b, c] = [level * Math.cos(azimuth), level * Math.sin(azimuth), Math.sin(elevation)];
      points.push(...(up === "z" ? [a, b, c] : up === "y" ? [b, c, a] : [c, a, b]));
    };
    for (let azimuth = 0; azimuth < 2 * Math.PI - STEP / 2; azimuth += APART) {
      for (let angle = -Math.PI / 2; angle < Math.PI / 2 - STEP / 2; angle += STEP) {
        put(azimuth, angle);
        put(azimuth, angle + STEP);
      }
    }
    for (let elevation = -2 * APART; elevation < 2.5 * APART; elevation += APART) {
      for (let angle = 0; angle < 2 * Math.PI - STEP / 2; angle += STEP) {
        put(angle, elevation);
        put(angle + STEP, elevation);
      }
    }
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
    const material = new LineBasicMaterial({ transparent: true, opacity: FAINT, depthTest: false, depthWrite: false });
    this.lines = new LineSegments(geometry, material);
    this.lines.frustumCulled = false;
    this.lines.renderOrder = -1;
  }

  setTheme(theme: Theme): void {
    this.lines.material.color.set(theme.grid);
  }

  show(camera: PerspectiveCamera): void {
    this.lines.position.copy(camera.position);
    this.lines.scale.setScalar(0.5 * camera.far);
  }
}
