"""What is sent on is the same way, at the scale that is wanted, and its end is a stop."""
import importlib.machinery
import importlib.util
import pathlib
import time

import numpy as np
import pytest
import rclpy
from action_msgs.msg import GoalStatus
from berth_msgs.msg import LinkSeparation, Separation
from control_msgs.action import FollowJointTrajectory
from control_msgs.msg import JointTrajectoryControllerState
from rclpy.action import ActionClient
from living_robot import spin_beside
from rclpy.executors import MultiThreadedExecutor
from rclpy.time import Time
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

FILE = pathlib.Path(__file__).parent.parent / "examples" / "retime_trajectory"
LOADER = importlib.machinery.SourceFileLoader("retime_trajectory", str(FILE))
retime_trajectory = importlib.util.module_from_spec(importlib.util.spec_from_loader("retime_trajectory", LOADER))
LOADER.exec_module(retime_trajectory)

LEAD_S, FALLS, RISES = 0.1, 4.0, 2.0


def way():
    t = np.linspace(0, 4, 17)
    return retime_trajectory.Way(t, np.column_stack([1 - np.cos(np.pi * t / 4), np.zeros(17)]),
                                 np.column_stack([np.pi / 4 * np.sin(np.pi * t / 4), np.zeros(17)]))


def driven(wanted_at, is_late=lambda now_s: False):
    """All that is sent while the scale that is wanted changes, and when it was over."""
    progress, sent, piece, now_s = retime_trajectory.Progress(4.0, 100.0), {}, [], 100.0
    while not progress.is_over(now_s) and now_s < 130:
        now_s += 0.02
        if is_late(now_s):
            continue
        begun = [knot for knot in piece if knot[0] <= now_s]
        progress.go_on(now_s, now_s + LEAD_S, wanted_at(now_s), FALLS, RISES)
        piece = progress.piece(now_s - 0.02, FALLS)
        assert piece[0][0] <= now_s, "the controller finds where it is"
        assert piece[-1][2] == 0, "it ends in a stop"
        for knot in progress.knots:
            assert sent.setdefault(round(knot[0], 6), knot) == knot, "what was sent holds"
        # What the robot did until now is what the piece before said.
        assert all(knot in piece or knot[0] < piece[0][0] for knot in begun)
    return np.array(list(sent.values())), now_s


def test_it_goes_all_the_way():
    knots, over_s = driven(lambda now_s: 1.0)
    assert knots[-1, 1] >= 4.0
    assert over_s == pytest.approx(100 + 4.0 + 0.25, abs=0.15), "it takes half a second to full speed"


def test_it_stands_as_long_as_it_has_to_and_goes_on_where_it_stopped():
    knots, over_s = driven(lambda now_s: 0.0 if 101 < now_s < 103 else 1.0)
    standing = knots[(knots[:, 0] > 101 + LEAD_S + 1 / FALLS + 0.03) & (knots[:, 0] < 103)]
    assert (standing[:, 2] == 0).all()
    assert np.ptp(standing[:, 1]) == 0
    assert over_s > 106
    assert knots[-1, 1] >= 4.0


def test_the_scale_changes_no_faster_than_it_may():
    knots, _ = driven(lambda now_s: float(int(3 * now_s) % 2))
    steps = np.diff(knots[:, 2]) / np.diff(knots[:, 0])
    assert steps.min() >= -FALLS - 1e-6
    assert steps.max() <= RISES + 1e-6


def test_who_comes_late_goes_on_from_the_stop_that_was_sent():
    knots, over_s = driven(lambda now_s: 1.0, is_late=lambda now_s: 101 < now_s < 101.2 or 102 < now_s < 103.0)
    assert knots[-1, 1] >= 4.0
    assert over_s > 105
    assert (np.diff(knots[:, 2]) / np.diff(knots[:, 0])).min() >= -FALLS - 1e-6


def test_it_may_stop_at_once():
    progress = retime_trajectory.Progress(4.0, 100.0)
    progress.go_on(100.0, 100.2, 1.0, np.inf, np.inf)
    assert [knot[2] for knot in progress.knots[-2:]] == [1.0, 1.0]
    assert [knot[2] for knot in progress.piece(100.0, np.inf)[-2:]] == [1.0, 0.0]


def test_positions_and_velocities_fit_together():
    made, step = way(), 1e-4
    for s in np.linspace(0, 3.99, 50):
        position, velocity = made.at(s)
        assert velocity == pytest.approx((made.at(s + step)[0] - position) / step, abs=1e-3)
    assert made.at(2.0)[0][0] == pytest.approx(1.0)
    assert made.at(5.0)[0] == pytest.approx(made.q[-1]), "after its end it stands there"


@pytest.mark.parametrize("times, positions, velocities, said", [
    ([0], [[0]], [[0]], "times grow"),
    ([0, 1, 1], [[0], [1], [2]], [[0], [0], [0]], "times grow"),
    ([0, 1], [[0], [np.nan]], [[0], [0]], "a position and a velocity"),
    ([0, 1], [[0], [1]], [[0, 0], [0, 0]], "a position and a velocity"),
    ([0, 1], [[0], [1]], [[0], [0.5]], "no velocity in the last point"),
])
def test_a_trajectory_that_cannot_be_sent_on_is_refused(times, positions, velocities, said):
    with pytest.raises(ValueError, match=said):
        retime_trajectory.Way(times, positions, velocities)


