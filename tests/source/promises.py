#!/usr/bin/env python3
"""promises.py: whether CHANGELOG.md names each promise that has changed or gone since promises.txt was written.

A promise is what others build on: a message of ros2/, a key of a schema (the settings are keys of scene files), a name of the Python
module, a public name of C++ with its declaration. What is new needs no line. C++ is read from what Doxygen made (scripts/docs.sh).
promises.txt has the promises of the last release; --write makes it anew, once a release is out. The status is 1 where a name is missing,
77 where there is no Doxygen, or another one than made the list.
"""
import ast
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

LIST = Path(__file__).parent / "promises.txt"
SKIPPED = 77


def messages(texts):
    """texts: file -> its text. A message is one promise: a field more is another message to who has the old one."""
    for file, text in texts.items():
        lines = (" ".join(line.split("#")[0].split()) for line in text.splitlines())
        yield f"message {Path(file).name}", "; ".join(line for line in lines if line)


def schema_keys(name, schema, path=""):
    """A promise for each key: what its value may be, and whether it is always there."""
    elsewhere = {"description", "properties", "required", "items", "deprecated", "deprecationMessage"}
    for key, value in schema.get("properties", {}).items():
        told = {word: meaning for word, meaning in value.items() if word not in elsewhere}
        always = " always" if key in schema.get("required", []) else ""
        yield f"{name} {path}{key}", json.dumps(told, sort_keys=True) + always
        yield from schema_keys(name, value, f"{path}{key}.")
    if "items" in schema:
        yield from schema_keys(name, schema["items"], path)
    for group, definition in schema.get("$defs", {}).items():
        yield from schema_keys(name, definition, f"{group}.")


def python_names(text):
    def walk(body, path):
        for node in body:
            if isinstance(node, ast.ClassDef):
                made_of = [ast.unparse(f.args) for f in node.body if isinstance(f, ast.FunctionDef) and f.name == "__init__"]
                yield f"python {path}{node.name}", " | ".join(made_of)
                yield from walk(node.body, f"{path}{node.name}.")
            elif isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
                yield f"python {path}{node.name}", ast.unparse(node.args) + " -> " + ast.unparse(node.returns)
            elif isinstance(node, ast.AnnAssign) and not node.target.id.startswith("_"):
                yield f"python {path}{node.target.id}", ast.unparse(node.annotation)
    return walk(ast.parse(text).body, "berth.")


def cpp_names(compounds):
    """compounds: the elements of Doxygen's XML. A definition is told without its blanks, which are Doxygen's."""
    for compound in compounds:
        if compound.get("kind") == "file":
            yield f"header {compound.find('location').get('file').removeprefix('src/')}", "is there"
        if compound.get("kind") not in ("class", "struct", "namespace") or compound.get("prot") == "private":
            continue
        if compound.get("kind") != "namespace":
            bases = [base.text for base in compound.iterfind("basecompoundref[@prot='public']")]
            yield f"c++ {compound.find('compoundname').text}", " ".join([compound.get("kind"), *bases])
        for member in compound.iterfind("sectiondef/memberdef[@prot='public']"):
            parts = [member.find("definition"), member.find("argsstring"), member.find("initializer")]
            text = "".join("".join(part.itertext()) for part in parts if part is not None)
            values = [value.text for value in member.iterfind("enumvalue/name")]
            name = f"{compound.find('compoundname').text}::{member.find('name').text}"
            yield f"c++ {name}", re.sub(r"\s", "", text) + " ".join(values)


def by_key(pairs):
    """One text for each key: that of all its overloads."""
    found = {}
    for key, text in pairs:
        found.setdefault(key, []).append(text)
    return {key: " | ".join(sorted(texts)) for key, texts in found.items()}


def current(root):
    def read(pattern):
        files = sorted(root.glob(pattern))
        if not files:
            sys.exit(f"{root / pattern}: no such file; expected what is promised there")
        return {file: file.read_text(encoding="utf-8") for file in files}
    pairs = list(messages({**read("ros2/*/msg/*.msg"), **read("ros2/*/srv/*.srv"), **read("ros2/*/action/*.action")}))
    for file, text in read("data/schema/*.json").items():
        pairs += schema_keys(file.stem, json.loads(text))
    for text in read("python/berth/_berth.pyi").values():
        pairs += python_names(text)
    for text in read("build/docs/xml/*.xml").values():
        pairs += cpp_names(ElementTree.fromstring(text).iter("compounddef"))
    return by_key(pairs)


def word_of(key):
    """By which a changelog names it: the last name of a path, a file without its ending."""
    return re.split(r"[ .:/]", re.sub(r"\.(msg|srv|action|hpp)$", "", key))[-1]


def newest_section(changelog):
    return changelog.split("\n## ")[1]


def unnamed(before, now, section):
    """(key, what it was, what it is or None) of each that changed or went and that no `code` of the section names. A class that went
    takes its members along."""
    code = " ".join(re.findall(r"`([^`]+)`", section))
    gone = before.keys() - now.keys()
    for key, text in before.items():
        if key.rpartition("::")[0] in gone:
            continue
        if now.get(key) != text and not re.search(rf"(?<!\w){re.escape(word_of(key))}(?!\w)", code):
            yield key, text, now.get(key)


def main(root, arguments):
    if not shutil.which("doxygen"):
        print("skipped: Doxygen is not here (scripts/packages-docs.txt)")
        return SKIPPED
    subprocess.run(["scripts/docs.sh"], cwd=root, check=True, stdout=subprocess.DEVNULL)
    doxygen = "# Doxygen " + subprocess.run(["doxygen", "--version"], capture_output=True, text=True, check=True).stdout.split()[0]
    now = current(root)
    if arguments == ["--write"]:
        LIST.write_text("\n".join([doxygen, *(f"{key} = {text}" for key, text in sorted(now.items()))]) + "\n")
        return 0
    first, *lines = LIST.read_text(encoding="utf-8").splitlines()
    if first != doxygen:
        print(f"skipped: {LIST.name} was made by {first[2:]}, and here is {doxygen[2:]}, which may write declarations in another way")
        return SKIPPED
    before = dict(line.split(" = ", 1) for line in lines)
    section = newest_section((root / "CHANGELOG.md").read_text(encoding="utf-8"))
    missing = list(unnamed(before, now, section))
    for key, was, text in missing:
        change = "went" if text is None else f"is {text} now"
        print(f"{key} was {was} and {change}; expected `{word_of(key)}` in CHANGELOG.md, in its section {section.splitlines()[0]}")
    print(f"{len(before)} promises, {len(missing)} changed without a word")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main(Path.cwd(), sys.argv[1:]))
