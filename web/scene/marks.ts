// Marks of constant size over the view: bodies too small to be seen, sites, and their names.

import { Vector3 } from "three";
import type { Camera } from "./camera";
import type { BodyData, SiteData } from "./document";
import { make, makeSvg, nameOf } from "../page/elements";
import type { Ground } from "./objects/ground";
import { type Instant, positionAt } from "./instant";
import { strokeOf } from "./theme";

const SMALL = 28; // px: bodies below get a mark
const LARGE = 150; // px: bodies above need no name
const GAP = 10; // px, between a body and its name above it

export class Marks {
  readonly element = make("div", { class: "scene-marks", "aria-hidden": "true" });
  private readonly entries: { position: BodyData["position"]; extent: number; stands: boolean; element: HTMLElement; ring: SVGElement; name: HTMLElement }[];

  constructor(bodies: BodyData[], sites: SiteData[]) {
    this.entries = [
      ...bodies.map((body) => this.add(body, Math.max(...body.size), body.shape === "lander")),
      ...sites.map((site) => this.add(site, 0, false)),
    ];
  }

  private add({ name, colour, position }: BodyData | SiteData, extent: number, stands: boolean) {
    const ring = makeSvg("svg", { viewBox: "-12 -12 24 24", width: 24, height: 24 });
    ring.append(makeSvg("circle", { r: 7, fill: "none", style: strokeOf(colour), "stroke-width": 2 }));
    if (extent === 0) ring.append(makeSvg("path", { d: "M-11 0H11M0-11V11", style: strokeOf(colour), "stroke-width": 1.5 }));
    const label = nameOf(name);
    const element = make("div", { class: `scene-mark${extent === 0 ? " scene-site" : ""}` }, ring, label);
    this.element.append(element);
    return { position, extent, stands, element, ring, name: label };
  }

  show(instant: Instant, camera: Camera, ground: Ground | null, width: number, height: number): void {
    const point = new Vector3();
    const eye = camera.view.position;
    for (const { position, extent, stands, element, ring, name } of this.entries) {
      const known = positionAt(position, instant, point);
      const distance = eye.distanceTo(point);
      const inside = known && point.clone().applyMatrix4(camera.view.matrixWorldInverse).z < 0;
      const hidden = !inside || ground?.hides(eye, point);
      const { x, y } = point.project(camera.view);
      const seen = !hidden && Math.abs(x) < 1.1 && Math.abs(y) < 1.1;
      element.style.display = seen ? "" : "none";
      if (!seen) continue;
      const pixels = (extent / distance) * (height / (2 * Math.tan((camera.view.fov * Math.PI) / 360)));
      ring.style.visibility = pixels < SMALL ? "" : "hidden";
      name.style.visibility = pixels < LARGE ? "" : "hidden";
      const right = ((x + 1) / 2) * width;
      const down = ((1 - y) / 2) * height;
      element.style.transform = `translate(${right.toFixed(1)}px, ${down.toFixed(1)}px)`;
      element.style.setProperty("--scene-gap", `${(stands ? 0.85 : 0.5) * pixels + GAP}px`);
    }
  }
}
