#!/usr/bin/env python3
"""links.py SITE: whether each link of a site's pages leads to a file of it, and to an anchor where it names one.

Links to elsewhere are told and not followed. Doxygen's pages are led to, and not read themselves. The status is 1 where one leads nowhere.
"""
import sys
from functools import lru_cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

DOXYGEN = "api/cpp/"


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], {""}
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.links.append(value)
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)


@lru_cache(maxsize=None)
def page_of(file):
    return Page(file.read_text(encoding="utf-8"))


def trouble(file, link):
    """Empty where the link of this page leads somewhere in the site."""
    parts = urlsplit(link)
    target = file.parent / unquote(parts.path) if parts.path else file
    if not target.is_file():
        return "no such file"
    has_anchors = target.suffix == ".html" and unquote(parts.fragment) not in page_of(target.resolve()).anchors
    return "no such anchor" if has_anchors else ""


def check(site):
    """(links to elsewhere, (page, link, trouble) of those that lead nowhere)."""
    elsewhere, lost = set(), []
    for file in sorted(site.rglob("*.html")):
        name = str(file.relative_to(site))
        for link in [] if name.startswith(DOXYGEN) else page_of(file.resolve()).links:
            if urlsplit(link).scheme or link.startswith("//"):
                elsewhere.add(link)
            elif told := trouble(file, link):
                lost.append((name, link, told))
    return elsewhere, lost


def main(site):
    elsewhere, lost = check(site)
    for name, link, told in lost:
        print(f"{site / name} leads to {link}: {told}", file=sys.stderr)
    print("Links that leave the site, which nobody followed:", *sorted(elsewhere), sep="\n  ")
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
