#!/usr/bin/env python3
"""Which files vtm reads and writes: names, contents, "-", and what it refuses to overwrite. files_test.py VTM"""
import gzip
import os
import subprocess

from PIL import Image

from support import SQUARE, Command, main


class Suffixes(Command):
    def test_others_than_ours_are_bad_usage(self):
        self.vtm("render", self.svg, "-o", "a.png")
        for arguments in (("render", self.svg, "-o", "x.gif"), ("compile", self.svg, "-o", "x.png"),
                          ("render", self.svg, "-o", "x.png.bak"), ("render", self.svg, "-o", "x."),
                          ("diff", "a.png", "a.png", "-o", "x.jpg"), ("trace", "a.png", "-o", "x.png"),
                          ("normalize", self.svg, "-o", "x.svgz")):
            with self.subTest(arguments=arguments):
                before = self.names()
                self.assertIn("x.", self.vtm(*arguments, expect=2).stderr)
                self.assertEqual(self.names(), before)
        batch = self.write("list.tsv", f"{self.svg}\tb.png\n{self.svg}\tb.gif\n")
        self.assertIn("b.gif", self.vtm("render", "--batch", batch, expect=2).stderr)
        self.assertFalse((self.folder / "b.png").exists())

    def test_empty_names_are_errors(self):
        for arguments, code in ((("render", self.svg, "-o", ""), 2), (("compile", self.svg, "-o", ""), 2),
                                (("info", ""), 1)):
            self.assertNotIn("filesystem error", self.vtm(*arguments, expect=code).stderr)

    def test_upper_case_and_none_are_taken(self):
        for name in ("a.PNG", "picture"):
            self.vtm("render", self.svg, "-o", name)
            self.assert_square(name)

    def test_a_pipes_name_says_nothing(self):
        os.mkfifo(self.folder / "pipe.jpg")
        reader = subprocess.Popen(["cat", "pipe.jpg"], cwd=self.folder, stdout=subprocess.PIPE)
        self.vtm("render", self.svg, "-o", "pipe.jpg")
        self.assertTrue(reader.communicate(timeout=60)[0].startswith(b"\x89PNG"))


class Contents(Command):
    def test_a_vtm_file_is_known_by_its_first_bytes(self):
        self.vtm("compile", self.svg, "-o", "square.vtm")
        for name in ("square.dat", "square.svg", "square"):
            (self.folder / name).write_bytes((self.folder / "square.vtm").read_bytes())
            self.vtm("render", name, "-o", "out.png")
            self.assert_square("out.png")
            self.assertIn("sections", self.json("info", name))

    def test_svg_is_known_by_its_first_bytes(self):
        self.write("square.vtm", SQUARE)
        self.write("marked.bin", "\ufeff  \n" + SQUARE)
        (self.folder / "packed.vtm").write_bytes(gzip.compress(SQUARE.encode()))
        (self.folder / "wide.vtm").write_bytes(SQUARE.encode("utf-16"))
        for name in ("square.vtm", "marked.bin", "packed.vtm", "wide.vtm"):
            with self.subTest(name=name):
                self.vtm("render", name, "-o", "out.png")
                self.assert_square("out.png")
                self.assertNotIn("sections", self.json("info", name))

    def test_what_is_neither_is_what_its_name_says(self):
        self.write("noise.vtm", "noise")
        self.write("noise.svg", "noise")
        self.assertIn("noise.vtm: offset", self.vtm("render", "noise.vtm", "-o", "o.png", expect=1).stderr)
        self.assertRegex(self.vtm("render", "noise.svg", "-o", "o.png", expect=1).stderr, r"noise\.svg:\d+:\d+: ")

    def test_a_vtm_file_that_was_sent_as_text_is_no_svg(self):
        self.vtm("compile", self.svg, "-o", "square.vtm")
        bytes_ = (self.folder / "square.vtm").read_bytes().replace(b"\r\n", b"\n")
        (self.folder / "sent").write_bytes(bytes_)
        self.assertIn("not a .vtm file", self.vtm("render", "sent", "-o", "o.png", expect=1).stderr)

    def test_devices_without_end_are_an_error(self):
        self.skip_with_sanitizers()
        self.assertIn("is longer than", self.vtm("info", "/dev/zero", expect=1).stderr)


