#!/usr/bin/env python3
"""unique_names.py FOLDER...: finds types that two files define by the same full name, and constants that hide a header's.

Two such types in one program are an error (C++'s one definition rule) which no compiler tells: the linker keeps
one of the two and gives it to both. What stands in an unnamed namespace is a file's own.
A constant of a header in the first folder may have no namesake in another file's part of its namespace, unnamed
parts included: who includes both, or no longer the header, gets the other value, and no compiler tells that either.
Names for one instruction set (HWY_NAMESPACE) count as those of the namespace around it. The status is 1 where any was found.
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
CONSTANT = re.compile(r"^(?:(?:inline|static) )*(?:constexpr|const) [^=(]*?(k[A-Z]\w*)(?: \[[^\]]*\])*(?: =.*)?$")
NAMESPACE = re.compile(r"^(?:inline )?namespace(?: (?:BERTH_EXPORT )?([A-Za-z_][\w:]*))?$")


def defined(text):
    """The types that the text defines in named namespaces, and its constants in any: pairs of namespaces around, name."""
    text = COMMENT_OR_TEXT.sub(lambda m: " " if m[0].startswith("/") else " 0 ", text)
    text = ATTRIBUTE.sub(" ", DIRECTIVE.sub("", text))
    scopes = []  # the name of each namespace around, "" for unnamed; None for any other block
    statement = []
    types = []
    constants = []
    for token in TOKEN.findall(text):
        words = TEMPLATE.sub("", " ".join(statement)) if token in "{;" else ""
        around = "::".join(scope for scope in scopes if scope and scope != "HWY_NAMESPACE")
        constant = CONSTANT.match(words)
        if constant and None not in scopes:
            constants.append((around, constant[1]))
        if token == "{":
            namespace = NAMESPACE.match(words)
            found = TYPE.match(words)
            if found and all(scopes):
                types.append((around, found[1]))
            scopes.append((namespace[1] or "") if namespace else None)
        elif token == "}" and scopes:
            scopes.pop()
        if token in "{};":
            statement = []
        else:
            statement.append(token)
    return types, constants


def defined_twice(texts):
    """(name, files) of the types that more than one of the texts defines; texts: file -> its text."""
    files = defaultdict(list)
    for file, text in texts.items():
        for around, name in defined(text)[0]:
            files[f"{around}::{name}" if around else name].append(file)
    return sorted((name, where) for name, where in files.items() if len(where) > 1)


def hidden_constants(texts, headers):
    """(name, header, other file) of each constant of one of the headers that another of the texts defines in the same namespace."""
    files = defaultdict(list)
    for file, text in texts.items():
        for constant in sorted(set(defined(text)[1])):
            files[constant].append(file)
    return sorted((name, header, file) for (_, name), where in files.items()
                  for header in where if header in headers
                  for file in where if file not in headers or file > header)


def main(folders):
    texts = {file: file.read_text(encoding="utf-8") for folder in folders
             for file in sorted(Path(folder).rglob("*.[ch]pp"))}
    if not texts:
        sys.exit(f"{' '.join(folders)}: no sources there")
    twice = defined_twice(texts)
    for name, where in twice:
        print(f"{name} is defined in {' and in '.join(map(str, where))}")
    hidden = hidden_constants(texts, {file for file in texts if file.suffix == ".hpp" and file.is_relative_to(folders[0])})
    for name, header, file in hidden:
        print(f"{name} is a constant of {header} and another one of {file}")
    return 1 if twice or hidden else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
