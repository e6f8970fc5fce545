"""Depth images in: types, strides, readings that are none, wrong shapes."""
import gc
import threading

import numpy as np
import pytest

import berth


def is_same(a, b):
    return np.array_equal(a.obstacle_depth_m, b.obstacle_depth_m, equal_nan=True) and np.array_equal(a.fate, b.fate)


def with_columns_apart(depth):
    wide = np.full((depth.shape[0], 2 * depth.shape[1]), 7, depth.dtype)
    wide[:, ::2] = depth
    return wide[:, ::2]


def with_rows_apart(depth):
    wide = np.full((depth.shape[0], depth.shape[1] + 5), 7, depth.dtype)
    wide[:, 5:] = depth
    return wide[:, 5:]


def upside_down(depth):
    return np.ascontiguousarray(depth[::-1])[::-1]


@pytest.mark.parametrize("make", [
    np.asfortranarray, with_columns_apart, with_rows_apart, upside_down,
    lambda d: d.astype(np.float64), lambda d: d.astype(">f4"), lambda d: np.nan_to_num(d, nan=0.0),
    lambda d: np.nan_to_num(d, nan=-1.0), lambda d: np.nan_to_num(d, nan=np.inf), lambda d: d.copy(),
])
def test_the_same_image_in_other_memory_gives_the_same_frame(observer, step, make):
    given = make(step.depth_m)
    before = given.copy()
    assert is_same(observer.observe(given, step.joints), observer.observe(step.depth_m, step.joints))
    assert np.array_equal(given, before, equal_nan=True), "the image is not written to"


@pytest.mark.parametrize("make, copies", [
    (lambda d: d, False), (upside_down, False), (with_rows_apart, False), (lambda d: d[::2], False),
    (with_columns_apart, True), (np.asfortranarray, True), (lambda d: d.astype(np.float64), True),
    (lambda d: np.nan_to_num(d), True), (lambda d: np.rint(np.nan_to_num(d)).astype(np.uint16), True),
])
def test_nothing_is_copied_that_can_be_looked_at(step, make, copies):
    assert berth.needs_copy(make(step.depth_m)) == copies


@pytest.mark.parametrize("dtype", ["<u2", ">u2"])
def test_whole_numbers_are_millimetres_unless_told(observer, step, dtype):
    expected = observer.observe(step.depth_m, step.joints)
    numbers = np.rint(np.nan_to_num(step.depth_m) * 1000).astype(dtype)
    assert is_same(observer.observe(numbers, step.joints), expected)
    assert is_same(observer.observe((numbers // 10 * 100).astype(dtype), step.joints, depth_scale=0.0001),
                   observer.observe((numbers // 10 * 10).astype(dtype), step.joints))


def test_floats_in_another_unit(observer, step):
    millimetres = observer.observe(step.depth_m * np.float32(1000), step.joints, depth_scale=0.001)
    np.testing.assert_allclose(millimetres.obstacle_depth_m, observer.observe(step.depth_m, step.joints).obstacle_depth_m,
                               rtol=1e-6)


@pytest.mark.parametrize("depth, error, said", [
    (np.zeros((480, 640, 1), np.float32), ValueError, "depth: 3 dimensions; expected 2"),
    (np.zeros(480, np.float32), ValueError, "depth: 1 dimensions; expected 2"),
    (np.zeros((640, 480), np.float32), ValueError, "480 x 640"),
    (np.zeros((0, 0), np.float32), ValueError, "0 x 0"),
    (np.zeros((480, 640), np.int32), TypeError, "int32; expected float32"),
    (np.zeros((480, 640), bool), TypeError, "bool; expected float32"),
    (np.zeros((480, 640), complex), TypeError, "complex128; expected float32"),
    ([[1.0]], TypeError, "no numpy array"),
    (None, TypeError, "no numpy array"),
])
def test_what_is_no_depth_image_is_named(observer, step, depth, error, said):
    with pytest.raises(error, match=said):
        observer.observe(depth, step.joints)


@pytest.mark.parametrize("scale", [0, -1, np.nan, np.inf])
def test_a_scale_that_is_none_is_named(observer, step, scale):
    with pytest.raises(ValueError, match="depth_scale"):
        observer.observe(step.depth_m, step.joints, depth_scale=scale)


def test_images_of_a_frame_are_views_that_outlive_it(one_camera, step):
    frame = berth.Observer(one_camera.views[0]).observe(step.depth_m, step.joints)
    depth_m, fate = frame.obstacle_depth_m, frame.fate
    expected = depth_m.copy(), fate.copy()
    assert frame.obstacle_depth_m.ctypes.data == depth_m.ctypes.data
    assert not depth_m.flags.writeable and not depth_m.flags.owndata
    with pytest.raises(ValueError):
        depth_m[0, 0] = 1
    del frame
    gc.collect()
    # Frames whose memory is used again must not be this one.
    observer = berth.Observer(one_camera.views[0])
    for _ in range(5):
        observer.observe(np.ones_like(step.depth_m), step.joints)
    assert np.array_equal(depth_m, expected[0], equal_nan=True) and np.array_equal(fate, expected[1])


def test_a_frame_stays_as_it_is_while_others_are_observed(observer, step):
    frame = observer.observe(step.depth_m, step.joints)
    before = frame.obstacle_depth_m.copy()
    for _ in range(3):
        observer.observe(np.full_like(step.depth_m, 0.5), step.joints)
    assert np.array_equal(frame.obstacle_depth_m, before, equal_nan=True)


def test_fates_are_counted(step):
    counts = step.frame.fate_count
    for name, count in counts.items():
        assert count == np.count_nonzero(step.frame.fate == int(getattr(berth.PixelFate, name)))
    assert counts["robot"] > 1000


def test_threads_observe_and_ask_side_by_side(one_camera, step):
    """Each thread sees the results of one alone; one query shared by all gives them too."""
    shared = berth.Query(one_camera.robot)
    expected = shared.ask(step.frame).distance_m.copy()
    wrong = []

    def work(own):
        observer = berth.Observer(one_camera.views[0])
        for _ in range(10):
            frame = observer.observe(step.depth_m, step.joints)
            for query in (shared, own):
                if not np.allclose(query.ask(frame).distance_m, expected, atol=2e-3, equal_nan=True):
                    wrong.append(threading.get_ident())

    threads = [threading.Thread(target=work, args=(berth.Query(one_camera.robot),)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_a_thread_that_observes_lets_others_run(observer, step):
    """The interpreter's lock is released: another thread counts on while images are observed."""
    count, stop = [0], threading.Event()

    def run():
        while not stop.is_set():
            count[0] += 1

    other = threading.Thread(target=run)
    other.start()
    for _ in range(20):
        observer.observe(step.depth_m, step.joints)
    stop.set()
    other.join()
    assert count[0] > 1000
