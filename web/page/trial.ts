// The trial that a reader has chosen, which all scripts of a page share by an event of the document: curves, scene.

const EVENT = "perilune-trial";
const CHOSEN = Symbol.for("perilune.trial");

export interface TrialName {
  variant: string;
  trial: number;
}

interface Detail extends TrialName {
  from: string;
}

const shared = globalThis as { [CHOSEN]?: Detail };

export function announceTrial({ variant, trial }: TrialName, from: string): void {
  const detail: Detail = { variant, trial, from };
  shared[CHOSEN] = detail;
  document.dispatchEvent(new CustomEvent<Detail>(EVENT, { detail }));
}

// Calls with the trials that others announce, and with the last one before.
export function followTrial(own: string, follow: (trial: TrialName) => void): void {
  const hear = (detail: Detail) => {
    if (detail.from !== own) follow(detail);
  };
  document.addEventListener(EVENT, (event) => hear((event as CustomEvent<Detail>).detail));
  if (shared[CHOSEN]) hear(shared[CHOSEN]);
}
