#!/usr/bin/env python3
"""What the command's heap is made of. heap_test.py VTM"""
import pathlib
import re
import subprocess
import time

from support import SQUARE, Command, main

HUGE_PAGES = pathlib.Path("/sys/kernel/mm/transparent_hugepage/enabled")


def heap_flags(process):
    """The flags of each of its heap's mappings, "hg" among them where huge pages are wished for."""
    maps = pathlib.Path(f"/proc/{process.pid}/smaps").read_text()
    return [set(flags.split()) for flags in re.findall(r"\[heap\]\n(?:.*\n)*?VmFlags:(.*)\n", maps)]


class Heap(Command):
    def test_it_grows_by_huge_pages(self):
        self.skip_with_sanitizers()
        if not HUGE_PAGES.exists():
            self.skipTest("this system has no huge pages")
        process = subprocess.Popen([self.program, "render", "-", "-o", "a.png"], cwd=self.folder,
                                   stdin=subprocess.PIPE, text=True)
        try:  # it waits for its input
            end = time.monotonic() + 60
            while not any("hg" in flags for flags in heap_flags(process)):
                self.assertLess(time.monotonic(), end, "no huge pages")
                time.sleep(0.01)
        finally:
            process.communicate(SQUARE, timeout=60)
        self.assertEqual(process.returncode, 0)
        self.assert_square("a.png")

    def test_it_does_without(self):
        """Where there are no addresses to grow by."""
        self.skip_with_sanitizers()
        self.shell('ulimit -d 60000; "$0" render square.svg -o a.png')  # kB
        self.assert_square("a.png")

    def test_a_batch_draws_as_one_does(self):
        self.write("list.tsv", "".join(f"square.svg\t{i}.png\n" for i in range(3)))
        self.vtm("render", "--batch", "list.tsv")
        for i in range(3):
            self.assert_square(f"{i}.png")


if __name__ == "__main__":
    main()
