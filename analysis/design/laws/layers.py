"""Layered drawing of a directed acyclic graph: left to right, with few crossings, long edges routed around nodes.

Sugiyama, Tagawa and Toda 1981: layers by longest path, long edges divided by joints that are placed like nodes, order
within a layer by barycentres, then heights by isotonic regression towards the neighbours.
"""

from __future__ import annotations

import itertools
from collections.abc import Hashable, Mapping, Sequence

import numpy as np
from scipy.optimize import isotonic_regression

SWEEPS = 24
NODE_GAP, JOINT_GAP = 1.0, 0.55  # least distance between two nodes, or of a joint from its neighbour

Edge = tuple[int, int]
Place = Hashable  # a node's number, or an edge and a layer for a joint
Layers = list[list[Place]]


class GraphLayout:
    """Positions for drawing: ``nodes`` (x, y) by number; ``paths`` by edge, the points from one node to the other."""

    def __init__(self, nodes: Sequence[int], edges: Sequence[Edge]) -> None:
        """Arrange ``nodes``, which are in topological order."""
        layer = longest_paths(nodes, edges)
        self.layers: Layers = [[] for _ in range(max(layer.values()) + 1)]
        for node in nodes:
            self.layers[layer[node]].append(node)
        self.chains: dict[Edge, list[Place]] = {}
        for edge in edges:
            joints: list[Place] = [(edge, place) for place in range(layer[edge[0]] + 1, layer[edge[1]])]
            for place, joint in enumerate(joints, layer[edge[0]] + 1):
                self.layers[place].append(joint)
            self.chains[edge] = [edge[0], *joints, edge[1]]
        self._neighbours()
        self._order()
        heights = self._heights()
        columns = {place: x for x, places in enumerate(self.layers) for place in places}
        self.nodes = {node: (float(columns[node]), heights[node]) for node in nodes}
        self.paths = {
            edge: [(float(columns[place]), heights[place]) for place in chain] for edge, chain in self.chains.items()
        }

    def _neighbours(self) -> None:
        self.before: dict[Place, list[Place]] = {place: [] for places in self.layers for place in places}
        self.after: dict[Place, list[Place]] = {place: [] for places in self.layers for place in places}
        for chain in self.chains.values():
            for left, right in itertools.pairwise(chain):
                self.after[left].append(right)
                self.before[right].append(left)

    def _order(self) -> None:
        """Sweep back and forth, sorting each layer by the mean position of its neighbours; keep the best order."""
        best = [list(places) for places in self.layers]
        fewest = self.crossings()
        for sweep in range(SWEEPS):
            forward = sweep % 2 == 0
            pairs = list(itertools.pairwise(self.layers))
            for left, right in pairs if forward else reversed(pairs):
                fixed, free = (left, right) if forward else (right, left)
                position = {place: index for index, place in enumerate(fixed)}
                near = self.before if forward else self.after
                own = {place: float(index) for index, place in enumerate(free)}
                means = {
                    place: float(np.mean([position[other] for other in near[place]])) if near[place] else own[place]
                    for place in free
                }
                free.sort(key=lambda place: means[place])
            crossings = self.crossings()
            if crossings < fewest:
                fewest, best = crossings, [list(places) for places in self.layers]
        self.layers = best

    def crossings(self) -> int:
        """Count the pairs of edges that cross between neighbouring layers."""
        total = 0
        for left, right in itertools.pairwise(self.layers):
            position = {place: index for index, place in enumerate(right)}
            ends = [(index, position[other]) for index, place in enumerate(left) for other in self.after[place]]
            total += sum((a[0] - b[0]) * (a[1] - b[1]) < 0 for a, b in itertools.combinations(ends, 2))
        return total

    def _heights(self) -> dict[Place, float]:
        """Return heights that are close to the mean of the neighbours and preserve the order and gaps of each layer."""
        offsets = [self._offsets(places) for places in self.layers]
        heights = {
            place: float(offset - row[-1] / 2.0)
            for places, row in zip(self.layers, offsets, strict=True)
            for place, offset in zip(places, row, strict=True)
        }
        for _ in range(SWEEPS):
            for places, row in zip(self.layers, offsets, strict=True):
                near = [[heights[other] for other in self.before[place] + self.after[place]] for place in places]
                desired = np.array([np.mean(values) if values else 0.0 for values in near])
                regression = isotonic_regression(desired - row).x + row
                heights.update(zip(places, regression.tolist(), strict=True))
        return heights

    def _offsets(self, places: Sequence[Place]) -> np.ndarray:
        """Return the least height of each place above the first place of its layer."""
        joint = [isinstance(place, tuple) for place in places]
        gaps = [JOINT_GAP if a or b else NODE_GAP for a, b in itertools.pairwise(joint)]
        return np.cumsum([0.0, *gaps])


def longest_paths(nodes: Sequence[int], edges: Sequence[Edge]) -> Mapping[int, int]:
    """Return the number of edges on the longest path to each node; ``nodes`` are in topological order."""
    length = dict.fromkeys(nodes, 0)
    for node in nodes:
        for start, end in edges:
            if start == node:
                length[end] = max(length[end], length[node] + 1)
    return length
