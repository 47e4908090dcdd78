"""Random network operators for tests, and their properties, computed from the matrix alone."""

import numpy as np
from hypothesis import strategies as st

SIZE, SOURCES = 16, 6
UNARY = (*range(1, 22), 23)


@st.composite
def matrices(draw, unary=UNARY, binary=(0, 1, 2, 3), most=40):
    """Draw upper triangular matrices in which every node that is no source and leads on has an edge in."""
    matrix = [[0] * SIZE for _ in range(SIZE)]
    for node in range(SOURCES, SIZE):
        matrix[node][node] = draw(st.sampled_from(binary))
    fed = set(range(SOURCES))
    for node in range(SOURCES, SIZE):
        starts = sorted(fed)
        chosen = draw(st.lists(st.sampled_from(starts), max_size=4, unique=True))
        if node >= SIZE - 2 and not chosen:
            chosen = [draw(st.sampled_from(starts))]
        for start in chosen:
            matrix[start][node] = draw(st.sampled_from(unary))
        if chosen:
            fed.add(node)
    return tuple(tuple(row) for row in matrix)


def random_matrix(random):
    """Draw a matrix of the same kind, from a numpy generator; one to three edges into every node."""
    matrix = np.zeros((SIZE, SIZE), dtype=int)
    for node in range(SOURCES, SIZE):
        matrix[node, node] = random.choice([0, 0, 0, 1, 1, 2, 3])
        starts = random.choice(node, random.integers(1, 4), replace=False)
        matrix[starts, node] = random.choice(UNARY, len(starts))
    return tuple(tuple(row) for row in matrix.tolist())


def depends(matrix):
    """Return depends[i, j], True if node j can be reached from node i: the transitive closure by matrix powers."""
    step = (np.triu(np.array(matrix), 1) != 0).astype(int)
    reach = step.copy()
    for _ in range(SIZE):
        reach = ((reach + reach @ step) > 0).astype(int)
    return reach > 0
