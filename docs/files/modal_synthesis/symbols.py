"""The satellite of orbit.py with symbolic parameters."""

import sympy

jx, jy, jz, w0, p1, p2, p3, q1, q2, q3 = sympy.symbols("jx jy jz w0 p1 p2 p3 q1 q2 q3", positive=True)
A = sympy.zeros(6, 6)
A[:3, 3:] = sympy.eye(3)
A[0, 1], A[1, 0] = -w0, w0
A[3, 0], A[3, 4] = 3 * w0**2 * (jy - jz) / jx, -w0 * (jy - jz) / jx
A[4, 3], A[5, 2] = -w0 * (jz - jx) / jy, 3 * w0**2 * (jy - jx) / jz
B = sympy.Matrix.vstack(sympy.zeros(3, 3), sympy.diag(1 / jx, 1 / jy, 1 / jz))