def test_a_trajectory_that_begins_elsewhere_is_refused():
    way().require_begin([0.005, 0.0], 0.01)
    with pytest.raises(ValueError, match="expected where the robot is"):
        way().require_begin([0.0, 0.02], 0.01)
    with pytest.raises(ValueError):
        way().require_begin([np.nan, 0.0], 0.01)


class Controller:
    """A controller and a monitor beside the node: the robot is where the last piece says."""

    def __init__(self):
        rclpy.init()
        self.node, self.retimer = rclpy.create_node("controller"), retime_trajectory.RetimeTrajectory()
        self.states = self.node.create_publisher(JointTrajectoryControllerState, "joint_trajectory_controller/controller_state", 1)
        self.separations = self.node.create_publisher(Separation, "separation", 1)
        self.client = ActionClient(self.node, FollowJointTrajectory, "retime_trajectory/follow_joint_trajectory")
        self.node.create_subscription(JointTrajectory, "joint_trajectory_controller/joint_trajectory", self.on_piece, 1)
        self.node.create_timer(0.01, self.tick)
        self.piece, self.is_active, self.scale = None, False, 1.0
        self.thread = spin_beside(self.node, self.retimer, executor=MultiThreadedExecutor(6))
        assert self.client.wait_for_server(10)

    def end(self):
        rclpy.try_shutdown()
        self.thread.join()

    def on_piece(self, piece):
        self.piece = piece

    def position(self):
        if self.piece is None:
            return 0.0
        begin = Time.from_msg(self.piece.header.stamp).nanoseconds
        times = [(begin + point.time_from_start.sec * 10**9 + point.time_from_start.nanosec) * 1e-9 for point in self.piece.points]
        return float(np.interp(self.node.get_clock().now().nanoseconds * 1e-9, times, [point.positions[0] for point in self.piece.points]))

    def tick(self):
        if self.is_active:
            state = JointTrajectoryControllerState(joint_names=["turn"])
            state.feedback.positions = [self.position()]
            self.states.publish(state)
        if self.scale is not None:
            self.separations.publish(Separation(state=Separation.REDUCED, speed_scale=self.scale, links=[LinkSeparation(speed_m_s=1.0)]))

    def wait(self, what, seconds=20.0):
        # A computer that stands still has not slept.
        for _ in range(round(seconds / 0.005)):
            if what():
                return
            time.sleep(0.005)
        assert what()

    def send(self, *positions):
        """A trajectory with a second from each position to the next one."""
        trajectory = JointTrajectory(joint_names=["turn"])
        for k, position in enumerate(positions):
            point = JointTrajectoryPoint(positions=[position], velocities=[0.0])
            point.time_from_start.sec = k
            trajectory.points.append(point)
        answer = self.client.send_goal_async(FollowJointTrajectory.Goal(trajectory=trajectory))
        self.wait(answer.done)
        return answer.result()

    def result(self, goal):
        result = goal.get_result_async()
        self.wait(result.done)
        return result.result()


@pytest.fixture
def controller():
    made = Controller()
    yield made
    made.end()


def test_a_controller_that_is_not_there_is_told(controller):
    assert not controller.send(0.0, 1.0).accepted
    controller.is_active = True
    controller.wait(lambda: controller.retimer.state is not None)
    assert not controller.send(0.5, 1.0).accepted, "it begins elsewhere"
    goal = controller.send(0.0, 1.0)
    assert goal.accepted
    assert controller.result(goal).status == GoalStatus.STATUS_SUCCEEDED
    assert controller.position() == pytest.approx(1.0)


def test_silence_of_the_monitor_is_a_stop_and_a_cancelled_trajectory_too(controller):
    controller.is_active = True
    controller.wait(lambda: controller.retimer.state is not None)
    goal = controller.send(0.0, 1.0, 2.0, 3.0)
    controller.wait(lambda: controller.position() > 0.3)
    controller.scale = None
    controller.wait(lambda: controller.piece.points[0].velocities[0] == 0)
    stands = controller.position()
    assert stands < 2.5
    time.sleep(0.3)
    assert controller.position() == stands
    controller.scale = 0.5
    controller.wait(lambda: controller.position() > stands + 0.1)
    cancelled = goal.cancel_goal_async()
    controller.wait(cancelled.done)
    assert controller.result(goal).status == GoalStatus.STATUS_CANCELED
    stands = controller.position()
    assert stands < 3.0
    assert controller.piece.points[-1].velocities[0] == 0


def test_another_trajectory_waits_until_the_robot_stands(controller):
    controller.is_active = True
    controller.wait(lambda: controller.retimer.state is not None)
    first = controller.send(0.0, 2.0, 0.0)
    controller.wait(lambda: controller.position() > 0.3)
    second = controller.send(0.4, 1.0)
    assert controller.result(first).status == GoalStatus.STATUS_ABORTED
    told = controller.result(second)
    assert told.status == GoalStatus.STATUS_ABORTED
    assert "expected where the robot is" in told.result.error_string
