#!/usr/bin/env python3
"""Texts of VTMs as inputs and outputs of the command. tree_test.py VTM"""
import pathlib

from support import RED, SQUARE, SQUARE_COLOURS, Command, main

EXAMPLE = pathlib.Path(__file__).parents[2] / "examples/sign.vtmtree"
SQUARE_TREE = """vtmtree 1
size 40 20
draw {
    select rect(0 0, 20 20) red
    select rect(20 0, 30 20) blue opacity 0.4
}
"""


class Trees(Command):
    def setUp(self):
        super().setUp()
        self.tree = self.write("square.vtmtree", SQUARE_TREE)

    def test_is_compiled_and_drawn(self):
        self.vtm("compile", self.tree, "-o", "a.vtm")
        for number, source in enumerate(["a.vtm", self.tree]):
            self.vtm("render", source, "-o", f"{number}.png")
            self.assert_square(f"{number}.png")
        self.assertEqual(self.json("info", EXAMPLE)["width"], 64)

    def test_the_contents_decide_and_not_the_name(self):
        self.write("a.svg", SQUARE_TREE)
        self.write("b.vtmtree", SQUARE)
        for name in ("a.svg", "b.vtmtree"):
            self.vtm("render", name, "-o", "a.png")
            self.assert_square("a.png")
        self.vtm("render", "-", "-o", "b.png", input=SQUARE_TREE)
        self.assert_square("b.png")

    def test_messages_name_line_and_column(self):
        self.write("bad.vtmtree", SQUARE_TREE.replace("red", "rod"))
        for arguments in (("compile", "bad.vtmtree", "-o", "a.vtm"), ("render", "bad.vtmtree", "-o", "a.png")):
            done = self.vtm(*arguments, expect=1)
            self.assertEqual(done.stderr, "bad.vtmtree:4:29: expected a VTM; 'rod' is not defined above\n")
        self.write("empty.vtmtree", "")
        done = self.vtm("compile", "empty.vtmtree", "-o", "a.vtm", expect=1)
        self.assertEqual(done.stderr, "empty.vtmtree:1:1: expected 'vtmtree', found the end of the file\n")
        self.assertNotIn("a.vtm", self.names())

    def test_images_lie_beside_the_file(self):
        self.vtm("render", self.svg, "-o", "square.png")
        self.write("image.vtmtree", 'vtmtree 1 size 40 20 draw image "square.png" nearest')
        self.vtm("render", "image.vtmtree", "-o", "a.png")
        self.assert_square("a.png")

    def test_normalize_writes_them(self):
        self.vtm("normalize", self.svg, "-o", "a.vtmtree")
        self.vtm("render", "a.vtmtree", "-o", "a.png")
        self.assert_square("a.png")
        self.vtm("normalize", "a.vtmtree", "-o", "b.vtmtree")
        self.assertEqual((self.folder / "a.vtmtree").read_text(), (self.folder / "b.vtmtree").read_text())
        self.vtm("normalize", "a.vtmtree", "-o", "a.svg")
        self.vtm("render", "a.svg", "-o", "c.png")
        self.assert_square("c.png")

    def test_one_element_as_a_tree(self):
        self.write("named.svg", SQUARE.replace("<rect x", '<rect id="blue" x'))
        self.vtm("normalize", "named.svg", "-o", "a.vtmtree", "--export-id", "blue")
        self.vtm("render", "a.vtmtree", "-o", "a.png")
        image = self.picture("a.png")
        self.assertEqual((image.size, image.getpixel((5, 10))), ((10, 20), SQUARE_COLOURS[1]))

    def test_options_for_svg_are_refused(self):
        done = self.vtm("render", self.tree, "-o", "a.png", "--export-id", "a", expect=1)
        self.assertIn("is a .vtmtree file; --export-id and --stylesheet need an SVG file", done.stderr)

    def test_paper_mode_draws_them(self):
        self.vtm("render", self.tree, "-o", "a.png", "--mode", "paper", "--engine", "asset")
        self.assertEqual(self.picture("a.png").getpixel((5, 10)), RED)


if __name__ == "__main__":
    main()
