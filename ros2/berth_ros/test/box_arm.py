"""The arm of boxes under a controller_manager, as its launch file starts it."""
import importlib.util
import os

from ament_index_python.packages import get_package_share_directory


def arm_nodes(controller):
    file = os.path.join(get_package_share_directory("berth_ros"), "launch", "pause.launch.py")
    spec = importlib.util.spec_from_file_location("pause", file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.nodes(controller)
