"""Makes a CMake project of the C++ in the documents.

    snippets.py FOLDER PAGE...

A block of C++ is compiled and linked with what its page tells: the lines of the nearest block of CMake before it, as they
stand there, and the includes of the blocks between. One that follows a comment <!-- given: DECLARATIONS --> is a part of a
program, and is compiled with these declarations before it. Any other one is a whole program, to be run.
programs.txt in FOLDER has their names.
"""
import pathlib
import re
import sys

FENCE = re.compile(r"(?:<!-- given:(?P<given>[^\n]*?)-->\n)?^```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S)
INCLUDE = re.compile(r"^#include [^\n]*\n", re.M)
EXECUTABLE = re.compile(r"^add_executable\([^\n]*\n", re.M)
LINK = re.compile(r"target_link_libraries\(\w+")
CPP_WORDS = re.compile(r"berth::\w+[ (<]|#include|\bconst auto\b")


class Project:
    """The blocks below one block of CMake."""

    def __init__(self, page, line, cmake):
        self.name = f"{re.sub(r'[^a-z0-9]+', '_', page.name.lower())}_{line}"
        self.cmake = cmake
        self.includes = []
        self.parts = []
        self.program = None

    def add(self, place, given, text):
        # A comment behind an include is no part of it.
        self.includes += INCLUDE.findall(text)
        body = INCLUDE.sub("", text)
        if not body.strip():
            return
        body = f'#line {place[1]} "{place[0]}"\n' + INCLUDE.sub("\n", text)
        if given is not None:
            self.parts.append(f"void part_{len(self.parts)}() {{\n{given}\n{body}}}\n")
        elif self.program:
            raise SystemExit(f"{place[0]}:{place[1]}: a second program of one block of CMake; expected one")
        else:
            self.program = body

    def write(self, folder):
        if not self.parts and not self.program:
            return False
        folder = folder / self.name
        folder.mkdir(parents=True)
        main = self.program or "int main() {}\n"
        (folder / "snippets.cpp").write_text("".join(self.includes) + "\n" + "".join(self.parts) + main)
        (folder / "CMakeLists.txt").write_text(
            LINK.sub(f"add_executable({self.name} snippets.cpp)\ntarget_link_libraries({self.name}", EXECUTABLE.sub("", self.cmake), count=1))
        return True


def projects_of(page):
    text = page.read_text()
    projects = []
    for block in FENCE.finditer(text):
        line = text.count("\n", 0, block.start("text")) + 1
        language = block["language"]
        if language == "cmake" and LINK.search(block["text"]):
            projects.append(Project(page, line, block["text"]))
        elif language == "cpp":
            if not projects:
                raise SystemExit(f"{page}:{line}: C++ before any block of CMake; expected one that says what to link")
            projects[-1].add((page, line), block["given"], block["text"])
        elif language == "" and CPP_WORDS.search(block["text"]):
            raise SystemExit(f"{page}:{line}: looks like C++ that nobody compiles; expected ```cpp")
    return projects


def main():
    folder = pathlib.Path(sys.argv[1])
    lines = ["cmake_minimum_required(VERSION 3.22)", "project(berth_snippets LANGUAGES CXX)",
             "set(CMAKE_CXX_STANDARD 20)", "set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/programs)",
             # Parts use what they are given, and give nothing.
             "add_compile_options(-Wall -Wextra -Werror -Wno-unused-variable -Wno-unused-but-set-variable)"]
    programs = []
    for page in sys.argv[2:]:
        for project in projects_of(pathlib.Path(page)):
            if not project.write(folder):
                continue
            lines.append(f"add_subdirectory({project.name})")
            if project.program:
                programs.append(project.name)
    (folder / "CMakeLists.txt").write_text("\n".join(lines) + "\n")
    (folder / "programs.txt").write_text("\n".join(programs) + "\n")


main()
