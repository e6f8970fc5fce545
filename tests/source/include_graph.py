#!/usr/bin/env python3
"""include_graph.py: finds includes that go up.

src/berth/CMakeLists.txt names its folders in order: each may include itself and those before it, and nothing
of berth/berth.hpp, thesis, apps, sim, lab and tests. thesis may include src and itself, apps, sim and lab those before them as
well, and none of them tests; thesis/study stands beside lab. The status is 1 where any goes up.
"""
import re
import sys
from pathlib import Path

INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)
FOLDER = re.compile(r"^\s*add_subdirectory\(([\w/]+)\)", re.M)


def ranks(cmake_text):
    """Folder -> its place, 0 for the one that may include itself alone; apps, sim and lab come last."""
    folders = [f"berth/{name}" for name in FOLDER.findall(cmake_text)] + ["thesis", "apps", "sim", "lab", "thesis/study"]
    return {folder: place for place, folder in enumerate(folders)}


def folder_of(file, ranks_of):
    """The innermost folder of `ranks_of` that holds the file; None for another one."""
    return next((str(folder) for folder in Path(file).parents if str(folder) in ranks_of), None)


def going_up(texts, ranks_of):
    """(file, included file) of what is included against the order; texts: file -> its text."""
    found = []
    for file, text in texts.items():
        own = folder_of(file, ranks_of)
        for included in INCLUDE.findall(text):
            other = folder_of(included, ranks_of)
            # Above all is what has no place: berth.hpp, tests.
            ours = Path(included).parts[0] in ("berth", "thesis", "apps", "sim", "lab", "tests")
            if own and ours and (other is None or ranks_of[other] > ranks_of[own]):
                found.append((file, included))
    return found


def main():
    ranks_of = ranks(Path("src/berth/CMakeLists.txt").read_text(encoding="utf-8"))
    texts = {str(file.relative_to(root)): file.read_text(encoding="utf-8")
             for root, folder in (("src", "berth"), (".", "thesis"), (".", "apps"), (".", "sim"), (".", "lab"))
             for file in sorted(Path(root, folder).rglob("*.[ch]pp"))}
    if not texts or len(ranks_of) < 2:
        sys.exit("no sources, or no folders in src/berth/CMakeLists.txt")
    found = going_up(texts, ranks_of)
    for file, included in found:
        print(f"{file} includes {included}, which is above it")
    print(f"{len(texts)} files, {len(ranks_of)} folders: {len(found)} includes go up")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
