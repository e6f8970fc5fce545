#!/usr/bin/env python3
"""versions.py: whether each file that tells berth's version tells that of CMakeLists.txt, the one place to change it.

--release: CHANGELOG.md has to name the day, too, and nothing is Forthcoming. The status is 1 where a file differs.
"""
import re
import sys
from pathlib import Path

# ROS calls what is not released yet Forthcoming.
FORTHCOMING = "Forthcoming"
RST = rf"\n({FORTHCOMING}|\d[\d.]*)(?: \(.*\))?\n-+\n"
# Who tells a version, and where in the text. The newest entry comes first in changelogs.
TOLD = [
    ("package.xml", r"<version>([^<]*)</version>"),
    ("ros2/*/package.xml", r"<version>([^<]*)</version>"),
    ("CHANGELOG.md", r"\n## (\d[\d.]*)"),
    ("CHANGELOG.rst", RST),
    ("ros2/*/CHANGELOG.rst", RST),
    ("debian/changelog", r"\Aberth \((?:\d+:)?(\d[\d.]*)"),
]
DAY = re.compile(r"\n## \d[\d.]*, (\d{4}-\d{2}-\d{2})\n")


def version_of(cmake_text):
    return re.search(r"project\(berth VERSION ([\d.]+)", cmake_text)[1]


def differing(texts, allowed):
    """(file, what it tells) of each that tells none of the allowed; texts: file -> (its text, where the version stands)."""
    for file, (text, where) in texts.items():
        found = re.search(where, text)
        if not found or found[1] not in allowed:
            yield file, found[1] if found else "no version"


def newest_day(changelog):
    """That of the newest version; None where it has none."""
    newest = re.search(r"\n## .*\n", changelog)
    day = newest and DAY.match(newest[0])
    return day and day[1]


def main(arguments):
    version = version_of(Path("CMakeLists.txt").read_text(encoding="utf-8"))
    texts = {file: (file.read_text(encoding="utf-8"), where) for pattern, where in TOLD
             for file in sorted(Path().glob(pattern))}
    is_release = arguments == ["--release"]
    differ = list(differing(texts, [version] if is_release else [version, FORTHCOMING]))
    for file, told in differ:
        print(f"{file} tells {told}; expected {version}, as CMakeLists.txt has it")
    if is_release and not newest_day(Path("CHANGELOG.md").read_text(encoding="utf-8")):
        print(f"CHANGELOG.md does not tell the day of its newest version; expected \"## {version}, YYYY-MM-DD\"")
        return 1
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
