#!/usr/bin/env python3
"""unique_names.py FOLDER...: finds types that two files define by the same full name.

In one program that is an error (C++'s one definition rule) which no compiler tells: the linker keeps
one of the two and gives it to both. What stands in an unnamed namespace is a file's own. Names for one
instruction set (HWY_NAMESPACE) count as those of the namespace around it. The status is 1 where any was found.
"""
import re
import sys
from collections import defaultdict
from pathlib import Path

COMMENT_OR_TEXT = re.compile(
    r'R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Za-z])\'(?:\\.|[^\'\\\n])+\'|//[^\n]*|/\*(?:.|\n)*?\*/')
DIRECTIVE = re.compile(r"^[ \t]*#(?:.*\\\n)*.*$", re.M)
ATTRIBUTE = re.compile(r"\[\[.*?\]\]")
TOKEN = re.compile(r"[A-Za-z_]\w*(?:::[A-Za-z_]\w*)*|\S")
TEMPLATE = re.compile(r"^template < (?:[^<>]|<[^<>]*>)* > ")
TYPE = re.compile(r"^(?:enum class|enum|class|struct|union) (?:alignas \( [^()]* \) )?([A-Za-z_]\w*)(?: final)?(?: [:<].*)?$")
NAMESPACE = re.compile(r"^(?:inline )?namespace(?: (?:BERTH_EXPORT )?([A-Za-z_][\w:]*))?$")


def defined_types(text):
    """Full names of the types that the text defines in named namespaces."""
    text = COMMENT_OR_TEXT.sub(lambda m: " " if m[0].startswith("/") else " 0 ", text)
    text = ATTRIBUTE.sub(" ", DIRECTIVE.sub("", text))
    scopes = []  # the name of each namespace around, "" for unnamed; None for any other block
    statement = []
    names = []
    for token in TOKEN.findall(text):
        if token == "{":
            words = TEMPLATE.sub("", " ".join(statement))
            namespace = NAMESPACE.match(words)
            scopes.append((namespace[1] or "") if namespace else None)
            found = TYPE.match(words)
            if found and all(scopes[:-1]):
                names.append("::".join([s for s in scopes[:-1] if s != "HWY_NAMESPACE"] + [found[1]]))
        elif token == "}" and scopes:
            scopes.pop()
        if token in "{};":
            statement = []
        else:
            statement.append(token)
    return names


def defined_twice(texts):
    """(name, files) of what more than one of the texts defines; texts: file -> its text."""
    files = defaultdict(list)
    for file, text in texts.items():
        for name in defined_types(text):
            files[name].append(file)
    return sorted((name, where) for name, where in files.items() if len(where) > 1)


def main(folders):
    texts = {file: file.read_text(encoding="utf-8") for folder in folders
             for file in sorted(Path(folder).rglob("*.[ch]pp"))}
    if not texts:
        sys.exit(f"{' '.join(folders)}: no sources there")
    twice = defined_twice(texts)
    for name, where in twice:
        print(f"{name} is defined in {' and in '.join(map(str, where))}")
    return 1 if twice else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
