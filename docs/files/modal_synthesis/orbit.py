"""Roll, yaw and pitch of a satellite in the orbital frame, and their rates; torques as inputs; yaw is not measured."""

import numpy as np

jx, jy, jz, w0 = 6500.0, 30000.0, 29000.0, 0.0011  # kg m^2, rad/s
A = np.zeros((6, 6))
A[:3, 3:] = np.eye(3)
A[0, 1], A[1, 0] = -w0, w0
A[3, [0, 4]] = np.array([3.0 * w0**2, -w0]) * (jy - jz) / jx
A[4, 3] = -w0 * (jz - jx) / jy
A[5, 2] = 3.0 * w0**2 * (jy - jx) / jz
B = np.vstack([np.zeros((3, 3)), np.diag([1.0 / jx, 1.0 / jy, 1.0 / jz])])
C = np.eye(6)[[0, 2, 3, 4, 5]]
