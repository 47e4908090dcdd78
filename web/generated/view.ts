// Written by build_web.py from analysis/documents/scene/view.py.

import type { Panel } from "./scene_elements";

// A force: values in ``unit``, point and direction of action (body axes), and the plume's ``length`` (m).
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

// A jet: its force relative to the ``largest`` of its group, or the signed remaining time (s) of its pulse.
export interface JetView<Column = number> {
  values: Column;
  largest: number;
  pulse?: boolean;
  couple?: boolean;
  at: [number, number, number];
  along: [number, number, number];
}

// Trial and variant of a body, and whether the trial failed.
export interface FlightName {
  variant: string;
  trial: number;
  failed?: boolean;
}

// A body: three columns of position (m), and four of its attitude quaternion from body to scene, scalar first.
//
// ``attitude`` is empty if unknown; ``flight`` is stated in a scene of several simulations.
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

// A named point: three columns of position (m).
export interface SiteView<Column = number> {
  name: string;
  colour: string;
  position: Column[];
}

// A line from a named point to another, or without ``end`` to the ground below.
export interface LineView<Column = number> {
  start: string;
  end?: string;
  condition?: Column;
}

// An arrow from a named point: three columns of a unit vector in the scene's frame, NaN where unknown.
//
// ``length`` is in m, or if ``on_screen`` a fraction of the view's height.
export interface ArrowView<Column = number> {
  name: string;
  colour: string;
  start: string;
  direction: Column[];
  length: number;
  on_screen?: boolean;
}

// The ground: the plane z = 0, or a sphere by ``radius`` and ``centre`` (m, in the scene's frame).
//
// The grid of a sphere is aligned with the great circle of this ``normal``.
export interface GroundView {
  name: string;
  radius?: number;
  centre?: [number, number, number];
  normal?: [number, number, number];
}

// The initial camera: its vertical ``field``, its direction from a body (rad), its distance.
//
// The azimuth is an angle about the up axis from the forward direction. The distance is ``diagonals`` diagonals of the
// body, or more if needed to have all bodies in view, with ``room`` as a factor on their extent.
export interface CameraStart {
  field: number;
  azimuth: number;
  elevation: number;
  diagonals: number;
  room: number;
}

// A scene of a simulation with samples at ``time`` (s).
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
