#!/usr/bin/env python3
"""Uses VTM as its users do: in folders of its own, through public doors alone.

check.py WAY BUILD SOURCE FOLDER: BUILD is a finished build of SOURCE; all is written below FOLDER. WAY is one of
  install          cmake --install into FOLDER/prefix, what the others use; the command, its pages
  find_package     consumer/ against the prefix, by CMake
  pkg_config       the same by pkg-config alone
  add_subdirectory the same with SOURCE as a part of its own build
  fetch_content    the same through FetchContent
  debian           cpack; the packages, unpacked, are a prefix; lintian has no errors
  python           the Python module of the prefix
  c_examples       examples/openvg/c, outside of the tree: its Makefile, and what the programs draw
  readme           README.md's code compiles against the prefix
  exports          the libraries export what public headers declare
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

SKIPPED = 77
# Folders that somebody else's build must not compile anything of.
NOT_THE_LIBRARY = re.compile(r"vtm/(tests|conformance|tools|bench|examples|trace)/|/tests/")


def run(*command, **options):
    """Its output; shows what was said by a command that fails, and ends."""
    environment = {**os.environ, **options.pop("env", {})}
    environment.pop("LD_LIBRARY_PATH", None)
    environment.pop("DESTDIR", None)
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, env=environment, check=False,
                          **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout[-8000:]}{done.stderr[-8000:]}")
    return done.stdout


def require(holds, message):
    if not holds:
        sys.exit(message)


class Check:
    def __init__(self, build, source, folder):
        self.build, self.source, self.folder = map(pathlib.Path, (build, source, folder))
        self.prefix = self.folder / "prefix"
        self.consumer = pathlib.Path(__file__).parent / "consumer"
        self.picture = self.source / "examples" / "planet.svg"

    def fresh(self, name):
        shutil.rmtree(self.folder / name, ignore_errors=True)
        (self.folder / name).mkdir(parents=True)
        return self.folder / name

    def cached(self, variable):
        """A variable of the build's."""
        found = re.search(rf"^{variable}:\w+=(.*)$", (self.build / "CMakeCache.txt").read_text(), re.M)
        return found[1] if found else ""

    # ---- Ways ---------------------------------------------------------------------------------------

    def install(self):
        self.fresh("prefix")
        run("cmake", "--install", self.build, "--prefix", self.prefix)
        vtm = self.prefix / "bin" / "vtm"
        require(run(vtm, "--version").startswith("vtm "), "the installed command does not say its version")
        run(vtm, "render", self.picture, "-o", self.folder / "by_command.png", "--width", "80", "--engine", "cpu")
        for header in (self.prefix / "include").rglob("*.hpp"):
            require(header.is_relative_to(self.prefix / "include" / "vtm"), f"{header} is outside of vtm/")
        if shutil.which("man"):
            page = run("man", "--warnings", "-l", self.prefix / "share" / "man" / "man1" / "vtm.1.gz")
            require("--background" in page, "the man page lacks an option")
        completed = run("bash", "-c", 'source "$0"; COMP_WORDS=(vtm render --max-s); COMP_CWORD=2; _vtm; '
                        'echo "${COMPREPLY[@]}"', self.prefix / "share" / "bash-completion" / "completions" / "vtm")
        require(completed.strip() == "--max-seconds", f"bash completes --max-s as {completed!r}")

    def find_package(self):
        self.build_consumer("find_package", self.prefix)

    def pkg_config(self):
        folder = self.fresh("pkg_config")
        environment = {"PKG_CONFIG_LIBDIR": str(self.prefix / "lib" / "pkgconfig")}
        for name, compiler, package, standard in (("draw.cpp", "c++", "vtm", "c++20"), ("draw.c", "cc", "vtm", "c99"),
                                                  ("draw_vg.c", "cc", "vtm-openvg", "c99")):
            flags = run("pkg-config", "--cflags", "--libs", package, env=environment).split()
            program = folder / name.replace(".", "_")
            run(compiler, f"-std={standard}", "-Wall", "-Wextra", "-Werror", self.consumer / name, "-o", program, *flags,
                f"-Wl,-rpath,{self.prefix / 'lib'}")
            run(program, *([self.picture, folder / f"{name}.png"] if package == "vtm" else []))
        self.same(folder / "draw.cpp.png", folder / "draw.c.png")

    def add_subdirectory(self):
        self.build_part("add_subdirectory")

    def fetch_content(self):
        self.build_part("fetch_content")

    def debian(self):
        if not shutil.which("dpkg-shlibdeps"):
            sys.exit(SKIPPED)
        folder = self.fresh("debian")
        run("cpack", "-G", "DEB", "-B", folder / "packages", cwd=self.build)
        packages = sorted((folder / "packages").glob("*.deb"))
        names = {package.name.split("_")[0] for package in packages}
        wanted = {"libvtm0", "libvtm-dev", "libvtm-gl0", "libvtm-openvg0", "vtm-tools", "python3-vtm"}
        require(names == wanted, f"the packages are {sorted(names)}")
        for package in packages:
            run("dpkg", "-x", package, folder / "root")
        require(run(folder / "root/usr/bin/vtm", "--version").startswith("vtm "), "the packaged command does not start")
        self.build_consumer("debian", folder / "root" / "usr")
        if shutil.which("lintian"):
            run("lintian", "--fail-on", "error", "--allow-root", *packages)

    def python(self):
        module = self.prefix / "lib" / "python3" / "dist-packages"
        output = self.fresh("python") / "drawn.png"
        run(sys.executable, pathlib.Path(__file__).parent / "use_module.py", self.picture, output,
            env={"PYTHONPATH": str(module), "PYTHONDONTWRITEBYTECODE": "1"})
        self.same(output, self.folder / "by_command.png")

    # ---- Parts --------------------------------------------------------------------------------------

    def configure(self, name, *options):
        build = self.fresh(name)
        run("cmake", "-S", self.consumer, "-B", build, "-G", "Ninja", *options)
        return build

    def configure_part(self, way):
        """VTM as a part of the consumer's build, which must compile nothing but the library. With the flags of the
        finished build and its launcher a compiler cache knows the objects; without one nothing is optimised, which
        takes half the time."""
        kind = self.cached("CMAKE_BUILD_TYPE") if self.cached("CMAKE_CXX_COMPILER_LAUNCHER") else "Debug"
        build = self.configure(way, f"-DVTM_FROM={way}", f"-DVTM_SOURCE={self.source}", f"-DCMAKE_BUILD_TYPE={kind}",
                               *(f"-D{name}={self.cached(name)}" for name in
                                 ("CMAKE_CXX_FLAGS", "CMAKE_CXX_FLAGS_RELWITHDEBINFO",
                                  "CMAKE_CXX_COMPILER", "CMAKE_CXX_COMPILER_LAUNCHER", "VTM_WERROR")))
        steps = run("cmake", "--build", build, "--", "-n")
        require("compiler/" in steps, "the consumer's build does not compile the library")
        strange = [line for line in steps.splitlines() if NOT_THE_LIBRARY.search(line.replace(str(self.source), ""))]
        require(not strange, "the consumer's build compiles more than the library:\n" + "\n".join(strange[:10]))
        return build

    def build_part(self, way):
        build = self.configure_part(way)
        run("cmake", "--build", build, "--parallel", os.environ.get("VTM_PACKAGING_JOBS", "2"))
        self.run_consumer(build)

    def build_consumer(self, name, prefix):
        """By find_package."""
        build = self.configure(f"{name}_build", "-DVTM_FROM=find_package", "-DVTM_COMPONENTS=gl;openvg", f"-DCMAKE_PREFIX_PATH={prefix}",
                               "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF")
        found = re.search(r"^vtm_DIR:\w+=(.*)$", (build / "CMakeCache.txt").read_text(), re.M)[1]
        require(pathlib.Path(found).is_relative_to(prefix), f"found {found} instead of the one in {prefix}")
        run("cmake", "--build", build)
        self.run_consumer(build)
        run(build / "draw_vg")
        drawn = subprocess.run([build / "draw_gl", self.picture, build / "gl.png"], check=False)
        require(drawn.returncode in (0, SKIPPED), "draw_gl fails")

    def run_consumer(self, build):
        run(build / "draw", self.picture, build / "cpp.png")
        run(build / "draw_c", self.picture, build / "c.png")
        self.same(build / "cpp.png", build / "c.png")

    def same(self, one, other):
        require(one.read_bytes() == other.read_bytes(), f"{one} and {other} differ")


def main():
    sys.path.insert(0, str(pathlib.Path(__file__).parent))
    way, *places = sys.argv[1:]
    check = Check(*places)
    if way == "c_examples":
        import c_examples
        c_examples.check(check)
    elif way == "readme":
        import readme
        readme.check(check)
    elif way == "exports":
        import exports
        exports.check(check)
    else:
        getattr(check, way)()


if __name__ == "__main__":
    main()
