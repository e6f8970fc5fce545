"""check_files.py DIR: fails unless DIR is a whole study: every figure measured on the CPU as
well-formed CSV, SVG and PNG, and a page that needs no other file."""
import csv
import sys
import zlib
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

MEASURED = [5, 6, 7, 8, 9, 10, 11, 12, 17, 18, 19]
VOID = {"meta", "br", "img", "hr", "link", "input"}


def check_csv(path):
    with open(path, newline="", encoding="utf-8") as file:
        header, *lines = csv.reader(file)
    assert lines, f"{path}: has no lines"
    assert all(len(line) == len(header) for line in lines), f"{path}: columns differ"
    assert not any("nan" in line for line in lines), f"{path}: has NaN"


def check_png(path):
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", f"{path}: is no PNG"
    place, kind = 8, b""
    while place < len(data):
        size, kind = int.from_bytes(data[place:place + 4], "big"), data[place + 4:place + 8]
        body = data[place + 4:place + 8 + size]
        assert zlib.crc32(body).to_bytes(4, "big") == data[place + 8 + size:place + 12 + size]
        place += size + 12
    assert kind == b"IEND", f"{path}: is cut"


class Page(HTMLParser):
    """Tags have to be closed in order; what they refer to is kept."""

    def __init__(self):
        super().__init__()
        self.open, self.loads, self.ids = [], [], set()

    def handle_starttag(self, tag, attributes):
        if tag not in VOID:
            self.open.append(tag)
        found = dict(attributes)
        self.ids.add(found.get("id"))
        if tag != "a":
            self.loads += [found[name] for name in ("src", "href", "xlink:href") if name in found]

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        self.handle_endtag(tag)

    def handle_endtag(self, tag):
        if tag not in VOID:
            assert self.open.pop() == tag, f"index.html: </{tag}> closes another tag"


def main():
    folder = Path(sys.argv[1])
    for figure in MEASURED:
        stem = folder / f"figure_3_{figure:02}"
        check_csv(stem.with_suffix(".csv"))
        ElementTree.parse(stem.with_suffix(".svg"))
        check_png(stem.with_suffix(".png"))
    text = (folder / "index.html").read_text(encoding="utf-8")
    page = Page()
    page.feed(text)
    assert not page.open, f"index.html: {page.open} are not closed"
    for figure in range(5, 20):
        assert f"figure_3_{figure:02}" in page.ids, f"index.html: lacks figure 3.{figure}"
    assert text.count("<svg") == len(MEASURED), "index.html: a figure is not in it"
    assert all(link.startswith(("#", "data:")) for link in page.loads), "index.html: loads files"
    for made in [folder / "index.html", *folder.glob("*.csv"), *folder.glob("*.svg")]:
        assert str(folder) not in made.read_text(encoding="utf-8"), f"{made}: tells where it lies"
    for words in ("does not hold", "holds", "commit", "seed", "What to choose"):
        assert words in text, f"index.html: lacks {words}"


if __name__ == "__main__":
    main()
