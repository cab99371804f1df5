#!/usr/bin/env python3
"""WebGL 2 compiles and runs every program of the library, as it is. programs_test.py EXPORT_PROGRAMS"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import browser

# What a program needs to be drawn, by what it declares: textures of the right kinds, a target of the type that it writes,
# attributes of the types that it reads. The numbers do not matter: a driver compiles when a program first draws.
SCRIPT = """
const [programs, draws] = arguments, failures = [];
const gl = window.gl ??= document.createElement('canvas').getContext('webgl2');  // one for all batches
gl.getExtension('EXT_color_buffer_float');
const parallel = gl.getExtension('KHR_parallel_shader_compile');
const stage = (type, text) => {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  return shader;
};
const compiling = programs.map(([name, vertex, fragment]) => {
  const program = gl.createProgram(), shaders = [stage(gl.VERTEX_SHADER, vertex), stage(gl.FRAGMENT_SHADER, fragment)];
  shaders.forEach((shader) => gl.attachShader(program, shader));
  gl.linkProgram(program);
  return {name, program, shaders, isInteger: /^out (uint|uvec4) /m.test(fragment)};
});
const texture = (unit, format, upload) => {
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, 4096, 16);
};
texture(0, gl.RGBA8);
texture(1, gl.RGBA32UI);
const target = (format) => {
  texture(2, format);
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, gl.getParameter(gl.TEXTURE_BINDING_2D), 0);
  return framebuffer;
};
const colors = target(gl.RGBA8), numbers = target(gl.R32UI);
gl.activeTexture(gl.TEXTURE2);
gl.bindTexture(gl.TEXTURE_2D, null);
gl.viewport(0, 0, 4, 4);

