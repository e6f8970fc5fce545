"""A ros2_control arm that gives way where a person comes near, and goes on later: mock hardware, a controller, drawn cameras.

`ros2 run berth_ros pause_and_resume --ros-args -p out:=FOLDER` beside it sends a trajectory and the person, and draws what came of it.
With controller:=plain_controller the controller knows no speed scale; the trajectory goes to `retime_trajectory/follow_joint_trajectory`.
With controller:=velocity_controller the arm goes as `wanted_velocity` says, as far as the filter lets it.
"""
import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

RAMP = {"deceleration_m_s2": 2.0, "acceleration_m_s2": 1.0}  # as distance.yaml has them
# What distance_node has to know of another controller than arm_controller.
BEFORE = {
    "plain_controller": {"separation.reaction_time_s": 0.2},  # what it is sent is obeyed 0.1 s later
    "velocity_controller": {"filter.command_topic": "velocity_controller/commands", "filter.joints": ["shoulder", "elbow"],
                            "filter.period_s": 0.04, "filter.latency_s": 0.04, "filter.least_distance_m": 0.3},
}


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("controller", default_value="arm_controller", choices=["arm_controller", *BEFORE]),
        OpaqueFunction(function=lambda context: nodes(LaunchConfiguration("controller").perform(context))),
    ])


def nodes(controller="arm_controller"):
    folder = os.path.join(get_package_share_directory("berth_ros"), "examples", "box_arm")
    urdf, controllers = (os.path.join(folder, name) for name in ("box_arm.urdf", "controllers.yaml"))
    with open(urdf, encoding="utf-8") as file:
        description = {"robot_description": file.read()}
    example = {"arm_controller": "scale_speed", "plain_controller": "retime_trajectory"}.get(controller)
    return [
        Node(package="robot_state_publisher", executable="robot_state_publisher", parameters=[description]),
        Node(package="controller_manager", executable="ros2_control_node", parameters=[controllers]),
        Node(package="controller_manager", executable="spawner",
             arguments=["joint_state_broadcaster", controller, "--param-file", controllers]),
        Node(package="berth_ros", executable="box_world",
             parameters=[{"urdf": urdf}, {"person_is_near": [1.3, 0.2]} if controller == "velocity_controller" else {}]),
        Node(package="berth_ros", executable="distance_node", output="screen",
             parameters=[os.path.join(folder, "distance.yaml"), BEFORE.get(controller, {})]),
        *([Node(package="berth_ros", executable=example, parameters=[RAMP, {"controller": controller}], output="screen")] if example else []),
    ]
