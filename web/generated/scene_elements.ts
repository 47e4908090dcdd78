// Written by build_web.py from analysis/documents/figures/scene/scene_elements.py.

// A solar panel: its centre ``at`` and its ``size`` along the body's axes (m).
export interface Panel {
  at: [number, number, number];
  size: [number, number, number];
}
