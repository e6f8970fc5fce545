#!/usr/bin/env python3
"""Writes berth/_berth.pyi, the types of the module, with mypy's stubgen. --check: says whether it is up to date, and ends with 77
where another mypy made it.

The module has to be importable: PYTHONPATH=build/release/python python/make_stubs.py
"""
import pathlib
import re
import subprocess
import sys
import tempfile

from mypy.version import __version__ as mypy_version

STUB = pathlib.Path(__file__).parent / "berth" / "_berth.pyi"
HEADER = f"# Made by python/make_stubs.py with mypy {mypy_version}."
# What stubgen cannot know.
MENDED = [
    (r"_repr_png_: ClassVar\[function\] = \.\.\.", "def _repr_png_(self) -> bytes: ..."),
    (r"os\.PathLike(?!\[)", "Union[str, os.PathLike[str]]"),
    (r"numpy\.ndarray(\[numpy\.float64\])?", "numpy.typing.NDArray[Any]"),
    (r"List\[str\[2\]\]", "List[str]"),
    (r"-> dict:", "-> Dict[str, Any]:"),
    (r"-> list:", "-> List[Dict[str, Any]]:"),
    (r"-> tuple:", "-> Tuple[numpy.typing.NDArray[Any], numpy.typing.NDArray[Any]]:"),
    (r"ClassVar\[dict\]", "ClassVar[Dict[str, Any]]"),
    (r"import numpy\n", "import numpy.typing\n"),
    (r"\*args, \*\*kwargs", "*args: Any, **kwargs: Any"),
    (r"from typing import ([^\n]*)\n\nfrom typing import overload", r"from typing import Any, Union, \1, overload"),
    (r"from typing import Any, Union, Any, ", "from typing import Any, Union, "),
]


def made():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["stubgen", "-q", "-m", "berth._berth", "-o", folder], check=True)
        text = (pathlib.Path(folder) / "berth" / "_berth.pyi").read_text()
    for pattern, to in MENDED:
        text = re.sub(pattern, to, text)
    # Private and read-only parts of enums that say nothing.
    lines = [line for line in text.splitlines() if "__entries" not in line]
    return HEADER + "\n" + "\n".join(lines) + "\n\n__version__: str\n"


if sys.argv[1:] == ["--check"]:
    if not STUB.read_text().startswith(HEADER + "\n"):
        print(f"{STUB} was made with another mypy than {mypy_version}")
        sys.exit(77)
    if STUB.read_text() != made():
        sys.exit(f"{STUB} is not what the module has; run python/make_stubs.py")
else:
    STUB.write_text(made())
