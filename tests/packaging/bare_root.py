#!/usr/bin/env python3
"""Uses VTM in a Debian 12 root that holds nothing else. Needs to be root, debootstrap and the network.

bare_root.py packages FOLDER   installs FOLDER's Debian packages there; runs the command, the Python module and
                               the programs of consumer/, built by CMake and by pkg-config
bare_root.py render            clones this repository there; ./dev render draws a picture

The Debian mirror is $DEBIAN_MIRROR, http://deb.debian.org/debian unless it is set. Exit code 77: skipped.
"""
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

SKIPPED = 77
MIRROR = os.environ.get("DEBIAN_MIRROR", "http://deb.debian.org/debian")
HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
# What packages' users compile with.
COMPILERS = ["cmake", "g++", "make", "pkg-config"]


def fail(done):
    sys.exit(f"{' '.join(map(str, done.args))}: exit code {done.returncode}\n{done.stdout[-8000:]}")


def run(*command):
    """Its output; shows what was said by a command that fails, and ends."""
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    if done.returncode != 0:
        fail(done)
    return done.stdout


class Stage:
    """Says what a part of the work took: seconds, and CPU seconds of the programs that it ran."""

    def __init__(self, name):
        self.name = name

    def __enter__(self):
        self.started, self.cpu = time.monotonic(), self.cpu_seconds()

    def __exit__(self, kind, *_):
        if kind is None:
            print(f"{self.name}: {time.monotonic() - self.started:.0f} s, {self.cpu_seconds() - self.cpu:.0f} s of CPU",
                  flush=True)

    @staticmethod
    def cpu_seconds():
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime


class BareRoot:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        with Stage("debootstrap"):
            run("debootstrap", "--variant=minbase", "bookworm", self.folder, MIRROR)

    def run(self, *command):
        return run("chroot", self.folder, "/usr/bin/env", "-i", "PATH=/usr/sbin:/usr/bin:/sbin:/bin", "HOME=/root",
                   "LC_ALL=C.UTF-8", "DEBIAN_FRONTEND=noninteractive", *command)

    def install(self, *packages):
        self.run("apt-get", "install", "-y", "-qq", "--no-install-recommends", *packages)

    def downloads(self):
        """Megabytes that apt fetched: packages and their lists."""
        folders = self.folder / "var/cache/apt/archives", self.folder / "var/lib/apt/lists"
        return sum(file.stat().st_size for folder in folders for file in folder.glob("*") if file.is_file()) / 1e6

    def require_picture(self, path):
        data = (self.folder / path).read_bytes()
        if not data.startswith(b"\x89PNG"):
            sys.exit(f"{path} is no PNG file")
        return data


# ---- Packages ---------------------------------------------------------------------------------------


def check_packages(root, folder):
    packages = sorted(pathlib.Path(folder).glob("*.deb"))
    if not packages:
        sys.exit(f"{folder} contains no packages")
    for package in packages:
        shutil.copy(package, root.folder / "root")
        print(f"{package.name}: {package.stat().st_size / 1000:.0f} kB")
    shutil.copytree(HERE / "consumer", root.folder / "root/consumer")
    shutil.copy(SOURCE / "examples/planet.svg", root.folder / "root")
    shutil.copy(HERE / "use_module.py", root.folder / "root")
    with Stage("install what runs"):
        root.run("apt-get", "update", "-qq")
        root.install(*(f"/root/{package.name}" for package in packages if not package.name.startswith("libvtm-dev")))
    with Stage("use it"):
        check_command(root)
    with Stage("install libvtm-dev and a compiler"):
        root.install(*(f"/root/{package.name}" for package in packages), *COMPILERS)
    with Stage("build and run the consumers"):
        check_consumers(root)


def check_command(root):
    print(root.run("vtm", "--version").strip())
    root.run("vtm", "render", "/root/planet.svg", "-o", "/root/command.png", "--width", "80", "--engine", "cpu")
    root.run("vtm", "render", "/root/planet.svg", "-o", "/root/auto.png", "--width", "80")
    root.run("python3", "/root/use_module.py", "/root/planet.svg", "/root/python.png")
    same = {root.require_picture(f"root/{name}.png") for name in ("command", "python")}
    if len(same) != 1:
        sys.exit("command and Python module draw different pictures")


def check_consumers(root):
    root.run("cmake", "-S", "/root/consumer", "-B", "/root/build", "-DVTM_FROM=find_package",
             "-DVTM_COMPONENTS=gl;openvg")
    root.run("cmake", "--build", "/root/build")
    for name, compiler, package in (("draw.cpp", "c++ -std=c++20", "vtm"), ("draw.c", "cc -std=c99", "vtm"),
                                    ("draw_vg.c", "cc -std=c99", "vtm-openvg")):
        root.run("sh", "-ec", f"{compiler} /root/consumer/{name} -o /root/{name}.program "
                              f"$(pkg-config --cflags --libs {package})")
    drawn = set()
    for program in ("build/draw", "build/draw_c", "draw.cpp.program", "draw.c.program"):
        root.run(f"/root/{program}", "/root/planet.svg", "/root/drawn.png")
        drawn.add(root.require_picture("root/drawn.png"))
        (root.folder / "root/drawn.png").unlink()
    if len(drawn) != 1:
        sys.exit("the consumers draw different pictures")
    root.run("/root/build/draw_vg")
    # No driver is installed: the library says so, and draw_gl with exit code 77.
    root.run("sh", "-c", f"/root/build/draw_gl /root/planet.svg /root/gl.png; test $? -eq 0 -o $? -eq {SKIPPED}")


# ---- From a clone to the first picture ----------------------------------------------------------------


def check_render(root):
    run("git", "clone", "--quiet", "--no-hardlinks", SOURCE, root.folder / "root/vtm")
    root.run("apt-get", "clean")
    (before, packages) = root.downloads(), "var/cache/apt/archives"
    with Stage("./dev render"):
        said = root.run("/root/vtm/dev", "render", "/root/vtm/examples/planet.svg", "-o", "/root/first.png")
    root.require_picture("root/first.png")
    print(next((line for line in said.splitlines() if line.startswith("First, once")), "nothing was announced"))
    print(f"apt fetched {root.downloads() - before:.0f} MB into {packages} and its lists")


def missing():
    """What keeps this machine from making such a root; empty if nothing does."""
    if os.geteuid() != 0:
        return "this needs root"
    if not shutil.which("debootstrap", path=os.environ.get("PATH", "") + ":/usr/sbin"):
        return "debootstrap is absent"
    try:
        urllib.request.urlopen(f"{MIRROR}/dists/bookworm/InRelease", timeout=20).close()
    except (urllib.error.URLError, OSError) as error:
        return f"{MIRROR}: {error}"
    return ""


def main(arguments):
    if arguments[:1] not in (["packages"], ["render"]) or len(arguments) != (2 if arguments[0] == "packages" else 1):
        sys.exit(__doc__)
    reason = missing()
    if reason:
        print(f"bare_root: skipped: {reason}")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(prefix="vtm_bare_root_") as folder:
        root = BareRoot(folder)
        if arguments[0] == "packages":
            check_packages(root, arguments[1])
        else:
            check_render(root)


if __name__ == "__main__":
    main(sys.argv[1:])
