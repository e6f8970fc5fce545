"""Calibration of a scene, and what it changes. Usage: calibrate.py scene.yaml new.yaml [residuals.png]"""
import sys

import berth
import numpy as np

found = berth.calibrate(sys.argv[1])
found.write(sys.argv[2])
for camera in found.cameras:
    print(f"{camera.camera}: moved by {1000 * camera.moved_m:.1f} mm, "
          f"residuals 90 % from {1000 * camera.before_m[1]:.1f} to {1000 * camera.after_m[1]:.1f} mm")
for name in sys.argv[1:3]:
    nearest = [step.result.nearest for step in berth.open_scene(name)]
    print(name, "least distance", np.min([link.distance_m for link in nearest if link]), "m")
if len(sys.argv) > 3:
    import berth.plot
    berth.plot.residuals(found).figure.savefig(sys.argv[3])
