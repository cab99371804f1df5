#!/usr/bin/env python3
"""Standard output and standard error that are full, closed, or read by nobody. streams_test.py VTM"""
import os

from support import Command, main


class StandardOutput(Command):
    def setUp(self):
        super().setUp()
        self.vtm("render", self.svg, "-o", "a.png")
        self.printing = [["--version"], ["--help"], ["render", "--help"], ["info", "square.svg"],
                         ["info", "square.svg", "--json"], ["compile", "square.svg", "-o", "b.vtm", "--json"],
                         ["compile", "square.svg", "-o", "-"], ["render", "square.svg", "-o", "b.png", "--json"],
                         ["render", "square.svg", "-o", "-"], ["diff", "a.png", "a.png"],
                         ["diff", "a.png", "a.png", "--json"]]

    def test_a_full_device_is_an_error(self):
        for arguments in self.printing:
            with self.subTest(arguments=arguments), open("/dev/full", "w") as full:
                said = self.vtm(*arguments, expect=1, stdout=full).stderr
                self.assertEqual(said, "vtm: standard output: cannot be written: No space left on device\n")

    def test_a_closed_descriptor_is_an_error(self):
        for arguments in self.printing:
            with self.subTest(arguments=arguments):
                said = self.shell('"$0" "$@" >&-', *arguments, expect=1).stderr
                self.assertEqual(said, "vtm: standard output: cannot be written: Bad file descriptor\n")

    def test_a_closed_pipe_ends_quietly(self):
        for arguments in self.printing:
            with self.subTest(arguments=arguments):
                reader, writer = os.pipe()
                os.close(reader)
                said = self.vtm(*arguments, expect=141, stdout=writer).stderr
                os.close(writer)
                self.assertEqual(said, "")

    def test_a_batch_ends_with_its_reader(self):
        batch = self.write("list.tsv", "".join(f"{self.svg}\t{i}.png\n" for i in range(50)))
        with open("/dev/full", "w") as full:
            self.vtm("render", "--batch", batch, "--json", expect=1, stdout=full)
        self.assertFalse((self.folder / "1.png").exists())

    def test_it_need_not_be_there_if_nothing_is_printed(self):
        self.shell('"$0" render square.svg -o c.png >&-')
        self.assert_square("c.png")

    def test_files_are_not_taken_for_it(self):
        """A file that is opened gets the least number that is free."""
        self.vtm("render", "square.svg", "-o", "a.png", "--json")
        for closed in (">&-", "2>&-", "<&- >&- 2>&-"):
            self.shell(f'"$0" render square.svg -o c.png --json {closed}; [ $? -le 1 ]')
            self.assert_square("c.png")
            self.assertEqual((self.folder / "c.png").read_bytes(), (self.folder / "a.png").read_bytes())


class StandardError(Command):
    def test_a_warning_that_nobody_can_read_stops_nothing(self):
        self.write("warned.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><text/></svg>')
        for broken in ("2>&-", "2>/dev/full"):
            with self.subTest(broken=broken):
                self.shell(f'"$0" render warned.svg -o o.png {broken}')
                self.assertEqual(self.picture("o.png").size, (9, 9))
        reader, writer = os.pipe()
        os.close(reader)
        self.vtm("render", "warned.svg", "-o", "p.png", stderr=writer)
        os.close(writer)
        self.assertEqual(self.picture("p.png").size, (9, 9))

    def test_an_error_keeps_its_exit_code(self):
        self.shell('"$0" render absent.svg -o o.png 2>/dev/full', expect=1)
        self.shell('"$0" render 2>/dev/full', expect=2)


class StandardInput(Command):
    def test_it_need_not_be_there(self):
        self.shell('"$0" render square.svg -o o.png <&-')
        self.assert_square("o.png")

    def test_a_closed_one_cannot_be_read(self):
        said = self.shell('"$0" render - -o o.png <&-', expect=1).stderr
        self.assertEqual(said, "<stdin>: cannot be read: Bad file descriptor\n")

    def test_a_folder_cannot_be_read(self):
        said = self.shell('"$0" info - < .', expect=1).stderr
        self.assertEqual(said, "<stdin>: cannot be read: Is a directory\n")


if __name__ == "__main__":
    main()
