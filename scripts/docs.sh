#!/bin/sh
# Makes the API's pages of the public headers, build/docs/html/index.html. The status is 1 where Doxygen warns: of a type, a free
# function or an enum that is not documented, or of a comment that it cannot follow. Members whose name says what they are, with its
# unit, need no comment; nor do the functions of one name that each enum and each list of settings or fields has.
set -eu
cd "$(dirname "$0")/.."
headers=$(cmake -P cmake/print_public_headers.cmake 2>&1 | sed 's|^|src/|')
version=$(sed -n 's/^project(berth VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
rm -rf build/docs # a page of what is gone would stay
mkdir -p build/docs
{
  cat docs/Doxyfile
  printf 'PROJECT_NUMBER = %s\nOUTPUT_DIRECTORY = build/docs\nSTRIP_FROM_PATH = src\nSTRIP_FROM_INC_PATH = src\nINCLUDE_PATH = src\n' "$version"
  printf 'INPUT = %s\n' "$(echo $headers)"
} | doxygen - 2>build/docs/warnings.txt
needs_none='Member .* \((variable|enumvalue|function)\) of (struct|class) .* is not documented|Member (name_of|all_of|visit_[a-z]+)\('
if grep -Ev "$needs_none" build/docs/warnings.txt; then
  echo "docs: fix the comments named above" >&2
  exit 1
fi
echo "The API's pages: build/docs/html/index.html"
