// Written by build_web.py from analysis/page_types.py.

import type { Chart } from "./charts";
import type { Encoded } from "./columns";
import type { ShowDocument } from "./documents";
import type { RecordedDocument } from "./embedded_flights";
import type { TrialsDocument } from "./embedded_trials";
import type { SceneView } from "./view";

// The document inside a page: its columns, its figures, and data that the scripts of some pages read.
export interface PageDocument<Column = number> {
  columns: Encoded[];
  packed: [string, string];
  figures: Chart<Column>[][];
  trials?: TrialsDocument<Column>;
  recorded?: RecordedDocument<Column>;
  scene?: SceneView<Column>;
  show?: ShowDocument;
}
