"""A ros2_control arm that pauses where a person comes near, and goes on later: mock hardware, a joint_trajectory_controller, drawn cameras.

`ros2 run berth_ros pause_and_resume --ros-args -p out:=FOLDER` beside it sends a trajectory and the person, and draws what came of it.
With retimed:=true the controller knows no speed scale; the trajectory goes to `retime_trajectory/follow_joint_trajectory`.
"""
import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

RAMP = {"deceleration_m_s2": 2.0, "acceleration_m_s2": 1.0}  # as distance.yaml has them


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("retimed", default_value="false", description="retime_trajectory in place of scale_speed"),
        OpaqueFunction(function=lambda context: nodes(LaunchConfiguration("retimed").perform(context).lower() == "true")),
    ])


def nodes(is_retimed):
    folder = os.path.join(get_package_share_directory("berth_ros"), "examples", "box_arm")
    urdf, controllers = (os.path.join(folder, name) for name in ("box_arm.urdf", "controllers.yaml"))
    with open(urdf, encoding="utf-8") as file:
        description = {"robot_description": file.read()}
    controller, example = ("plain_controller", "retime_trajectory") if is_retimed else ("arm_controller", "scale_speed")
    # What it sends is obeyed 0.1 s later.
    reaction = {"separation.reaction_time_s": 0.2 if is_retimed else 0.1}
    return [
        Node(package="robot_state_publisher", executable="robot_state_publisher", parameters=[description]),
        Node(package="controller_manager", executable="ros2_control_node", parameters=[controllers]),
        Node(package="controller_manager", executable="spawner",
             arguments=["joint_state_broadcaster", controller, "--param-file", controllers]),
        Node(package="berth_ros", executable="box_world", parameters=[{"urdf": urdf}]),
        Node(package="berth_ros", executable="distance_node", output="screen",
             parameters=[os.path.join(folder, "distance.yaml"), reaction]),
        Node(package="berth_ros", executable=example, parameters=[RAMP, {"controller": controller}], output="screen"),
    ]
