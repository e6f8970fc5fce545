"""The blocks of docs/python.md, copied into an empty file."""
import re
import subprocess
import sys

from conftest import BOXES, SOURCE


def test_the_pages_lines_run(tmp_path):
    page = (SOURCE / "docs/python.md").read_text()
    blocks = re.findall(r"<!-- snippet -->\n```python\n(.*?)```", page, re.S)
    assert len(blocks) >= 3
    (tmp_path / "robot.urdf").write_text(BOXES)
    (tmp_path / "copied.py").write_text("\n".join(blocks))
    run = subprocess.run([sys.executable, "copied.py"], cwd=tmp_path, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    assert "LinkResult(arm, ok" in run.stdout and "SelfFilterSettings(tolerance_m=0.03" in run.stdout