class StandardStreams(Command):
    def piped(self, *arguments, given=SQUARE.encode(), expect=0):
        done = self.vtm(*arguments, expect=expect, input=given, text=False)
        return done.stdout, done.stderr.decode()

    def test_a_picture_from_and_to_a_pipe(self):
        picture, said = self.piped("render", "-", "-o", "-")
        (self.folder / "out.png").write_bytes(picture)
        self.assert_square("out.png")
        self.assertEqual(said, "")

    def test_a_compiled_one(self):
        asset, _ = self.piped("compile", "-", "-o", "-")
        self.assertTrue(asset.startswith(b"VTM"))
        self.piped("render", "-", "-o", "out.png", given=asset)
        self.assert_square("out.png")
        report, _ = self.piped("info", "-", "--json", given=asset)
        self.assertIn(b'"input": "-"', report)

    def test_dev_stdout_is_standard_output(self):
        done = self.shell('printf before > o; "$0" render square.svg -o /dev/stdout >> o; head -c 6 o')
        self.assertEqual(done.stdout, "before")

    def test_differences(self):
        self.vtm("render", self.svg, "-o", "a.png")
        figures, _ = self.piped("diff", "-", "a.png", given=(self.folder / "a.png").read_bytes())
        self.assertIn(b"max: 0.00", figures)

    def test_messages_go_to_standard_error_and_name_the_stream(self):
        out, said = self.piped("render", "-", "-o", "-", given=SQUARE.replace("<rect", "<use/><rect", 1).encode())
        self.assertTrue(out.startswith(b"\x89PNG"))
        self.assertRegex(said, r"^<stdin>:2:\d+: warning: <use>: refers to nothing\n$")
        out, said = self.piped("render", "-", "-o", "-", given=b"", expect=1)
        self.assertEqual(out, b"")
        self.assertRegex(said, r"^<stdin>:1:1: ")

    def test_references_start_in_the_current_folder(self):
        Image.new("RGBA", (4, 4), (0, 0, 255, 255)).save(self.folder / "blue.png")
        _, said = self.piped("render", "-", "-o", "out.png", given=SQUARE.replace(
            "</svg>", '<image href="blue.png" width="40" height="20"/></svg>').encode())
        self.assertEqual(said, "")
        self.assertEqual(self.picture("out.png").getpixel((20, 10)), (0, 0, 255, 255))

    def test_lists(self):
        self.piped("render", "--batch", "-", given=b"square.svg\ta.png\n")
        self.assert_square("a.png")

    def test_into_a_directory(self):
        (self.folder / "pictures").mkdir()
        self.piped("render", "-", "-o", "pictures")
        self.assert_square("pictures/stdin.png")

    def test_what_cannot_be_told_apart_is_bad_usage(self):
        self.write("list.tsv", "-\ta.png\n-\tb.png\n")
        self.write("twice.tsv", f"{self.svg}\t-\n{self.svg}\t-\n")
        for arguments in (("render", "-", "-o", "-", "--json"), ("compile", "-", "-o", "-", "--json"),
                          ("render", "--batch", "list.tsv"), ("render", "--batch", "twice.tsv"),
                          ("render", self.svg, self.svg, "-o", "-"), ("diff", "a.png", "b.png", "-o", "-")):
            with self.subTest(arguments=arguments):
                self.assertEqual(self.piped(*arguments, expect=2)[0], b"")

    def test_a_terminal_gets_no_picture(self):
        leader, terminal = os.openpty()
        try:
            done = self.run_vtm("render", self.svg, "-o", "-", stdout=terminal)
        finally:
            os.close(leader)
            os.close(terminal)
        self.assertEqual(done.returncode, 2)
        self.assertIn("terminal", done.stderr)


class Overwriting(Command):
    def refused(self, *arguments, intact):
        before = intact.read_bytes()
        self.assertIn("overwritten", self.vtm(*arguments, expect=2).stderr)
        self.assertEqual(intact.read_bytes(), before)

    def test_the_input_is_not_the_output(self):
        picture = self.write("picture.png", SQUARE)
        (self.folder / "folder").mkdir()
        (self.folder / "folder" / "link.png").symlink_to("../picture.png")
        os.link(picture, self.folder / "hard.png")
        for output in ("picture.png", "./picture.png", picture, "folder/../picture.png", "folder/link.png", "hard.png"):
            with self.subTest(output=output):
                self.refused("render", "picture.png", "-o", output, intact=picture)
        self.refused("render", "folder/link.png", "-o", "picture.png", intact=picture)
        self.refused("render", "picture.png", "-o", ".", intact=picture)

    def test_by_other_commands(self):
        asset = self.write("a.vtm", SQUARE)
        self.refused("compile", "a.vtm", "-o", "a.vtm", intact=asset)
        self.vtm("render", self.svg, "-o", "a.png")
        self.refused("diff", "a.png", "a.png", "-o", "a.png", intact=self.folder / "a.png")
        Image.new("RGBA", (4, 4)).save(self.folder / "picture.vtm", format="png")
        if "potrace" not in self.run_vtm("trace", "a.png", "-o", "traced.svg").stderr:
            self.refused("trace", "picture.vtm", "-o", "picture.vtm", intact=self.folder / "picture.vtm")

    def test_standard_streams(self):
        for script in ('"$0" compile - -o a.vtm < a.vtm', '"$0" render a.vtm -o - >> a.vtm'):
            self.write("a.vtm", SQUARE)
            self.assertIn("overwritten", self.shell(script, expect=2).stderr)
            self.assertEqual((self.folder / "a.vtm").read_text(), SQUARE)

    def test_any_of_a_batch(self):
        second = self.write("second.png", SQUARE)
        batch = self.write("list.tsv", f"{self.svg}\tsecond.png\n{second}\tc.png\n")
        self.refused("render", "--batch", batch, intact=second)
        self.assertFalse((self.folder / "c.png").exists())
        list_ = self.write("list.png", f"{self.svg}\tlist.png\n")
        self.refused("render", "--batch", list_, intact=list_)

    def test_two_results_in_one_file(self):
        (self.folder / "there.png").symlink_to("late.png")
        (self.folder / "late.png").touch()
        for outputs in (("b.png", "./b.png"), ("there.png", "late.png")):
            batch = self.write("list.tsv", "".join(f"{self.svg}\t{output}\n" for output in outputs))
            self.assertIn("more than one", self.vtm("render", "--batch", batch, expect=2).stderr)
        batch = self.write("list.tsv", f"{self.svg}\t/dev/null\n" * 2)
        self.vtm("render", "--batch", batch)


if __name__ == "__main__":
    main()
