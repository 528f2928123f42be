#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes header_packages.txt: the Debian packages of headers and libraries, from Debian's own Contents index.

    write_table.py [--suite bookworm] [--cache DIR] > header_packages.txt

Downloads about 75 MB by apt-get into DIR (a temporary folder) and does not change the lists of this machine. README.md
describes the table."""
import argparse
import collections
import pathlib
import re
import subprocess
import sys
import tempfile

MIRROR = "http://deb.debian.org/debian"
KEYRING = "/usr/share/keyrings/debian-archive-keyring.gpg"
APT_CONF = """Dir::State::Lists "{dir}/lists";
Dir::Etc::SourceParts "{dir}/none";
Dir::Etc::SourceList "{dir}/sources.list";
Acquire::IndexTargets::deb::Contents-deb::MetaKey "$(COMPONENT)/Contents-$(ARCHITECTURE)";
Acquire::IndexTargets::deb::Contents-deb::ShortDescription "Contents-$(ARCHITECTURE)";
Acquire::IndexTargets::deb::Contents-deb::Description "$(RELEASE)/$(COMPONENT) $(ARCHITECTURE) Contents (deb)";
"""
MULTIARCH = "x86_64-linux-gnu"

# Packages whose headers no component includes, by the beginning of their names: compilers, kernels, interfaces of programs for
# their own plugins, and large libraries of other fields. Also newer ones of libraries that Debian has twice.
UNUSED = re.compile("-cross$|-private|^(" + "|".join(r"""
    linux llvm libclang libstdc\+\+ gcc g\+\+ libc6 musl dietlibc diet newlib picolibc avr golang libghc libpkgconf libclc
    apache2 libapache2 perl php ruby postgresql-server xserver nx libnx dovecot libwine wine libfcitx fcitx gthumb libclaws enlightenment
    codeblocks pidgin apertium libkf5 lib[a-z0-9-]*kdelibs libkdb3 libk3b libdframework libgnustep gnustep libefl libtgowt libpyside
    libtrilinos liboce libocct libotb libqgis libmaus2 libns3 paraview libncbi libtorch libspooles gap- libglobus libkim-api libpersalys
    libopenturns gatbcore libgatb gnuradio libatlas libace libsight libinsighttoolkit4
    libboost.*1\.81 libgtkmm-4 libgtk-4 qt6 libqt6""".split()) + ")")
# The package to install instead of the one that has the header, with its pkg-config module ("": none).
META = [(r"^libopencv-(?!apps).*-dev$", "libopencv-dev", "opencv4"), (r"^(libboost.*?)1\.74-dev$", r"\1-dev", ""),
        (r"^libgl1-mesa-dev$|^libglvnd-core-dev$|^libglx-dev$", "libgl-dev", "gl"),
        (r"^libpython3\.11-dev$", "python3-dev", "python3-embed"),
        (r"^libjpeg62-turbo-dev$", "libjpeg-dev", "libjpeg"), (r"^libpcap0\.8-dev$", "libpcap-dev", "libpcap"),
        (r"^wx3\.2-headers$", "libwxgtk3.2-dev", "")]
# Components of robots are older than Debian: of several packages with the header, these come first.
PREFERRED = {"libgtk2.0-dev", "libgtkmm-2.4-dev", "liblua5.3-dev", "libsdl1.2-dev", "libopenni-dev", "libusb-dev", "qtbase5-dev",
             "libpulse-dev", "libcurl4-openssl-dev", "libserial-dev", "libresample1-dev",
             "wx3.2-headers"}
# Include folders below /usr/include whose name does not end with a version like -1.0.
ROOTS = {"eigen3", "opencv4", "qt5", "SDL", "SDL2", "libxml2", "libpng16", "openni2", "libftdi1", "ni", "jsoncpp", "irrlicht",
         "mariadb"}
# Folders that another name leads to.
LINKS = {"mysql/": ("libmariadb-dev", "libmariadb", "."), "glut.h": ("libglut-dev", "glut", "~GL")}


def fetch(folder, suite):
    """Downloads the indices."""
    for name in ("lists/partial", "none"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    sources = "".join(f"{kind} [signed-by={KEYRING}] {MIRROR} {suite} main\n" for kind in ("deb", "deb-src"))
    (folder / "sources.list").write_text(sources)
    conf = folder / "apt.conf"
    conf.write_text(APT_CONF.format(dir=folder))
    subprocess.run(["apt-get", "update"], env={"APT_CONFIG": str(conf), "PATH": "/usr/bin:/bin"}, check=True, stdout=sys.stderr)


def read(folder, pattern):
    """Yields the lines of the downloaded files with this name."""
    for file in sorted((folder / "lists").glob(pattern)):
        command = ["/usr/lib/apt/apt-helper", "cat-file", file]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, errors="replace")
        yield from process.stdout


def letters(text):
    return re.sub(r"[^a-z]", "", text.lower())


def characters(text):
    return re.sub(r"[^a-z0-9]", "", text.lower())


class Index:
    def __init__(self, folder):
        self.headers, self.libraries, self.modules = [], [], collections.defaultdict(set)
        for line in read(folder, "*Contents-*"):
            path, _, packages = line.rstrip().rpartition(" ")
            path = path.rstrip().replace(f"/{MULTIARCH}/", "/", 1)
            for package in {each.rsplit("/", 1)[-1] for each in packages.split(",")}:
                self.add(path, package)
        self.users = collections.Counter()
        for pattern in "*Sources*", "*Packages*":
            for line in read(folder, pattern):
                if line.startswith(("Build-Depends:", "Depends:")):
                    self.users.update(set(re.findall(r"[a-z0-9][a-z0-9+.-]+dev\b", line)))

    def add(self, path, package):
        if not re.search(r"dev$|^wx3.2-headers$", package) or UNUSED.search(package):
            return
        if path.startswith("usr/include/") and not path.endswith("/"):
            self.headers.append((path[len("usr/include/"):], package))
        elif found := re.fullmatch(r"usr/lib/lib([^/]+)\.(so|a)", path):
            self.libraries.append((found[1], package))
        elif found := re.fullmatch(r"usr/(?:lib|share)/pkgconfig/([^/]+)\.pc", path):
            self.modules[package].add(found[1])

    def rank(self, package):
        """Sorts packages with one header: the preferred one first, then the one that most sources of Debian build with."""
        return package not in PREFERRED, -self.users[package], package

    def drop_unused(self):
        """Drops packages that nothing builds with, unless pkg-config knows them: robots may use them."""
        keep = lambda package: self.users[package] > 0 or self.modules[package] or package in PREFERRED
        self.headers = [(path, package) for path, package in self.headers if keep(package)]
        self.libraries = [(name, package) for name, package in self.libraries
                          if self.users[package] > 2 or package in PREFERRED or package.startswith("libboost")]

    def module(self, package, name):
        """Returns the pkg-config module for a header of the package; "-" if it is unknown."""
        modules = sorted(self.modules[package], key=lambda module: (len(module), module))
        if len(modules) < 2:
            return modules[0] if modules else "-"
        parts = [part for part in re.sub(r"\.[a-z+]+$|/$|^qt5/|^\./", "", name).split("/") if part]
        core = re.sub(r"^lib|-?[0-9.]*-dev$", "", package)
        wanted = ["".join(parts[:2]), parts[0], core, core + "common", core + "core"]
        for shorten in characters, letters:
            for each in wanted:
                for module in modules:
                    same = shorten(each).removeprefix("lib"), shorten(each.replace("Qt", "Qt5"))
                    if shorten(module).removeprefix("lib") in same:
                        return module
        return next((module for module in modules if letters(module).startswith(letters(core))), "-")


def install(package, module):
    for pattern, meta, meta_module in META:
        if re.search(pattern, package):
            return re.sub(pattern, meta, package), meta_module or "-"
    return package, module


def split_root(path):
    """Returns the include folder below /usr/include and the name in an #include line."""
    found = re.fullmatch(r"(.+/include)/(.+)", path)
    if found:
        return found.groups()
    first, _, rest = path.partition("/")
    return (first, rest) if rest and (re.search(r"[-.][0-9]+$", first) or first in ROOTS) else ("", path)


