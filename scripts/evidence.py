#!/usr/bin/env python3
"""evidence.py [BUILD]: runs the tests that docs/evidence.md names in this build folder, and writes build/evidence.md: the page with the outcome
of each, the commit and the machine. The status is 1 where a test is gone or fails. Tests of ROS are named by their file, and run by `make test-ros2`."""
import os
import platform
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/evidence.md"
NAME = re.compile(r"`([A-Z]\w*\.[A-Z0-9]\w*)`")
FILE = re.compile(r"`((?:ros2|tests)/[\w/]+\.py)`")


def defined_tests(root=ROOT):
    """Suite.Name of each test in the sources."""
    found = set()
    for folder in ("tests", "thesis"):
        for file in (root / folder).rglob("*.cpp"):
            found |= {f"{suite}.{name}" for suite, name in re.findall(r"^TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)", file.read_text(encoding="utf-8"), re.M)}
        for file in (root / folder).rglob("CMakeLists.txt"):
            found |= set(re.findall(r"add_test\(NAME (\w+\.\w+)", file.read_text(encoding="utf-8")))
    return found


def gone(text, root=ROOT):
    """What a page names and the sources do not have."""
    names = set(NAME.findall(text)) - defined_tests(root)
    return sorted(names | {file for file in FILE.findall(text) if not (root / file).is_file()})


def outcomes(names, build):
    """Suite.Name -> passed, FAILED, skipped or not built."""
    pattern = "^(.*/)?(" + "|".join(re.escape(name) for name in sorted(names)) + ")(/.*)?$"
    run = subprocess.run(["ctest", "--test-dir", build, "-R", pattern], capture_output=True, text=True)
    found = {}
    for name, said in re.findall(r"Test\s+#\d+: (?:\S*/)?(\w+\.\w+)\S*.*?\.{2,}\s*(\*{0,3}\w[\w ]*)", run.stdout):
        outcome = "passed" if said.startswith("Passed") else "skipped" if "Skipped" in said else "FAILED"
        if found.get(name) != "FAILED":
            found[name] = outcome
    return {name: found.get(name, "not built") for name in names}


def with_outcomes(text, found):
    return NAME.sub(lambda name: f"`{name[1]}` ({found[name[1]]})" if name[1] in found else name[0], text)


def main(build):
    text = PAGE.read_text(encoding="utf-8")
    lost = gone(text)
    if lost:
        sys.exit(f"{PAGE}: no such test: {', '.join(lost)}")
    found = outcomes(set(NAME.findall(text)), build)
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True).stdout.strip()
    model = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    machine = f"{model[1] if model else platform.machine()}, {os.cpu_count()} processors, {platform.system()} {platform.release()}"
    failed = sorted(name for name, outcome in found.items() if outcome == "FAILED")
    count = {outcome: list(found.values()).count(outcome) for outcome in ("passed", "FAILED", "skipped", "not built")}
    summary = ", ".join(f"{number} {outcome}" for outcome, number in count.items() if number)
    out = ROOT / "build/evidence.md"
    out.write_text(with_outcomes(text, found) + f"\n## This run\nCommit {commit} on {machine}: {summary}.\n", encoding="utf-8")
    print(f"{out}: {summary}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release")))
