"""The site, by Sphinx. scripts/site.sh runs it over a folder of links to the repository's pages.

The left column is made from docs/README.md: a caption for each of its headings, an entry for each page in its tables.
"""
import itertools
import os
import pathlib
import re
from xml.etree import ElementTree

from pygments.lexers.special import TextLexer

ROOT = pathlib.Path(__file__).parents[2]
MAIN_PAGE = "README"
API = "api"
DOXYGEN = ROOT / "build/docs/xml"

project = "berth"
author = "The berth authors"
version = re.search(r"project\(berth VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
extensions = ["myst_parser", "sphinx.ext.autodoc"]
root_doc = MAIN_PAGE
include_patterns = ["*.md", "docs/**.md", "data/bundled/README.md", "lab/bench/RESULTS.md", "ros2/README.md", API + "/**.rst"]
# In this order: CHANGELOG.md goes before the CHANGELOG.rst of ROS.
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
myst_heading_anchors = 6
default_role = "code"
smartquotes = False
html_theme = "furo"
html_title = f"berth {version}"
html_copy_source = False
html_show_sphinx = False


def pages_by_task():
    """(heading, [(title, page)]) of docs/README.md, pages relative to the root."""
    text = (ROOT / "docs/README.md").read_text()
    for section in text.split("\n## ")[1:]:
        links = re.findall(r"\| \[(.*?)\]\((.*?)\.md\) \|", section)
        yield section.split("\n")[0], [(title, os.path.normpath(f"docs/{page}")) for title, page in links]


def left_column():
    yield "```{toctree}\n:hidden:\n\nAll documents <docs/README>\n```\n"
    for heading, pages in pages_by_task():
        entries = [f"{title} <{'self' if page == MAIN_PAGE else '/' + page}>" for title, page in pages]
        if heading == "Integrate":
            entries += [f"/{API}/cpp", f"/{API}/python"]
        yield "```{toctree}\n:hidden:\n:caption: " + heading + "\n\n" + "\n".join(entries) + "\n```\n"


def add_left_column(app, page, source):
    if page == MAIN_PAGE:
        source[0] += "\n" + "\n".join(left_column())


def title(text, line="="):
    return f"{text}\n{line * len(text)}\n\n"


def public_elements():
    """(name, Doxygen's page, XML element) of the classes and of what the namespace has."""
    for file in sorted(DOXYGEN.glob("*berth*.xml")):
        compound = ElementTree.parse(file).find("compounddef")
        if compound.get("kind") == "namespace":
            for member in compound.iter("memberdef"):
                yield member.find("name").text, "{}.html#{}".format(*member.get("id").rsplit("_1", 1)), member
        elif compound.get("prot") == "public":
            yield compound.find("compoundname").text.removeprefix("berth::"), compound.get("id") + ".html", compound


def entry(name, page, element):
    sentence = " ".join("".join(element.find("briefdescription").itertext()).split())
    escaped = re.sub(r"`([^`]*)`|([\\*_|])", lambda found: f"``{found[1]}``" if found[1] else "\\" + found[2], sentence)
    return f"- `{name} <cpp/{page}>`__ {escaped}\n"


def entries_by_header():
    """Header, such as berth/pipeline/query.hpp -> a line for each name that it has, with its first sentence."""
    found = {}
    for name, page, element in public_elements():
        header = element.find("location").get("file").removeprefix("src/")
        found.setdefault(header, set()).add(entry(name, page, element))
    return found


def cpp_page():
    page = title("C++ API") + "What each public header has. The names lead to `Doxygen's pages <cpp/index.html>`__.\n\n"
    by_header = sorted(entries_by_header().items())
    for folder, headers in itertools.groupby(by_header, lambda item: os.path.dirname(item[0])):
        page += title(folder, "-")
        for header, entries in headers:
            page += f"``{header}``\n\n" + "".join(sorted(entries)) + "\n"
    return page


def write_api(app):
    out = pathlib.Path(app.srcdir, API)
    out.mkdir(exist_ok=True)
    (out / "cpp.rst").write_text(cpp_page())
    (out / "python.rst").write_text(title("Python API") + ".. automodule:: berth\n   :members:\n   :imported-members:\n")


def setup(app):
    for language in ("csv", "console"):
        app.add_lexer(language, TextLexer)
    app.connect("builder-inited", write_api)
    app.connect("source-read", add_left_column)
