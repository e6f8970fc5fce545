"""render, self_filter and evaluate: the parts of a frame one by one."""
import numpy as np
import pytest

import berth


def test_the_parts_make_the_frame(one_camera, step):
    view, model = one_camera.views[0], one_camera.robot.model
    depth_m, link_id = berth.render(model, step.joints, view.camera, step.frame.X_BC)
    np.testing.assert_array_equal(depth_m, step.frame.robot_depth_m)
    np.testing.assert_array_equal(link_id, step.frame.link_id)
    left_m, fate = berth.self_filter(step.depth_m, depth_m, link_id, view.camera, view.self_filter)
    # What a frame for all links leaves out besides: sensor.phantom_radius_m.
    is_phantom = step.frame.fate == int(berth.PixelFate.speckle)
    assert is_phantom.mean() < 0.01
    left_m[is_phantom], fate[is_phantom] = np.nan, int(berth.PixelFate.speckle)
    np.testing.assert_array_equal(left_m, step.frame.obstacle_depth_m)
    np.testing.assert_array_equal(fate, step.frame.fate)
    np.testing.assert_allclose(model.link_poses(step.joints)["table"], np.eye(4))


def test_methods_on_images_agree(one_camera, step):
    camera, frame = one_camera.views[0].camera, step.frame
    found = {
        method: berth.evaluate(frame.robot_depth_m, frame.link_id, frame.obstacle_depth_m, camera, 8, method, range_m=0.4)
        for method in ("exact", "brute_force", "lattice")
    }
    for exact, brute, lattice in zip(*found.values()):
        assert not lattice["distance_m"] < exact["distance_m"] - 1e-6
        assert exact["status"] == brute["status"]
        assert exact["distance_m"] == pytest.approx(brute["distance_m"], nan_ok=True)
    assert any(np.isfinite(link["distance_m"]) for link in found["exact"])


INFO = """image_width: 160
image_height: 120
camera_matrix: {data: [120, 0, 80, 0, 120, 60, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: {data: [-0.3, 0.1, 0, 0, 0]}
"""


def test_a_lens_is_rectified_and_rays_become_depths(tmp_path):
    info = tmp_path / "info.yaml"
    info.write_text(INFO)
    made = berth.Rectification(info)
    depth_m = np.full((120, 160), 3, np.float32)
    depth_m[60, 150] = 1
    rectified_m = made.apply(depth_m)
    assert rectified_m.shape == (made.camera.height_px, made.camera.width_px) > (120, 170)
    # 70 pixels to the right: 0.583 = x (1 - 0.3 x^2 + 0.1 x^4).
    u, v = round(made.camera.cx_px + 0.6556 * made.camera.fx_px), round(made.camera.cy_px)
    assert rectified_m[v, u] == 1
    np.testing.assert_array_equal(made.apply((1000 * depth_m).astype(np.uint16)), rectified_m)
    along_ray = berth.Rectification(info, rectified=True, along_ray=True)
    assert along_ray.camera.width_px == 160
    np.testing.assert_allclose(along_ray.apply(depth_m)[60, 140], 3 / np.hypot(1, 0.5), rtol=1e-6)
    with pytest.raises(ValueError, match="depth: 9 x 120 pixels; expected the camera.s 160 x 120"):
        made.apply(depth_m[:, :9])
    with pytest.raises(ValueError, match="rectified: true"):
        berth.read_camera_info(info)


def test_images_that_do_not_go_together_are_named(one_camera, step):
    camera, frame = one_camera.views[0].camera, step.frame
    with pytest.raises(ValueError, match="link_id: 640 x 240 pixels"):
        berth.evaluate(frame.robot_depth_m, frame.link_id[::2], frame.obstacle_depth_m, camera, 8)
    with pytest.raises(ValueError, match="expected 0 exactly where there is no depth"):
        berth.evaluate(frame.robot_depth_m, np.ones_like(frame.link_id), frame.obstacle_depth_m, camera, 8)
    with pytest.raises(ValueError, match="link_count, which is 3"):
        berth.evaluate(frame.robot_depth_m, frame.link_id, frame.obstacle_depth_m, camera, 3)
    for method in ("mesh", "fast"):
        with pytest.raises(ValueError, match=f'method: "{method}"; expected one of exact, brute_force, lattice'):
            berth.evaluate(frame.robot_depth_m, frame.link_id, frame.obstacle_depth_m, camera, 8, method)
    with pytest.raises(ValueError, match="range_m: -1"):
        berth.evaluate(frame.robot_depth_m, frame.link_id, frame.obstacle_depth_m, camera, 8, range_m=-1)


def test_a_background_is_learned_where_it_is_asked_for(one_camera, step):
    view = one_camera.views[0]
    learning = berth.MountedCamera(one_camera.robot, view.camera, view.parent_link, view.X_PC, sensor=berth.SensorSettings(background_frames=2))
    observer = berth.Observer(learning)
    for _ in range(3):
        frame = observer.observe(step.depth_m, step.joints)
        observer.learn_background(step.depth_m, frame)
    assert frame.fate_count["background"] == 0  # nothing was hidden yet that was seen before
    with pytest.raises(ValueError, match="background_frames"):
        berth.Observer(view).learn_background(step.depth_m, frame)
