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
