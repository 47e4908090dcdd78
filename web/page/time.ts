// The time at the cursor, which all scripts of a page share by an event of the document: curves, scene, diagram.

const EVENT = "perilune-time";

interface Detail {
  time: number; // s
  from: string;
}

export function announceTime(time: number, from: string): void {
  document.dispatchEvent(new CustomEvent<Detail>(EVENT, { detail: { time, from } }));
}

// Calls with the times that others announce.
export function followTime(own: string, follow: (time: number) => void): void {
  document.addEventListener(EVENT, (event) => {
    const { time, from } = (event as CustomEvent<Detail>).detail;
    if (from !== own) follow(time);
  });
}
