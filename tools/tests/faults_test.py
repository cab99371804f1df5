#!/usr/bin/env python3
"""Faults while vtm writes: whatever happens, the old file is intact or the new one is whole. faults_test.py VTM"""
import os
import random
import shutil
import signal
import subprocess
import time

from PIL import Image

from support import Command, main

OLD = "what was there before\n"
NOBODY = 65534


class Faults(Command):
    """A file that takes a while to write: an asset that holds an image of noise, 4 MB."""

    def setUp(self):
        super().setUp()
        side = 1000
        noise = Image.frombytes("RGB", (side, side), random.Random(1).randbytes(3 * side * side))
        noise.save(self.folder / "noise.png", compress_level=0)
        self.write("noise.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="40" height="40">'
                   '<image href="noise.png" width="40" height="40"/></svg>')
        self.compile = ("compile", "noise.svg", "-o", "out/noise.vtm")
        self.out = self.folder / "out"
        self.out.mkdir()
        self.target = self.out / "noise.vtm"
        self.target.write_text(OLD)

    def assert_old(self):
        """And nothing beside it."""
        self.assertEqual(self.target.read_text(), OLD)
        self.assertEqual([p.name for p in self.out.iterdir()], [self.target.name])

    def whole(self):
        self.vtm(*self.compile)
        whole = self.target.read_bytes()
        self.target.write_text(OLD)
        return whole

    def start(self):
        return subprocess.Popen([self.program, *self.compile], cwd=self.folder, stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def stop_while_writing(self, signal_):
        """Whether the file beside the target was seen before the process ended."""
        process = self.start()
        seen = False
        while process.poll() is None and not seen:
            seen = any(name.startswith(".vtm-tmp-") for name in os.listdir(self.out))
        process.send_signal(signal_)
        self.assertIn(process.wait(timeout=60), (0, -signal_))
        return seen


class Limits(Faults):
    def test_file_size(self):
        for blocks in (0, 1, 100):
            said = self.shell(f'ulimit -f {blocks}; exec "$0" "$@"', *self.compile, expect=1).stderr
            self.assertEqual(said, "noise.svg: out/noise.vtm: cannot be written: writing failed: File too large\n")
            self.assert_old()

    def test_memory(self):
        """From too little for the loader to enough: a picture or an exit code, never a signal."""
        self.skip_with_sanitizers()
        for megabytes in (20, 60, 100, 140, 180, 220, 260, 300, 400, 600, 1000):
            with self.subTest(megabytes=megabytes):
                shell = f'ulimit -v {megabytes * 1024}; exec "$0" "$@"'
                done = subprocess.run(["bash", "-c", shell, self.program, *self.compile], capture_output=True, text=True,
                                      cwd=self.folder, stdin=subprocess.DEVNULL, timeout=120)
                self.assertIn(done.returncode, (0, 1, 127), done.stderr)  # 127: the loader
                self.assertEqual(done.returncode != 0, done.stderr != "", done.stderr)
                if done.returncode == 0:
                    self.target.write_text(OLD)
                self.assert_old()

    def test_full_disk(self):
        """A disk of our own, in a mount namespace of our own."""
        script = ('mount -t tmpfs -o size=1m none out || exit 77; echo old > out/noise.vtm; "$0" "$@"; echo $?;'
                  'cat out/noise.vtm; ls -A out')
        done = subprocess.run(["unshare", "--mount", "bash", "-c", script, self.program, *self.compile],
                              capture_output=True, text=True, cwd=self.folder, timeout=120)
        if done.returncode == 77 or "unshare" in done.stderr:
            self.skipTest(f"nothing may be mounted here: {done.stderr.strip()}")
        self.assertEqual(done.stdout, "1\nold\nnoise.vtm\n", done.stderr)
        self.assertIn("No space left on device", done.stderr)

    def test_full_device(self):
        said = self.vtm("compile", "noise.svg", "-o", "/dev/full", expect=1).stderr
        self.assertEqual(said, "noise.svg: /dev/full: cannot be written: No space left on device\n")


class Signals(Faults):
    def test_interrupted_or_terminated_nothing_is_left(self):
        whole = self.whole()
        for signal_ in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(signal=signal_):
                seen = [self.stop_while_writing(signal_) for _ in range(5)]
                self.assertIn(True, seen)
                self.assertIn(self.target.read_bytes(), (OLD.encode(), whole))
                self.assertEqual([p.name for p in self.out.iterdir()], [self.target.name])

    def test_an_ignored_signal_stays_ignored(self):
        self.shell('trap "" INT; "$0" "$@" & sleep 0.01; kill -INT $!; wait $!', *self.compile)

    def test_killed_at_fifty_moments_it_is_old_or_whole(self):
        whole = self.whole()
        start = time.monotonic()
        self.vtm(*self.compile)
        duration = time.monotonic() - start
        moments = random.Random(13)
        found = {OLD.encode(): 0, whole: 0}
        for i in range(50):
            self.target.write_text(OLD)
            if i % 2:
                self.stop_while_writing(signal.SIGKILL)
            else:
                process = self.start()
                time.sleep(moments.uniform(0, 1.2 * duration))
                process.kill()
                process.wait()
            found[self.target.read_bytes()] += 1  # KeyError: neither
        print(f"killed 50 times: {found[OLD.encode()]} old, {found[whole]} whole")
        left = [p.name for p in self.out.iterdir() if p != self.target]
        self.assertTrue(all(name.startswith(".vtm-tmp-") for name in left), left)
        self.vtm(*self.compile)
        self.assertEqual(self.target.read_bytes(), whole)


class Permissions(Faults):
    def as_nobody(self, *arguments):
        """Root may write anywhere, so somebody else tries."""
        command = [self.program, *arguments]
        if os.geteuid() == 0:
            if not shutil.which("setpriv"):
                self.skipTest("root cannot be refused, and setpriv is absent")
            self.folder.chmod(0o755)
            command = ["setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups", *command]
        done = subprocess.run(command, capture_output=True, text=True, cwd=self.folder, timeout=60)
        if "failed to execute" in done.stderr:
            self.skipTest("nobody may not run the program where it lies")
        return done

    def test_a_folder_that_cannot_be_written(self):
        """The file could be overwritten in place; but not whole or not at all."""
        self.target.chmod(0o666)
        self.out.chmod(0o555)
        try:
            done = self.as_nobody(*self.compile)
        finally:
            self.out.chmod(0o755)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stderr, "noise.svg: out/noise.vtm: cannot be written: cannot create a temporary file in its directory: "
                         "Permission denied\n")
        self.assert_old()

    def test_a_file_that_cannot_be_written(self):
        """It could be replaced; but it says that it should not be."""
        self.target.chmod(0o444)
        self.out.chmod(0o777)
        done = self.as_nobody(*self.compile)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stderr, "noise.svg: out/noise.vtm: cannot be written: Permission denied\n")
        self.assert_old()

    def test_owner_and_permissions_stay(self):
        self.target.chmod(0o640)
        if os.geteuid() == 0:
            os.chown(self.target, NOBODY, NOBODY)
        before = self.target.stat()
        self.vtm(*self.compile)
        after = self.target.stat()
        self.assertNotEqual(self.target.read_bytes(), OLD.encode())
        self.assertEqual((after.st_mode, after.st_uid, after.st_gid), (before.st_mode, before.st_uid, before.st_gid))

    def test_folders_that_are_absent_or_files(self):
        self.vtm("compile", "noise.svg", "-o", "absent/noise.vtm", expect=1)
        self.vtm("compile", "noise.svg", "-o", "noise.png/noise.vtm", expect=1)
        self.vtm("compile", "noise.svg", "-o", "out", expect=1)
        self.assert_old()


if __name__ == "__main__":
    main()
