// ELK's layered layout for V8 without a browser, as analysis/documents/diagram/elk.py calls it.

import "./layout/worker_scope";
import "elkjs/lib/elk-worker.min.js";

interface Answer {
  data?: unknown;
  error?: unknown;
}

const scope = globalThis as unknown as {
  onmessage(event: { data: object }): void;
  postMessage(answer: Answer): void;
  layOut(graph: string): string;
};

// ELK answers before its handler returns: no event loop is needed.
function request(message: object): unknown {
  let answer: Answer = {};
  scope.postMessage = (posted) => {
    answer = posted;
  };
  scope.onmessage({ data: { id: 0, ...message } });
  if (answer.error !== undefined) throw answer.error;
  return answer.data;
}

request({ cmd: "register", algorithms: ["layered"] });

// A graph with positions, of a graph without: both JSON as elkjs documents it.
scope.layOut = (graph) => JSON.stringify(request({ cmd: "layout", graph: JSON.parse(graph) }));
