import os
import pathlib

import pytest

import berth

SOURCE = pathlib.Path(os.environ.get("BERTH_SOURCE_DIR", pathlib.Path(__file__).parents[2]))

BOX = '<visual><geometry><box size="0.2 0.2 0.6"/></geometry></visual>'
BOXES = f"""<robot name="boxes"><link name="base_link">{BOX}</link><link name="arm">{BOX}</link>
<joint name="a" type="revolute"><parent link="base_link"/><child link="arm"/><origin xyz="0 0.3 0.3"/>
<limit lower="-3" upper="3" effort="1" velocity="1"/></joint></robot>"""


@pytest.fixture(scope="session")
def one_camera():
    return berth.open_scene(SOURCE / "data/bundled/one_camera.yaml")


@pytest.fixture(scope="session")
def one_mesh_camera(tmp_path_factory):
    """The same scene, asked about the whole robot."""
    folder = SOURCE / "data/bundled"
    text = (folder / "one_camera.yaml").read_text().replace("method: exact", "method: mesh")
    for key, name in (("urdf", "arm/arm.urdf"), ("info", "camera_info.yaml"), ("depth", "depth/*.png"), ("joints", "joints.csv"),
                      ("berth_arm", "arm")):
        text = text.replace(f"{key}: {name}", f"{key}: {folder / name}")
    file = tmp_path_factory.mktemp("scene") / "mesh.yaml"
    file.write_text(text)
    return berth.open_scene(file)


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
