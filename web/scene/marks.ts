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
const FEW = 6; // bodies: of more, only the followed one is named
const GAP = 10; // px, between a body and its name above it

const RING = "M-7 0A7 7 0 0 1 7 0A7 7 0 0 1-7 0";
const CROSS = "M-6-6L6 6M-6 6L6-6"; // of a failure
const TARGET = "M-11 0H11M0-11V11"; // of a site

export class Marks {
  private readonly namesAll: boolean;
  readonly element = make("div", { class: "scene-marks", "aria-hidden": "true" });
  private readonly entries: {
    data: SiteData;
    extent: number; // m; 0 for what is a mark at any distance
    stands: boolean;
    element: HTMLElement;
    ring: SVGElement;
    name: HTMLElement;
  }[];

  constructor(bodies: BodyData[], sites: SiteData[]) {
    this.entries = [
      ...bodies.map((body) => {
        const extent = body.attitude.length ? Math.max(...body.size) : 0;
        return this.add(body, extent, body.shape === "lander", body.flight?.failed ? CROSS : RING);
      }),
      ...sites.map((site) => this.add(site, 0, false, RING, TARGET)),
    ];
    this.namesAll = bodies.length <= FEW;
  }

  private add(data: SiteData, extent: number, stands: boolean, ...lines: string[]) {
    const ring = makeSvg("svg", { viewBox: "-12 -12 24 24", width: 24, height: 24 });
    const stroke = lines.includes(CROSS) ? "stroke: currentColor" : strokeOf(data.colour);
    ring.append(makeSvg("path", { d: lines.join(""), fill: "none", style: stroke, "stroke-width": 2 }));
    const label = nameOf(data.name);
    const element = make("div", { class: `scene-mark${lines.includes(TARGET) ? " scene-site" : ""}` }, ring, label);
    this.element.append(element);
    return { data, extent, stands, element, ring, name: label };
  }

  show(instant: Instant, followed: BodyData, camera: Camera, ground: Ground | null, width: number, height: number): void {
    const point = new Vector3();
    const eye = camera.view.position;
    for (const { data, extent, stands, element, ring, name } of this.entries) {
      const known = positionAt(data.position, instant, point);
      const distance = eye.distanceTo(point);
      const inside = known && point.clone().applyMatrix4(camera.view.matrixWorldInverse).z < 0;
      const hidden = !inside || ground?.hides(eye, point);
      const { x, y } = point.project(camera.view);
      const seen = !hidden && Math.abs(x) < 1.1 && Math.abs(y) < 1.1;
      element.style.display = seen ? "" : "none";
      if (!seen) continue;
      const pixels = (extent / distance) * (height / (2 * Math.tan((camera.view.fov * Math.PI) / 360)));
      ring.style.visibility = pixels < SMALL ? "" : "hidden";
      const isNamed = this.namesAll || !("size" in data) || data === followed;
      name.style.visibility = isNamed && pixels < LARGE ? "" : "hidden";
      const right = ((x + 1) / 2) * width;
      const down = ((1 - y) / 2) * height;
      element.style.transform = `translate(${right.toFixed(1)}px, ${down.toFixed(1)}px)`;
      element.style.setProperty("--scene-gap", `${(stands ? 0.85 : 0.5) * pixels + GAP}px`);
    }
  }
}
