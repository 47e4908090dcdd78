// The time of a scene: set by the slider, by the page's cursor, or running.

import { type Instant, instantAt, nearestRow } from "./instant";
import type { Values } from "../page/document";

const WATCHED = 40; // s: how long the whole run takes at the speed that is set first
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

export class Playback {
  instant: Instant;
  speed: number;
  readonly speeds: number[];
  private request = 0;
  private before = 0; // ms

  constructor(
    readonly times: Values,
    private readonly changed: () => void,
  ) {
    this.instant = instantAt(times, times[0]!);
    const wanted = (this.end - this.begin) / WATCHED;
    this.speed = SPEEDS.reduce((best, speed) =>
      Math.abs(Math.log(speed / wanted)) < Math.abs(Math.log(best / wanted)) ? speed : best,
    );
    this.speeds = SPEEDS.filter((speed) => speed >= 0.1 && (speed <= 1 || speed <= 10 * this.speed));
  }

  get begin(): number {
    return this.times[0]!;
  }

  get end(): number {
    return this.times[this.times.length - 1]!;
  }

  get playing(): boolean {
    return this.request !== 0;
  }

  get row(): number {
    return nearestRow(this.instant);
  }

  set row(row: number) {
    this.seek(this.times[Math.min(Math.max(row, 0), this.times.length - 1)]!);
  }

  seek(time: number): void {
    this.instant = instantAt(this.times, Math.min(Math.max(time, this.begin), this.end));
    this.changed();
  }

  toggle(): void {
    if (this.playing) return this.pause();
    if (this.instant.time >= this.end) this.seek(this.begin);
    this.before = performance.now();
    this.request = requestAnimationFrame(this.advance);
    this.changed();
  }

  pause(): void {
    cancelAnimationFrame(this.request);
    this.request = 0;
    this.changed();
  }

  private readonly advance = (now: number): void => {
    const elapsed = Math.min(Math.max(now - this.before, 0), 250) / 1000;
    this.before = now;
    this.request = requestAnimationFrame(this.advance);
    this.seek(this.instant.time + this.speed * elapsed);
    if (this.instant.time >= this.end) this.pause();
  };
}
