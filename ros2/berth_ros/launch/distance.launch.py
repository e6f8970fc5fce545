"""Distances of your robot: from a scene file, from a file of parameters, or from both."""
import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ARGUMENTS = {
    "scene": ("", "a scene file: robot, cameras and settings"),
    "parameters": ("", "a file of parameters, such as config/distance.yaml; they go over the scene"),
    "namespace": ("", "before all names"),
    "use_sim_time": ("false", "take the time from /clock"),
    "rviz": ("false", "show it in rviz2"),
}


def generate_launch_description():
    share = get_package_share_directory("berth_ros")
    return LaunchDescription([
        *(DeclareLaunchArgument(name, default_value=default, description=text)
          for name, (default, text) in ARGUMENTS.items()),
        OpaqueFunction(function=distance_node),
        Node(package="rviz2", executable="rviz2",
             arguments=["-d", os.path.join(share, "config", "demo.rviz")],
             condition=IfCondition(LaunchConfiguration("rviz"))),
    ])


def distance_node(context):
    def argument(name):
        return LaunchConfiguration(name).perform(context)

    given = {"use_sim_time": argument("use_sim_time").lower() == "true"}
    files = [os.path.abspath(argument(name)) for name in ("scene", "parameters") if argument(name)]
    for file in files:
        if not os.path.isfile(file):
            raise FileNotFoundError(f"{file}: there is no such file")
    if argument("scene"):
        given["scene"] = files.pop(0)
    return [Node(package="berth_ros", executable="distance_node", namespace=argument("namespace"),
                 parameters=[*files, given], output="screen")]
