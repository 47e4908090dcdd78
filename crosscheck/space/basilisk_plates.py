"""Plates in Basilisk under drag and solar pressure. Runs in Basilisk's environment."""

from collections.abc import Iterable

import numpy as np
from Basilisk.simulation import facetDragDynamicEffector, facetSRPDynamicEffector

from crosscheck.basilisk_side import column


def drag_plates(plates: Iterable[Iterable[float]]) -> object:
    """Return the effector of drag on plates: area, normal, centre, drag coefficient, two reflectivities, body."""
    effector = facetDragDynamicEffector.FacetDragDynamicEffector()
    for area, nx, ny, nz, x, y, z, coefficient, *_ in plates:
        effector.addFacet(area, coefficient, column((nx, ny, nz)), column((x, y, z)))
    return effector


def sunlit_plates(plates: Iterable[Iterable[float]]) -> object:
    """Return the effector of solar pressure on the same plates."""
    effector = facetSRPDynamicEffector.FacetSRPDynamicEffector()
    rows = list(plates)
    effector.setNumFacets(len(rows))
    effector.setNumArticulatedFacets(0)
    for area, nx, ny, nz, x, y, z, _, specular, diffuse in rows:
        still = column((0.0, 0.0, 0.0))
        effector.addFacet(area, np.eye(3).tolist(), column((nx, ny, nz)), still, column((x, y, z)), diffuse, specular)
    return effector
