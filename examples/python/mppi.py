"""Reaches a goal around what the cameras see, by sampling: MPPI (Williams and others 2017). Usage: mppi.py scene.yaml"""
import sys
import time

import berth
import numpy as np
import numpy.typing

SAMPLES, STEPS, STEP_S, SPEED = 256, 20, 0.05, 1.0  # rollouts, their steps, rad/s
scene = berth.open_scene(sys.argv[1])
steps, model = list(scene), scene.robot.model
newest = list({step.frame.camera: step.frame for step in steps}.values())
check = berth.ConfigurationCheck(scene.robot)
check.prepare(newest)
random = np.random.default_rng(2)


def is_free(rows: np.typing.NDArray[np.float64]) -> np.typing.NDArray[np.bool_]:
    """3 cm from all that is seen or hidden, 5 mm from the table and the robot itself."""
    free: np.typing.NDArray[np.bool_] = check.ask(rows, margin_m=0.03, known_margin_m=0.005) == int(berth.Verdict.free)
    return free


position = steps[-1].joints
drawn = position + random.uniform(-1.5, 1.5, (1000, len(position)))
ways = check.ask_motions(np.tile(position, (1000, 1)), drawn, margin_m=0.03, known_margin_m=0.005)
goal = drawn[is_free(drawn) & (ways != int(berth.Verdict.free))][0]  # the straight way there is not free
plan, begin, asked, went = np.zeros((STEPS, len(position))), time.monotonic(), 0, [position]
for _ in range(400):
    velocity = np.clip(plan + random.normal(0, 0.5, (SAMPLES, STEPS, len(position))), -SPEED, SPEED)
    rollouts = position + np.cumsum(velocity * STEP_S, axis=1)
    free = is_free(rollouts.reshape(-1, len(position))).reshape(SAMPLES, STEPS)
    asked += free.size
    cost = np.linalg.norm(rollouts - goal, axis=2).sum(1) + 1000 * (~np.logical_and.accumulate(free, axis=1)).sum(1)
    weight = np.exp(-(cost - cost.min()) / 0.5)
    plan = np.tensordot(weight / weight.sum(), velocity, 1)
    if is_free(position[None] + plan[0] * STEP_S)[0]:
        position = position + plan[0] * STEP_S
        went.append(position)
    plan = np.vstack([plan[1:], np.zeros((1, len(position)))])
    if np.linalg.norm(position - goal) < 0.1:
        break
result = berth.Query(scene.robot).ask(newest, ahead=np.array(went))
moved = np.array(model.link_is_moved)
print(f"{np.linalg.norm(position - goal):.2f} rad from the goal after {len(went) - 1} steps, {asked} configurations and "
      f"{time.monotonic() - begin:.1f} s; nothing was nearer than {np.nanmin(result.ahead.lower_bound_m[:, moved]):.3f} m")