const prepare = (program) => {
  gl.useProgram(program);
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
    const {name, type} = gl.getActiveUniform(program, i), place = gl.getUniformLocation(program, name);
    if (type === gl.SAMPLER_2D || type === gl.UNSIGNED_INT_SAMPLER_2D)
      gl.uniform1i(place, type === gl.SAMPLER_2D ? 0 : 1);
  }
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_ATTRIBUTES); ++i) {
    const {name, type} = gl.getActiveAttrib(program, i), place = gl.getAttribLocation(program, name);
    if (place < 0)
      continue;  // built in
    if ([gl.UNSIGNED_INT, gl.UNSIGNED_INT_VEC2, gl.UNSIGNED_INT_VEC3, gl.UNSIGNED_INT_VEC4].includes(type))
      gl.vertexAttribI4ui(place, 0, 0, 0, 0);
    else if ([gl.INT, gl.INT_VEC2, gl.INT_VEC3, gl.INT_VEC4].includes(type))
      gl.vertexAttribI4i(place, 0, 0, 0, 0);
    else
      gl.vertexAttrib4f(place, 0, 0, 0, 1);
  }
};
const check = ({name, program, shaders, isInteger}, i) => {
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    failures.push([name, shaders.map((shader) => gl.getShaderInfoLog(shader)).join('') + gl.getProgramInfoLog(program)]);
    return;
  }
  if (draws[i]) {
    prepare(program);
    gl.bindFramebuffer(gl.FRAMEBUFFER, isInteger ? numbers : colors);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    isInteger ? gl.readPixels(0, 0, 1, 1, gl.RGBA_INTEGER, gl.UNSIGNED_INT, new Uint32Array(4))
              : gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    const error = gl.getError();
    if (error !== 0)
      failures.push([name, `drawing: error 0x${error.toString(16)}`]);
  }
};
compiling.forEach((made, i) => {
  check(made, i);
  made.shaders.forEach((shader) => gl.deleteShader(shader));
  gl.deleteProgram(made.program);
});
return [failures, gl.getParameter(gl.VERSION), parallel !== null];
"""
BATCH = 6


def by_kind(names):
    kinds = {}
    for name in names:
        kinds.setdefault(re.sub(r"^\d+_", "", name), []).append(name)
    return kinds.values()


def is_ours(name):
    """Not of paper mode, whose walks find no end in textures of zeros; it is compiled only."""
    return not name.endswith(("paper", "pattern"))


def drawn(names):
    """Of each kind the first, which has nothing, and the last, which has everything; all if asked for."""
    names = [name for name in names if is_ours(name)]
    if "VTM_TEST_ALL" in os.environ:
        return set(names)
    return {name for kind in by_kind(names) for name in (kind[0], kind[-1])}


def compiled(names):
    """Those that are drawn, and a sample of the others; all if asked for."""
    sample = 12
    if "VTM_TEST_ALL" in os.environ:
        return names
    return sorted(drawn(names).union(*(kind[::sample] for kind in by_kind(names))))


class Programs(unittest.TestCase):
    exporter = ""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        subprocess.run([cls.exporter, cls.folder], check=True)
        cls.names = sorted(path.stem for path in cls.folder.glob("*.frag"))
        (cls.folder / "empty.html").write_text("<!DOCTYPE html><title>programs</title>")
        cls.browser = browser.Browser(400, 300)
        cls.addClassCleanup(cls.browser.close)
        cls.browser.open(cls.folder / "empty.html")

    def text(self, name, stage):
        return (self.folder / f"{name}.{stage}").read_text()

    def test_every_program_compiles_and_draws(self):
        self.assertGreater(len(self.names), 400)
        names, draw, failures = compiled(self.names), drawn(self.names), []
        for i in range(0, len(names), BATCH):
            batch = names[i:i + BATCH]
            programs = [[name, self.text(name, "vert"), self.text(name, "frag")] for name in batch]
            failed, version, _ = self.browser.run(SCRIPT, programs, [name in draw for name in batch])
            self.assertIn("WebGL 2.0", version)
            failures += failed
        self.assertEqual(failures, [])
        self.assertEqual([line for line in self.browser.log() if "Performance" not in line], [])

    def test_what_webgl_refuses_is_found(self):
        vertex, fragment = self.text(self.names[0], "vert"), self.text(self.names[0], "frag")
        failed, _, _ = self.browser.run(SCRIPT, [["bad", vertex, fragment + "\nfloat f = 1;\n"]], [False])
        self.assertEqual(len(failed), 1)
        self.browser.log()

    def test_no_local_array_is_indexed_by_a_variable_but_stacks(self):
        """Some drivers keep such arrays in memory. The stacks of groups and of placed maps are the only ones."""
        stacks = {"stack", "levels", "innerPalettes", "innerGrounds"}
        for name in filter(is_ours, self.names):
            text = self.text(name, "frag")
            arrays = set(re.findall(r"^\s*(?:const )?(?:u?i?vec[234]|float|u?int|\w*Level) (?:vtm_)?(\w+)\[\w+\]", text, re.M))
            self.assertLessEqual(arrays - {"kernel", "weights"}, stacks, name)

    def test_every_loop_has_a_condition(self):
        for name in self.names:
            for stage in ("vert", "frag"):
                self.assertNotRegex(self.text(name, stage), r"while\s*\(\s*true|for\s*\([^;]*;\s*;", name)

    def translated(self, name, stage):
        """Through SPIR-V, which knows ES from 3.10 on, back to GLSL ES 3.00."""
        source, binary, back = (self.folder / f"translated{suffix}" for suffix in (f".{stage}", ".spv", f"_back.{stage}"))
        source.write_text(self.text(name, stage).replace("#version 300 es", "#version 310 es", 1))
        for command in (["glslangValidator", "-G", "--aml", "--amb", "-o", binary, source],
                        ["spirv-cross", "--es", "--version", "300", "--output", back, binary], ["glslangValidator", back]):
            done = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, f"{name}.{stage}: {done.stdout[:2000]}{done.stderr[:2000]}")

    def test_other_compilers_understand_every_kind(self):
        for program in ("glslangValidator", "spirv-cross"):
            if not shutil.which(program):
                self.skipTest(f"{program} is not installed")
        for name in compiled(self.names):
            for stage in ("vert", "frag"):
                self.translated(name, stage)

    def test_every_precision_is_highp(self):
        """GLES promises it for fragments (GLSL ES 3.00 section 4.5.4), and nothing relies on a default."""
        for name in self.names:
            text = self.text(name, "frag")
            for kind in ("float", "int"):
                self.assertIn(f"precision highp {kind};", text, name)
            self.assertNotRegex(text, r"\b(mediump|lowp)\b", name)


if __name__ == "__main__":
    Programs.exporter = os.path.abspath(sys.argv.pop(1))
    if not browser.is_installed():
        print("Chromium or its driver is not installed (chromium, chromium-driver)")
        sys.exit(77)
    unittest.main(module="__main__")
