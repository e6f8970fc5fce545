"""Shows the bundled scene again and again, as a running robot would be shown; prints where."""
import os
import time

import berth

scene = berth.open_scene(os.environ["BERTH_SOURCE_DIR"] + "/data/bundled/one_camera.yaml")
page = berth.view(scene.robot, scene.views, port=0)
print(page.url, flush=True)
steps = [(step.result, step.frame) for step in scene]
try:
    page.show(steps[0][0], [])
except ValueError as error:
    assert "0 frames; expected 1, one for each camera" in str(error)
else:
    raise AssertionError("an answer without its frames was shown")
while True:
    for answer, frame in steps:
        page.show(answer, [frame])
        time.sleep(0.03)
