"""Which velocity keeps the robot apart from all that is near? By a QP of your own, and by berth's filter. Usage: avoid.py scene.yaml"""
import sys

import berth
import numpy as np

scene = berth.open_scene(sys.argv[1])
steps, robot = list(scene), scene.robot
position, wanted = steps[-1].joints, 10 * (steps[0].joints - steps[-1].joints)  # rad, rad/s: back to the beginning
newest = list({step.frame.camera: step.frame for step in steps}.values())
result = berth.Query(robot).ask(newest, position)
# Rows: gradient @ v >= -2 / s * (lower bound - 5 cm), for what cameras see and for what the model knows.
rows = berth.DistanceRows(robot)
rows.update(result)
gradient = np.vstack([rows.gradient(berth.RowKind.nearest), rows.gradient(berth.RowKind.known)])
bound = -2 * np.maximum(0, np.hstack([result.lower_bound_m, result.known_lower_bound_m]) - 0.05)
has_pair = ~np.isnan(gradient).any(axis=1) & np.tile(result.link_is_moved, 2)
gradient, bound = gradient[has_pair], bound[has_pair]
# min |v - wanted|^2 by Gauss-Seidel on the rows' multipliers (Hildreth 1957).
v, multiplier = wanted.copy(), np.zeros(len(bound))
for _ in range(1000):
    for i, row in enumerate(gradient):
        change = max(-multiplier[i], (bound[i] - row @ v) / max(row @ row, 1e-9))
        multiplier[i] += change
        v += change * row
filtered = berth.VelocityFilter(robot).update(result, position, np.zeros(len(v)), wanted)
print("wanted", wanted.round(3), "own QP", v.round(3), filtered.status.name, filtered.velocity.round(3), filtered.held_by)