def prefixes(name, root):
    """Returns the folders of a header, and for files like vtkRenderer.h in vtk-9.1 the prefix vtk*."""
    begin = letters(root.split("/")[-1])
    files = [begin + "*"] if len(begin) > 2 and name.startswith(begin) and "/" not in name else []
    return [name[:at + 1] for at, char in enumerate(name) if char == "/"] + files


def collapse(entries):
    """Replaces the names with a prefix by the prefix with the value that most of them have; the reader of the table uses the
    longest match. entries: {name: (package, module, root)}"""
    values = collections.defaultdict(collections.Counter)
    for name, value in entries.items():
        for prefix in prefixes(name, value[2]):
            values[prefix][value] += 1
    table = {}
    for prefix, counts in values.items():
        value, count = counts.most_common(1)[0]
        if 2 * count > counts.total() and (count > 20 or prefix.endswith("/")):
            table[prefix] = value
    for name, value in entries.items():
        longest = next((each for each in reversed(prefixes(name, value[2])) if each in table), None)
        if longest is None or table[longest] != value:
            table[name] = value
    # A folder within a folder of the same value says nothing.
    outer = lambda name: next((f for f in reversed(prefixes(name[:-1], "")) if f in table), None)
    return {name: value for name, value in table.items() if not name.endswith("/") or table.get(outer(name)) != value}


