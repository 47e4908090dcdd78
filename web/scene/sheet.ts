// The style of a scene's elements.

export const SHEET = `
.scene { margin: 12px 0; }
.scene-view { position: relative; overflow: hidden; border: 1px solid color-mix(in srgb, currentColor 30%, transparent);
  height: clamp(300px, 62vw, min(640px, 78vh)); touch-action: pan-y; user-select: none; cursor: grab; color: var(--ink); }
.scene-view:focus-visible, .scene-controls :focus-visible { outline: 3px solid #1c6fd0; outline-offset: 1px; }
.scene-view:active { cursor: grabbing; }
.scene-view canvas { display: block; width: 100%; height: 100%; }
.scene-marks, .scene-mark { position: absolute; left: 0; top: 0; pointer-events: none; }
.scene-marks { right: 0; bottom: 0; overflow: hidden; font-size: 12px; }
.scene-mark svg { position: absolute; left: -12px; top: -12px; }
.scene-mark bdi { position: absolute; left: 0; bottom: var(--scene-gap); transform: translateX(-50%); white-space: nowrap; max-width: 40ch; overflow: hidden;
  text-overflow: ellipsis; }
.scene-arrow bdi { bottom: 4px; padding: 0 3px; border-radius: 3px; background: var(--scene-veil); }
.scene-site bdi { left: 14px; bottom: -8px; transform: none; }
.scene-values, .scene-scale, .scene-triad { position: absolute; pointer-events: none; font-size: 12px; margin: 0; }
.scene-values { left: 8px; top: 6px; font-variant-numeric: tabular-nums; max-width: calc(100% - 150px); }
.scene-values div { display: flex; gap: 8px; }
.scene-values dt { color: inherit; opacity: 0.8; overflow-wrap: anywhere; }
.scene-values dd { margin: 0; font-weight: 600; white-space: nowrap; }
.scene-triad { right: 36px; top: 0; }
.scene-triad svg { overflow: visible; }
.scene-triad text { font-size: 11px; }
.scene-scale { left: 8px; right: 8px; bottom: 6px; }
.scene-scale i { display: block; height: 5px; border: solid currentColor; border-width: 0 1.5px 1.5px; margin-bottom: 2px; }
.scene-controls { display: flex; flex-wrap: wrap; gap: 8px; margin: 8px 0; }
.scene-group { display: flex; flex-wrap: wrap; gap: 4px; }
.scene-time { flex: 1 1 100%; }
.scene-time input { flex: 1 1 140px; min-width: 0; height: 40px; margin: 0 4px; }
.scene-controls button, .scene-controls select { min-width: 40px; min-height: 40px; padding: 0 10px; font: inherit; font-size: 13px;
  color: var(--ink); background: var(--scene-button); border: 1px solid var(--scene-edge); border-radius: 4px; max-width: 100%; }
.scene-controls button[aria-pressed="true"] { background: var(--pressed); color: var(--on-pressed); }
.scene-time button:first-child { min-width: 68px; }
@media print { .scene { display: none; } }
`;
