// What a page has of a scene: analysis/reports/scene/view.py, its columns decoded.

import type { Vector3 } from "three";
import type { Page, Values } from "../page/document";
import { type Instant, positionAt } from "./instant";

export type Triple = [number, number, number];

interface Thrust<Column> {
  values: Column;
  largest: number;
  length: number;
  unit?: string;
  label: string;
  at: Triple;
  along: Triple;
}

interface Jet<Column> {
  values: Column;
  largest: number;
  pulse?: boolean;
  couple?: boolean;
  at: Triple;
  along: Triple;
}

export interface Panel {
  at: Triple;
  size: Triple;
}

interface Body<Column> {
  name: string;
  colour: string;
  shape: string;
  size: Triple;
  at: Triple;
  position: Column[];
  attitude: Column[]; // none where it is unknown
  thrusts?: Thrust<Column>[];
  jets?: Jet<Column>[];
  panels?: Panel[];
  flight?: { variant: string; trial: number; failed: boolean }; // where a scene is of several
}

interface Site<Column> {
  name: string;
  colour: string;
  position: Column[];
}

interface Line<Column> {
  name: string;
  start: string;
  end?: string;
  condition?: Column;
}

interface Arrow<Column> {
  name: string;
  colour: string;
  start: string;
  direction: Column[]; // unit vectors in the scene's frame
  length: number; // m, or of the view's height
  on_screen?: boolean;
}

interface Scene<Column> {
  title: string;
  axes: [string, string, string];
  up: "x" | "y" | "z";
  origin: Triple;
  time: Column;
  ground?: { name: string; radius?: number; centre?: Triple; normal?: Triple };
  bodies: Body<Column>[];
  sites?: Site<Column>[];
  lines?: Line<Column>[];
  arrows?: Arrow<Column>[];
  camera: { field: number; azimuth: number; elevation: number; diagonals: number }; // as it is at first; rad, of the body
}

export type SceneData = Scene<Values>;
export type BodyData = Body<Values>;
export type ThrustData = Thrust<Values>;
export type JetData = Jet<Values>;
export type SiteData = Site<Values>;
export type LineData = Line<Values>;
export type ArrowData = Arrow<Values>;

// The scene of a page; null where it has none.
export async function readScene(page: Page): Promise<SceneData | null> {
  const scene = page.document["scene"] as Scene<number> | undefined;
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
        attitude: await columns(body.attitude ?? []),
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
  const named = [...scene.bodies, ...(scene.sites ?? [])].find((each) => each.name === name);
  return named !== undefined && positionAt(named.position, instant, into);
}
