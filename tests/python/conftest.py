import os
import pathlib

import pytest
import yaml

import berth

SOURCE = pathlib.Path(os.environ.get("BERTH_SOURCE_DIR", pathlib.Path(__file__).parents[2]))

BOX = '<visual><geometry><box size="0.2 0.2 0.6"/></geometry></visual>'
BOXES = f"""<robot name="boxes"><link name="base_link">{BOX}</link><link name="arm">{BOX}</link>
<joint name="a" type="revolute"><parent link="base_link"/><child link="arm"/><origin xyz="0 0.3 0.3"/>
<limit lower="-3" upper="3" effort="1" velocity="1"/></joint></robot>"""


def thinned(folder, name, out, every, last_stamp_s=None, **groups):
    """A bundled scene with fewer images, the last one of each camera with another stamp, and other settings."""
    bundled = SOURCE / "data/bundled"
    scene = yaml.safe_load((bundled / name).read_text())
    scene["robot"].update(urdf=str(bundled / "arm/arm.urdf"), package_paths={"berth_arm": str(bundled / "arm")})
    scene["joints"] = str(bundled / "joints.csv")
    for camera in scene["cameras"]:
        camera["info"] = str(bundled / camera["info"])
        camera["depth"] = sorted(map(str, bundled.glob(camera["depth"])))[::every]
        camera["stamps"] = camera["stamps"][::every]
        if last_stamp_s:
            camera["stamps"][-1] = last_stamp_s
    (folder / out).write_text(yaml.safe_dump({**scene, **groups}))
    return folder / out


@pytest.fixture(scope="session")
def one_camera():
    return berth.open_scene(SOURCE / "data/bundled/one_camera.yaml")


@pytest.fixture(scope="session")
def bundled():
    return berth.open_scene(SOURCE / "data/bundled/scene.yaml")


@pytest.fixture(scope="session")
def step(one_camera):
    return next(iter(one_camera))


@pytest.fixture
def observer(one_camera):
    return berth.Observer(one_camera.views[0])


@pytest.fixture
def query(one_camera):
    return berth.Query(one_camera.robot)
