// Written by build_web.py from analysis/documents/scene/view.py.

import type { Panel } from "./declared";

// A force: its values in ``unit``, where it acts and along which direction (body), and its plume's ``length`` (m).
//
// The plume has this length at the ``largest`` magnitude.
export interface ThrustView<Column = number> {
  values: Column;
  largest: number;
  length: number;
  unit?: string;
  label: string;
  at: [number, number, number];
  along: [number, number, number];
}

// A jet: its force over the ``largest`` of its group, or the time (s) that its pulse still lasts, with its sign.
export interface JetView<Column = number> {
  values: Column;
  largest: number;
  pulse?: boolean;
  couple?: boolean;
  at: [number, number, number];
  along: [number, number, number];
}

// Trial and variant of a body, and whether that trial failed.
export interface FlightName {
  variant: string;
  trial: number;
  failed?: boolean;
}

// A body: three columns of position (m) and four of its attitude, a quaternion from body to scene, scalar first.
//
// ``attitude`` is empty where it is unknown, ``flight`` is given in a scene of several flights.
export interface BodyView<Column = number> {
  name: string;
  colour: string;
  shape: string;
  size: [number, number, number];
  at: [number, number, number];
  position: Column[];
  attitude: Column[];
  thrusts?: ThrustView<Column>[];
  jets?: JetView<Column>[];
  panels?: Panel[];
  flight?: FlightName;
}

// A named point: three columns (m).
export interface SiteView<Column = number> {
  name: string;
  colour: string;
  position: Column[];
}

// A line from a named point to another; to the ground below where ``end`` is missing.
export interface LineView<Column = number> {
  start: string;
  end?: string;
  condition?: Column;
}

// An arrow from a named point: three columns of its unit vector in the scene's frame, nan where that is unknown.
//
// Its ``length`` is in m, or ``on_screen`` a fraction of the view's height.
export interface ArrowView<Column = number> {
  name: string;
  colour: string;
  start: string;
  direction: Column[];
  length: number;
  on_screen?: boolean;
}

// The ground: z = 0, or of a sphere its ``radius`` and ``centre`` (m, in the scene's frame).
//
// The grid of a sphere is laid on the great circle with this ``normal``.
export interface GroundView {
  name: string;
  radius?: number;
  centre?: [number, number, number];
  normal?: [number, number, number];
}

// The camera as it is at first: its ``field`` upwards, its direction from a body (rad), its distance.
//
// The azimuth is counted from forward about up. The distance is ``diagonals`` diagonals of the body, or such that all
// bodies are in view, with this ``room`` around them.
export interface CameraStart {
  field: number;
  azimuth: number;
  elevation: number;
  diagonals: number;
  room: number;
}

// A scene of a flight with samples at ``time`` (s).
export interface SceneView<Column = number> {
  title: string;
  axes: [string, string, string];
  up: "x" | "y" | "z";
  origin: [number, number, number];
  time: Column;
  ground?: GroundView;
  bodies: BodyView<Column>[];
  sites?: SiteView<Column>[];
  lines?: LineView<Column>[];
  arrows?: ArrowView<Column>[];
  camera: CameraStart;
}
