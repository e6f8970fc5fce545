"""Plays the bundled scene in real time through the nodes: distances without a robot.

With play:=false nothing is played: a bag of the same topics, or a robot, gives them.
"""
import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import ComposableNodeContainer, LoadComposableNodes, Node
from launch_ros.descriptions import ComposableNode
from launch_ros.parameter_descriptions import ParameterValue

ARGUMENTS = {
    "rviz": ("false", "show it in rviz2"),
    "play": ("true", "play the bundled scene"),
    "loop": ("true", "play it again and again"),
    "question_rate_hz": ("100.0", "questions a second"),
    "use_sim_time": ("false", "take the time from /clock, as for a bag that is played with --clock"),
}


def generate_launch_description():
    share = get_package_share_directory("berth_ros")
    bundled = os.path.join(share, "bundled")
    sim_time = {"use_sim_time": value("use_sim_time", bool)}
    distances = component("DistanceNode", "distance_node", [sim_time, {
        "cameras": ["camera", "left", "right"],
        "environment_links": ["table"],
        "question_rate_hz": value("question_rate_hz", float),
    }])
    player = component("ScenePlayerNode", "scene_player_node", [{
        "scene": os.path.join(bundled, "scene.yaml"),
        "loop": value("loop", bool),
    }])
    return LaunchDescription([
        *(DeclareLaunchArgument(name, default_value=default, description=text)
          for name, (default, text) in ARGUMENTS.items()),
        ComposableNodeContainer(
            name="berth", namespace="", package="rclcpp_components", executable="component_container_mt",
            composable_node_descriptions=[distances], output="screen"),
        LoadComposableNodes(
            target_container="berth", composable_node_descriptions=[player],
            condition=IfCondition(LaunchConfiguration("play"))),
        # For rviz: where each link is.
        Node(package="robot_state_publisher", executable="robot_state_publisher",
             parameters=[sim_time, {"robot_description": urdf(os.path.join(bundled, "arm"))}],
             condition=IfCondition(LaunchConfiguration("rviz"))),
        Node(package="rviz2", executable="rviz2", parameters=[sim_time],
             arguments=["-d", os.path.join(share, "config", "demo.rviz")],
             condition=IfCondition(LaunchConfiguration("rviz"))),
    ])


def value(name, kind):
    return ParameterValue(LaunchConfiguration(name), value_type=kind)


def component(plugin, name, parameters):
    return ComposableNode(
        package="berth_ros", plugin="berth_ros::" + plugin, name=name, parameters=parameters,
        extra_arguments=[{"use_intra_process_comms": True}])


def urdf(folder):
    """The bundled arm's URDF, whose meshes anybody can find."""
    with open(os.path.join(folder, "arm.urdf"), encoding="utf-8") as file:
        return file.read().replace("package://berth_arm/", "file://" + folder + "/")
