#!/usr/bin/env python3
"""installed_includes.py FOLDER...: finds what sources outside of berth include of it that is not installed.

They see an installed berth alone: its public headers (cmake/PublicHeaders.cmake) and what these include.
Works on the current folder; the status is 1 where any is missing.
"""
import re
import sys
from pathlib import Path

INCLUDE = re.compile(r'^#include [<"](berth/[^>"]+)[>"]', re.M)
LISTED = re.compile(r"^  (berth/\S+?)\)?$", re.M)


def installed(listed, text_of):
    """The listed headers and all that they include."""
    found, todo = set(), list(listed)
    while todo:
        header = todo.pop()
        if header not in found:
            found.add(header)
            todo += INCLUDE.findall(text_of(header))
    return found


def missing(texts, headers):
    """(file, header) of each include that is not among the headers; texts: file -> its text."""
    return [(file, header) for file, text in texts.items() for header in INCLUDE.findall(text) if header not in headers]


def main():
    listed = LISTED.findall(Path("cmake/PublicHeaders.cmake").read_text(encoding="utf-8"))
    headers = installed(listed, lambda header: Path("src", header).read_text(encoding="utf-8"))
    texts = {str(file): file.read_text(encoding="utf-8")
             for folder in sys.argv[1:] for file in sorted(Path(folder).rglob("*.[ch]pp"))}
    if not listed or not texts:
        sys.exit("no public headers, or no sources")
    found = missing(texts, headers)
    for file, header in found:
        print(f"{file} includes {header}, which is not installed; cmake/PublicHeaders.cmake lists what is")
    print(f"{len(texts)} files, {len(headers)} headers: {len(found)} includes of what is not installed")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
