// Arrows from bodies and sites along directions of signals, with names at their ends.

import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Vector3 } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { make, nameOf } from "../../page/elements";
import type { Camera } from "../camera";
import { type ArrowData, pointOf, type SceneData } from "../document";
import { type Instant, positionAt } from "../instant";
import { lineColour, type Theme } from "../theme";
import type { Ground } from "./ground";

const SHAFT = 0.013; // radius over the arrow's length
const HEAD = { length: 0.16, radius: 0.05 }; // over the arrow's length
const GHOST = 0.3; // opacity where a body hides it
const Y = new Vector3(0, 1, 0);

export class Arrows {
  readonly group = new Group();
  readonly element = make("div", { class: "scene-marks", "aria-hidden": "true" }); // names
  private readonly arrows: { data: ArrowData; mesh: Mesh; materials: MeshBasicMaterial[]; name: HTMLElement }[];
  private readonly direction = new Vector3();

  constructor(
    private readonly scene: SceneData,
    private readonly ground: Ground | null,
  ) {
    this.arrows = (scene.arrows ?? []).map((data) => {
      const material = new MeshBasicMaterial();
      const ghost = new MeshBasicMaterial({ transparent: true, opacity: GHOST, depthTest: false, depthWrite: false });
      const mesh = new Mesh(arrow(), material);
      mesh.add(new Mesh(mesh.geometry, ghost));
      const name = make("div", { class: "scene-mark scene-arrow" }, nameOf(data.name));
      this.group.add(mesh);
      this.element.append(name);
      return { data, mesh, materials: [material, ghost], name };
    });
  }

  setTheme(theme: Theme): void {
    for (const { data, materials } of this.arrows) {
      for (const material of materials) material.color = lineColour(data.colour, theme);
    }
  }

  show(instant: Instant, { view }: Camera, width: number, height: number): void {
    for (const { data, mesh, name } of this.arrows) {
      const start = mesh.position;
      const known = pointOf(this.scene, data.start, instant, start) && positionAt(data.direction, instant, this.direction);
      const depth = -start.clone().applyMatrix4(view.matrixWorldInverse).z;
      mesh.visible = known && depth > 0 && this.direction.lengthSq() > 0 && !this.ground?.hides(view.position, start);
      name.style.display = "none";
      if (!mesh.visible) continue;
      const length = data.on_screen ? data.length * 2 * depth * Math.tan((view.fov * Math.PI) / 360) : data.length;
      mesh.quaternion.setFromUnitVectors(Y, this.direction.normalize());
      mesh.scale.setScalar(length);
      const tip = start.clone().addScaledVector(this.direction, length);
      if (tip.clone().applyMatrix4(view.matrixWorldInverse).z >= 0 || this.ground?.hides(view.position, tip)) continue;
      const { x, y } = tip.project(view);
      name.style.display = "";
      name.style.transform = `translate(${(((x + 1) / 2) * width).toFixed(1)}px, ${(((1 - y) / 2) * height).toFixed(1)}px)`;
    }
  }
}

// From the origin along y, of length 1.
function arrow() {
  const shaft = new CylinderGeometry(SHAFT, SHAFT, 1 - HEAD.length, 12).translate(0, (1 - HEAD.length) / 2, 0);
  const head = new ConeGeometry(HEAD.radius, HEAD.length, 20).translate(0, 1 - HEAD.length / 2, 0);
  return mergeGeometries([shaft, head]);
}
