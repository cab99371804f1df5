#!/usr/bin/env python3
"""What a page does when it is used. page_test.py VTM"""
import re
import shutil
import subprocess

from PIL import Image

from support import Pages, main

ITEMS = """<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="200" height="100">
  <rect width="100" height="100" fill="#ff0000"
        id="left"/>
  <g transform="translate(100)"><circle id='disc' cx="50" cy="50" r="40" fill="#0000ff" stroke="#00ff00" stroke-width="10"/></g>
</svg>
"""
RED, BLUE, GREEN, NOTHING = (255, 0, 0, 255), (0, 0, 255, 255), (0, 255, 0, 255), (0, 0, 0, 0)


class Page(Pages):
    def setUp(self):
        super().setUp()
        self.items = self.write("items.svg", ITEMS)

    def tearDown(self):
        self.assert_quiet()

    def window_place(self, x, y):
        """A point of the picture, in the window; the view is not tilted."""
        state, (left, top, width, height) = self.state(), self.stage()
        return left + width / 2 + (x - state["x"]) * state["scale"], top + height / 2 + (y - state["y"]) * state["scale"]

    def pixel(self, x, y):
        left, top, _, _ = self.stage()
        px, py = self.window_place(x, y)
        return tuple(self.pixels()[int(py - top), int(px - left)])

    # ---- Moving ------------------------------------------------------------------------------------

    def test_fits_at_first(self):
        self.open(self.page(self.items))
        state, (_, _, width, _) = self.state(), self.stage()
        self.assertEqual((state["x"], state["y"]), (100, 50))
        self.assertAlmostEqual(state["scale"] * 200, 0.94 * width, delta=0.01)
        self.assertEqual([self.pixel(*at) for at in ((50, 50), (150, 50), (150, 11), (199, 1))], [RED, BLUE, GREEN, NOTHING])

    def test_wheel_zooms_at_the_pointer(self):
        self.open(self.page(self.items))
        at = self.window_place(20, 30)
        before = self.state()["scale"]
        self.do(self.browser.wheel, *at, -400)
        self.assertGreater(self.state()["scale"], before * 1.5)
        # Pointers come in whole pixels.
        for mine, wanted in zip(self.window_place(20, 30), at):
            self.assertAlmostEqual(mine, wanted, delta=1.5)

    def test_drag_moves(self):
        self.open(self.page(self.items), "scale=2")
        x, y = self.window_place(100, 50)
        self.do(self.browser.pointer, ("pointerMove", (x, y)), ("pointerDown", None), ("pointerMove", (x + 60, y + 20)),
                ("pointerUp", None))
        state = self.state()
        self.assertAlmostEqual(state["x"], 70, delta=0.1)
        self.assertAlmostEqual(state["y"], 40, delta=0.1)

    def test_pinch_zooms(self):
        self.browser.resize(390, 700, mobile=True)
        self.open(self.page(self.items))
        before = self.state()["scale"]
        left, top, width, height = self.stage()
        x, y = left + width / 2, top + height / 2

        def touch(kind, *places):
            self.browser.command("Input.dispatchTouchEvent",
                                 {"type": kind, "touchPoints": [{"x": px, "y": py, "id": i} for i, (px, py) in enumerate(places)]})

        def pinch():
            touch("touchStart", (x - 30, y), (x + 30, y))
            for reach in (40, 60, 90):
                touch("touchMove", (x - reach, y), (x + reach, y))
            touch("touchEnd")
        self.do(pinch)
        self.assertAlmostEqual(self.state()["scale"] / before, 3, delta=0.2)

    def test_zoom_ends_at_the_finest_pixel(self):
        self.open(self.page(self.items))
        self.assertTrue(self.browser.run("return document.getElementById('finest').hidden"))
        self.do(self.browser.keys, "f")
        finest = self.browser.run("return JSON.parse(document.getElementById('manifest').textContent).finestPixel")
        self.assertAlmostEqual(self.state()["scale"] * finest, 1, delta=1e-6)
        self.assertFalse(self.browser.run("return document.getElementById('finest').hidden"))
        self.assertIn("Finest pixel", self.browser.text("#notice"))
        self.do(self.browser.keys, "+")
        self.assertAlmostEqual(self.state()["scale"] * finest, 1, delta=1e-6)

    def test_keys(self):
        self.open(self.page(self.items))
        start = self.state()
        for keys, name, sign in (("\ue014", "x", 1), ("\ue012", "x", -1), ("\ue015", "y", 1), ("\ue013", "y", -1),
                                 ("+", "scale", 1), ("-", "scale", -1), ("r", "rotate", 1), ("t", "tilt", 1)):
            with self.subTest(key=keys):
                before = self.state()[name]
                self.do(self.browser.keys, keys)
                self.assertGreater(sign * (self.state()[name] - before), 0)
        self.do(self.browser.keys, "0")
        self.assertEqual(self.state(), start)
        self.do(self.browser.keys, "1")
        self.assertEqual(self.state()["scale"], 1)

    def test_tilt_shows_the_plane_in_perspective(self):
        self.open(self.page(self.items), "scale=2")
        flat = self.pixels()[..., 3] > 0
        self.do(self.browser.click, "#tilt")
        tilted = self.pixels()[..., 3] > 0
        self.assertLess(tilted.any(axis=1).sum(), flat.any(axis=1).sum())  # lower
        rows = tilted.sum(axis=1)[tilted.any(axis=1)]
        self.assertGreater(rows[-5], rows[5] * 1.05)  # wider in front
        self.do(self.browser.click, "#tilt")
        self.assertTrue((flat == (self.pixels()[..., 3] > 0)).all())

    def test_help_opens_and_closes(self):
        self.open(self.page(self.items))
        self.browser.keys("?")
        self.assertTrue(self.browser.run("return document.getElementById('help').open"))
        self.browser.keys("\ue00c")
        self.assertFalse(self.browser.run("return document.getElementById('help').open"))

    def test_nothing_is_drawn_while_nothing_changes(self):
        self.open(self.page(self.items))
        frame = self.frame()
        self.browser.run("return new Promise((resolve) => setTimeout(resolve, 600))")
        self.assertEqual(self.frame(), frame)

    # ---- Views -------------------------------------------------------------------------------------

    def test_debug_views(self):
        self.open(self.page(self.items))
        names = self.browser.run("return [...document.getElementById('view').options].map((option) => option.value)")
        self.assertEqual(names, ["picture", "cells", "depth", "pieces", "cost", "regions"])
        seen = {self.pixels().tobytes()}
        for name in names[1:]:
            self.do(self.browser.keys, "v")
            self.assertEqual(self.state()["view"], name)
            seen.add(self.pixels().tobytes())
            self.assertEqual(self.browser.run("return document.getElementById('legend').hidden"), name == "regions")
        self.assertEqual(len(seen), len(names))
        self.do(self.browser.keys, "v")
        self.assertIn(self.pixels().tobytes(), seen)

    def test_views_are_those_of_render(self):
        asset = self.folder / "items.vtm"
        self.vtm("compile", self.items, "-o", asset)
        for name in ("depth", "pieces", "cost", "regions"):
            with self.subTest(view=name):
                self.open(self.page(asset), f"view={name}&scale=2")
                mine, wanted = self.pixels(), self.rendered(asset, "--debug-view", name, "--zoom", 2, "--engine", "asset")
                top, left = (mine.shape[0] - 200) // 2, (mine.shape[1] - 400) // 2
                self.assertLessEqual(abs(mine[top:top + 200, left:left + 400] - wanted).max(), 1)

    def test_split_shows_the_browsers_drawing(self):
        self.open(self.page(self.items))
        whole = self.pixels()
        self.do(self.browser.keys, "s")
        self.browser.run("return document.getElementById('browser-image').decode()")
        self.assertEqual(self.state()["split"], 0.5)
        half = self.pixels()
        middle = half.shape[1] // 2
        self.assertEqual((half[:, middle:] != 0).sum(), 0)
        self.assertTrue((half[:, :middle] == whole[:, :middle]).all())
        self.browser.screenshot(self.folder / "split.png")
        with Image.open(self.folder / "split.png") as image:
            for at, color in (((50, 50), RED), ((150, 50), BLUE), ((150, 11), GREEN)):
                self.assertEqual(image.convert("RGBA").getpixel(tuple(map(int, self.window_place(*at)))), color)
        x, y = self.stage()[0] + middle, self.stage()[1] + 300
        self.do(self.browser.pointer, ("pointerMove", (x, y)), ("pointerDown", None), ("pointerMove", (x + 100, y)), ("pointerUp", None))
        self.assertAlmostEqual(self.state()["split"], (middle + 100) / half.shape[1], delta=0.01)
        self.do(self.browser.keys, "s")
        self.assertTrue((self.pixels() == whole).all())

    # ---- Items -------------------------------------------------------------------------------------

    def item_at(self, x, y):
        self.browser.pointer(("pointerMove", self.window_place(x, y)))
        return self.browser.text("#item")

    def test_names_the_element_under_the_pointer(self):
        self.open(self.page(self.items))
        self.wait_for_items()
        self.assertEqual(self.item_at(30, 30), "<rect> #left fill, line 2")
        self.assertEqual(self.item_at(150, 50), "<circle> #disc fill, line 4")
        self.assertEqual(self.item_at(150, 12), "<circle> #disc stroke, line 4")
        self.assertEqual(self.item_at(197, 3), "")
        self.open(self.page(self.items), "x=30&y=30&scale=2")
        self.wait_for_items()
        self.browser.keys("i")
        self.assertEqual(self.browser.text("#item"), "<rect> #left fill, line 2")

    def wait_for_items(self):
        self.browser.wait_until("document.getElementById('stage').dataset.items === 'ready'", "items")

    def test_names_items_of_a_tilted_plane(self):
        self.open(self.page(self.items), "tilt=50&scale=3")
        self.wait_for_items()
        left, top, width, height = self.stage()
        seen = set()
        for x in range(int(left) + 5, int(left + width), 60):
            self.browser.pointer(("pointerMove", (x, top + height * 0.5)))
            seen.add(self.browser.text("#item"))
        self.assertLessEqual({"<rect> #left fill, line 2", "<circle> #disc fill, line 4", ""}, seen)

    def test_an_assets_regions_have_numbers(self):
        asset = self.folder / "items.vtm"
        self.vtm("compile", self.items, "-o", asset)
        self.open(self.page(asset))
        self.wait_for_items()
        self.assertRegex(self.item_at(30, 30), r"^region \d+$")
        self.assertTrue(self.browser.run("return document.getElementById('split').hidden"))

    def test_gzipped_files(self):
        import gzip
        packed = self.folder / "packed.svgz"
        packed.write_bytes(gzip.compress(ITEMS.encode()))
        self.open(self.page(packed), "split=0.5")
        self.browser.run("return document.getElementById('browser-image').decode()")
        self.wait_for_items()
        self.assertEqual(self.item_at(30, 30), "<rect> #left fill, line 2")

    # ---- Where it runs -----------------------------------------------------------------------------

    def test_small_windows_and_dark(self):
        self.browser.resize(360, 640, mobile=True)
        self.browser.prefer_dark(True)
        try:
            self.open(self.page(self.items))
            overflow = self.browser.run("return [document.documentElement.scrollWidth, innerWidth]")
            self.assertLessEqual(overflow[0], overflow[1])
            self.assertLess(self.pixels()[0, 0, 3], 255)
            color = self.browser.run("return getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number)")
            self.assertLess(max(color), 80)
            outside = self.browser.run("""return [...document.querySelectorAll('button, select')]
                .filter((e) => e.offsetParent && !e.closest('dialog'))
                .filter((e) => { const b = e.getBoundingClientRect(); return b.left < 0 || b.right > innerWidth; }).length""")
            self.assertEqual(outside, 0)
        finally:
            self.browser.prefer_dark(False)

    def test_a_lost_context_is_restored(self):
        self.open(self.page(self.items))
        before = self.pixels()
        self.browser.run("window.loss = document.getElementById('canvas').getContext('webgl2').getExtension('WEBGL_lose_context');"
                         "loss.loseContext()")
        self.browser.wait_until("document.getElementById('message').textContent.includes('reset')", "the message")
        self.do(self.browser.run, "loss.restoreContext()")
        self.wait()
        self.assertTrue((self.pixels() == before).all())
        self.browser.log()  # Chromium itself may tell of the loss

    def test_without_webgl_it_says_so(self):
        page = self.page(self.items)
        self.browser.command("Page.addScriptToEvaluateOnNewDocument",
                             {"source": "if (location.hash === '#spoilt') HTMLCanvasElement.prototype.getContext = () => null;"})
        self.browser.open(page, "spoilt")
        self.browser.wait_until("!document.getElementById('message').hidden", "a message")
        self.assertIn("no WebGL 2", self.browser.text("#message"))

    def test_textures_beyond_the_limit_are_named(self):
        page = self.page(self.items)
        self.browser.command("Page.addScriptToEvaluateOnNewDocument", {"source": """
            if (location.hash === '#small') {
                const ask = WebGL2RenderingContext.prototype.getParameter;
                WebGL2RenderingContext.prototype.getParameter = function(name) { return name === this.MAX_TEXTURE_SIZE ? 2048 : ask.call(this, name); };
            }"""})
        self.browser.open(page, "small")
        self.browser.wait_until("!document.getElementById('message').hidden", "a message")
        self.assertIn("this browser's limit is 2048 per side", self.browser.text("#message"))

    def test_plain_screenshot_of_a_file(self):
        shot = self.folder / "shot.png"
        subprocess.run(["chromium", "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                        "--hide-scrollbars", "--window-size=600,400", "--virtual-time-budget=3000",
                        f"--user-data-dir={self.folder / 'profile'}", f"--screenshot={shot}",
                        self.page(self.items).as_uri()], check=True, capture_output=True, timeout=120)
        with Image.open(shot) as image:
            colors = {color for _, color in image.convert("RGB").getcolors(1 << 24)}
        self.assertLessEqual({RED[:3], BLUE[:3], GREEN[:3]}, colors)
        shutil.rmtree(self.folder / "profile", ignore_errors=True)

    # ---- Hostile files -----------------------------------------------------------------------------

    def test_texts_of_the_file_stay_texts(self):
        attack = "</script><script>window.pwned = 1</script><img src=x onerror='window.pwned=1'><!--<script>"
        svg = self.folder / "a'<b>&\"-->.svg"
        svg.write_text(f"""<svg xmlns="http://www.w3.org/2000/svg" width="20" height="20"><title><![CDATA[{attack}]]></title>
            <script>window.pwned = 2</script>
            <rect id="&lt;/script&gt;&lt;script&gt;window.pwned=3&lt;/script&gt;" width="20" height="20" fill="lime" onload="window.pwned=4"/>
            <!-- {attack.replace("--", "- -")} --></svg>""")
        page = self.folder / "attack.html"
        self.vtm("view", svg, "-o", page)
        self.open(page, "split=0.5")
        self.browser.run("return document.getElementById('browser-image').decode()")
        self.wait_for_items()
        self.assertEqual(self.browser.run("return document.title"), svg.name)
        self.assertIn("script", self.item_at(5, 10))
        self.assertIsNone(self.browser.run("return window.pwned ?? null"))
        self.assertEqual(self.browser.run("return document.querySelectorAll('#title *, #item script, #item img').length"), 0)

    def test_the_policy_lets_no_other_script_run(self):
        page = self.page(self.items).read_text()
        policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page).group(1)
        self.assertIn("default-src 'none'", policy)
        self.assertNotIn("unsafe", policy)
        planted = self.folder / "planted.html"
        planted.write_text(page.replace("<header>", "<script>window.pwned = 1</script><header>", 1))
        self.open(planted)
        self.assertIsNone(self.browser.run("return window.pwned ?? null"))
        self.assertTrue(any("Content Security Policy" in line for line in self.browser.log()))


if __name__ == "__main__":
    main()
