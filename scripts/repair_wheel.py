#!/usr/bin/env python3
"""Makes a wheel that stands alone: repair_wheel.py WHEEL FOLDER [PACKAGE...]

Copies into it the libraries that its module needs, all but glibc, libgcc and libstdc++, under names that no other wheel's copy has, and
the licences of their Debian packages and of the PACKAGEs whose headers are compiled in. The new wheel's name says which glibc it needs.
Needs patchelf, readelf, ldd and dpkg. auditwheel does the same; Debian does not have it.
"""

import base64
import csv
import hashlib
import io
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

OF_THE_SYSTEM = re.compile(r"(libc|libm|libpthread|libdl|librt|libgcc_s|libstdc\+\+|ld-linux.*)\.so")
COMMON_LICENCES = pathlib.Path("/usr/share/common-licenses")


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def libraries_of(module):
    """Name -> file of all that the loader takes along, but for the system's."""
    found = re.findall(r"^\s*(\S+) => (/\S+)", run("ldd", module), re.MULTILINE)
    missing = re.findall(r"^\s*(\S+) => not found", run("ldd", module), re.MULTILINE)
    if missing:
        sys.exit(f"repair_wheel: {module.name} needs {', '.join(missing)}, which is not installed")
    return {name: pathlib.Path(file).resolve() for name, file in found if not OF_THE_SYSTEM.match(name)}


def newest_version(files, prefix):
    """The newest symbol version that any of the files asks for, such as (2, 34) of GLIBC_."""
    asked = "".join(run("readelf", "--version-info", "--wide", file) for file in files)
    return max(tuple(map(int, version.split("."))) for version in re.findall(prefix + r"([0-9.]+[0-9])", asked))


def write_licence(package, folder):
    text = pathlib.Path("/usr/share/doc", package, "copyright").read_text()
    (folder / f"{package}.txt").write_text(text)
    for name in re.findall(COMMON_LICENCES.as_posix() + r"/([\w.+-]*\w)", text):
        if (COMMON_LICENCES / name).is_file():
            (folder / f"common-{name}.txt").write_text((COMMON_LICENCES / name).read_text())


def package_of(file):
    # Where /lib is a link to /usr/lib, packages may name either.
    for path in (file.as_posix(), file.as_posix().removeprefix("/usr")):
        answer = subprocess.run(["dpkg", "-S", path], capture_output=True, text=True)
        if answer.returncode == 0:
            return answer.stdout.split(":")[0]
    sys.exit(f"repair_wheel: no Debian package has {file}, so its licence is not known")


def carry_libraries(root, module):
    libraries = libraries_of(module)
    folder = root / "berth.libs"
    folder.mkdir()
    names = {}
    for name, file in libraries.items():
        content = file.read_bytes()
        base, _, rest = name.partition(".so")
        names[name] = f"{base}-{hashlib.sha256(content).hexdigest()[:8]}.so{rest}"
        (folder / names[name]).write_bytes(content)
        (folder / names[name]).chmod(0o755)
    files = [folder / name for name in names.values()]
    for file in [*files, module]:
        # One change for each run: patchelf 0.14 mixes up the strings of several.
        for old in set(run("patchelf", "--print-needed", file).split()) & names.keys():
            run("patchelf", "--replace-needed", old, names[old], file)
        if file != module:
            run("patchelf", "--set-soname", file.name, file)
        run("patchelf", "--force-rpath", "--set-rpath", "$ORIGIN/../berth.libs" if file == module else "$ORIGIN", file)
    outside = [name for name, file in libraries_of(module).items() if file.parent != folder.resolve()]
    if outside:
        sys.exit(f"repair_wheel: the module still takes these libraries from the system: {', '.join(outside)}")
    return files, {package_of(file) for file in libraries.values()}


def write_wheel(root, wheel):
    info, = root.glob("*.dist-info")
    files = sorted(file for file in root.rglob("*") if file.is_file() and file.name != "RECORD")
    record = io.StringIO()
    rows = csv.writer(record, lineterminator="\n")
    for file in files:
        digest = base64.urlsafe_b64encode(hashlib.sha256(file.read_bytes()).digest()).rstrip(b"=").decode()
        rows.writerow([file.relative_to(root).as_posix(), f"sha256={digest}", file.stat().st_size])
    rows.writerow([f"{info.name}/RECORD", "", ""])
    (info / "RECORD").write_text(record.getvalue())
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in [*files, info / "RECORD"]:
            archive.write(file, file.relative_to(root))


def main():
    wheel, folder, packages = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3:]
    with tempfile.TemporaryDirectory() as work:
        root = pathlib.Path(work)
        zipfile.ZipFile(wheel).extractall(root)
        module, = root.glob("berth/_berth*.so")
        libraries, owners = carry_libraries(root, module)
        info, = root.glob("*.dist-info")
        licences = info / "licenses"
        licences.mkdir(exist_ok=True)
        for package in sorted(owners.union(packages)):
            write_licence(package, licences)
        glibc = newest_version([module, *libraries], "GLIBC_")
        libstdcxx = newest_version([module, *libraries], "GLIBCXX_")
        machine = sysconfig.get_platform().removeprefix("linux-")
        tag = f"manylinux_{glibc[0]}_{glibc[1]}_{machine}"
        text = (info / "WHEEL").read_text()
        (info / "WHEEL").write_text(re.sub(r"^(Tag: .*-)linux_\w+$", rf"\g<1>{tag}", text, flags=re.MULTILINE))
        folder.mkdir(parents=True, exist_ok=True)
        new = folder / wheel.name.replace(f"linux_{machine}", tag)
        write_wheel(root, new)
        print(f"{new}: {len(libraries)} libraries, {new.stat().st_size / 1e6:.1f} MB; needs glibc {'.'.join(map(str, glibc))} "
              f"and libstdc++ with GLIBCXX_{'.'.join(map(str, libstdcxx))}")


main()
