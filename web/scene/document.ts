// The scene of a page, its columns decoded.

import type { Vector3 } from "three";
import type { ArrowView, BodyView, JetView, LineView, SceneView, SiteView, ThrustView } from "../generated/view";
import type { Page, Values } from "../page/document";
import { type Instant, positionAt } from "./instant";

export type SceneData = SceneView<Values>;
export type BodyData = BodyView<Values>;
export type ThrustData = ThrustView<Values>;
export type JetData = JetView<Values>;
export type SiteData = SiteView<Values>;
export type LineData = LineView<Values>;
export type ArrowData = ArrowView<Values>;
export type Triple = SceneData["origin"];

// The scene of a page; null where it has none.
export async function readScene(page: Page): Promise<SceneData | null> {
  const scene = page.document.scene;
  if (!scene) return null;
  const column = (number: number) => page.column(number);
  const columns = (numbers: number[]) => Promise.all(numbers.map(column));
  return {
    ...scene,
    time: await column(scene.time),
    bodies: await Promise.all(
      scene.bodies.map(async (body) => ({
        ...body,
        position: await columns(body.position),
        attitude: await columns(body.attitude),
        thrusts: await Promise.all(
          (body.thrusts ?? []).map(async (thrust) => ({ ...thrust, values: await column(thrust.values) })),
        ),
        jets: await Promise.all((body.jets ?? []).map(async (jet) => ({ ...jet, values: await column(jet.values) }))),
      })),
    ),
    sites: await Promise.all(
      (scene.sites ?? []).map(async (site) => ({ ...site, position: await columns(site.position) })),
    ),
    lines: await Promise.all(
      (scene.lines ?? []).map(async ({ condition, ...line }) =>
        condition === undefined ? line : { ...line, condition: await column(condition) },
      ),
    ),
    arrows: await Promise.all(
      (scene.arrows ?? []).map(async (arrow) => ({ ...arrow, direction: await columns(arrow.direction) })),
    ),
  };
}

// Whether a body or a site is known by this name at this time, and where it is.
export function pointOf(scene: SceneData, name: string, instant: Instant, into: Vector3): boolean {
  const points: SiteData[] = [...scene.bodies, ...(scene.sites ?? [])];
  const named = points.find((each) => each.name === name);
  return named !== undefined && positionAt(named.position, instant, into);
}