def add_boost(index, table):
    """Adds the headers of those parts of Boost that have a library: they are in the package of all headers."""
    for library, package in index.libraries:
        if package.startswith("libboost") and (part := re.fullmatch(r"boost_(\w+)", library)):
            for name in (f"boost/{part[1]}/", f"boost/{part[1]}.hpp"):
                table[name] = (*install(package, "-"), ".")


def library_table(index):
    """Returns {name after -l: package}."""
    packages = collections.defaultdict(set)
    for library, package in index.libraries:
        packages[library].add(package)
    return {name: install(min(found, key=index.rank), "-")[0] for name, found in packages.items()}


def best(places, index):
    """Returns the (package, folder) to take of those with a header."""
    return min(places, key=lambda place: (index.rank(place[0]), place[1]))


class FileNames:
    """Knows which names say enough without a folder: vtkRenderer.h does, config.h and vector.h do not."""

    def __init__(self, index):
        self.index, self.packages = index, collections.defaultdict(set)
        for path, package in index.headers:
            self.packages[path.rpartition("/")[2]].add(package)

    def is_distinctive(self, file, package):
        others = len(self.packages[file])
        return package in PREFERRED or self.index.users[package] >= (1 if others < 4 else 5 * others)

    def is_unique(self, file, package):
        return len(self.packages[file]) == 1 and (self.index.users[package] > 8 or package in PREFERRED)


def folderless_names(index, names):
    """Returns {file name: places} of headers that are also included without their folder, such as <frames.hpp> for kdl/."""
    places = collections.defaultdict(set)
    for path, package in index.headers:
        root, name = split_root(path)
        folder, _, file = name.rpartition("/")
        if folder and "/" not in folder and not root and index.modules[package] and names.is_unique(file, package):
            places[file].add((package, folder))
    return places


def header_table(index):
    """Returns {name in an #include line: (package, module, folder below /usr/include)}."""
    found, names = collections.defaultdict(set), FileNames(index)
    for path, package in index.headers:
        root, name = split_root(path)
        if "/" in name or names.is_distinctive(name, package):
            found[name].add((package, root or "."))
        if root and not root.endswith("/include"):
            found[path].add((package, "."))
        if root == "qt5" and "." not in name:
            found[name.rpartition("/")[2]].add((package, f"{root}/{name.rpartition('/')[0]}"))
    table = {}
    for name, places in found.items():
        package, root = best(places, index)
        table[name] = (*install(package, index.module(package, name if "/" in name else f"{root}/{name}")), root)
    add_boost(index, table)
    table = {**collapse(table), **LINKS}
    for name, places in folderless_names(index, names).items():
        package, folder = best(places, index)
        table.setdefault(name, (*install(package, index.module(package, f"{folder}/{name}")), "~" + folder))
    return table


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--suite", default="bookworm")
    parser.add_argument("--cache", type=pathlib.Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = (arguments.cache or pathlib.Path(temporary)).absolute()
        fetch(folder, arguments.suite)
        index = Index(folder)
    index.drop_unused()
    table = header_table(index)
    print(f"# Made by write_table.py from the Contents index of Debian {arguments.suite}. See README.md.")
    groups = collections.defaultdict(list)
    for name, value in table.items():
        if " " not in name:
            groups[value].append(name)
    for name, package in library_table(index).items():
        groups[package, "-", "-l"].append(name)
    for value in sorted(groups):
        print(*value, *sorted(groups[value]))


if __name__ == "__main__":
    main()
