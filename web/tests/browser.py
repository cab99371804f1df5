"""Headless Chromium by chromedriver's WebDriver protocol (https://www.w3.org/TR/webdriver2/), with the standard library."""
import base64
import json
import pathlib
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

# WebGL 2 as ANGLE makes it, on SwiftShader, which runs everywhere; no GPU is asked for.
ARGUMENTS = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--hide-scrollbars", "--force-device-scale-factor=1", "--force-color-profile=srgb",
             "--disable-background-networking", "--no-first-run"]


def is_installed():
    return all(shutil.which(program) for program in ("chromium", "chromedriver"))


class Browser:
    """One window. `log()` has what the console showed since it was asked before."""

    def __init__(self, width=1000, height=700, *arguments):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.driver = subprocess.Popen(["chromedriver", f"--port={port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.address = f"http://127.0.0.1:{port}"
        self.session = None
        try:
            self.wait_for_driver()
            options = {"args": [*ARGUMENTS, f"--user-data-dir={self.folder.name}", f"--window-size={width},{height}", *arguments]}
            wanted = {"goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}, "timeouts": {"script": 300_000}}
            self.session = self.call("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})["sessionId"]
            self.resize(width, height)
        except BaseException:
            self.close()
            raise

    def wait_for_driver(self):
        deadline = time.monotonic() + 30
        while True:
            try:
                if self.call("GET", "/status")["ready"]:
                    return
            except (urllib.error.URLError, ConnectionError):
                if time.monotonic() > deadline:
                    raise
            time.sleep(0.05)

    def call(self, method, path, body=None):
        if self.session:
            path = f"/session/{self.session}{path}"
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.address + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=320) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from None

    def close(self):
        try:
            if self.session:
                self.call("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait(30)
            self.folder.cleanup()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    # ---- What a person does ------------------------------------------------------------------------

    def resize(self, width, height, **more):
        """The size of the page, whatever the window's frame takes, and of a phone if `mobile`."""
        self.command("Emulation.setDeviceMetricsOverride",
                     {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False, **more})

    def prefer_dark(self, is_dark):
        scheme = "dark" if is_dark else "light"
        self.command("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def command(self, name, parameters=None):
        """Of Chrome's DevTools protocol."""
        return self.call("POST", "/goog/cdp/execute", {"cmd": name, "params": parameters or {}})

    def open(self, page, fragment=""):
        self.call("POST", "/url", {"url": "about:blank"})
        self.call("POST", "/url", {"url": pathlib.Path(page).resolve().as_uri() + (f"#{fragment}" if fragment else "")})

    def run(self, script, *arguments):
        """A function's body. What it returns may be a promise."""
        return self.call("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def wait_until(self, condition, what, seconds=60):
        deadline = time.monotonic() + seconds
        while not self.run(f"return {condition}"):
            if time.monotonic() > deadline:
                raise TimeoutError(f"{what}: {self.text('#message')}; {self.log()}")
            time.sleep(0.02)

    def text(self, selector):
        return self.run("return document.querySelector(arguments[0])?.textContent ?? ''", selector)

    def keys(self, text):
        actions = [{"type": kind, "value": key} for key in text for kind in ("keyDown", "keyUp")]
        self.call("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": actions}]})

    def pointer(self, *actions, kind="mouse"):
        steps = [{"type": name, **({"x": round(at[0]), "y": round(at[1]), "duration": 0} if at else {"button": 0})}
                 for name, at in actions]
        self.call("POST", "/actions", {"actions": [{"type": "pointer", "id": kind, "parameters": {"pointerType": kind},
                                                    "actions": steps}]})

    def wheel(self, x, y, delta):
        step = {"type": "scroll", "x": round(x), "y": round(y), "deltaX": 0, "deltaY": delta, "duration": 0}
        self.call("POST", "/actions", {"actions": [{"type": "wheel", "id": "wheel", "actions": [step]}]})

    def click(self, selector):
        self.run("document.querySelector(arguments[0]).click()", selector)

    def screenshot(self, path):
        pathlib.Path(path).write_bytes(base64.b64decode(self.call("GET", "/screenshot")))

    def log(self):
        return [entry["message"] for entry in self.call("POST", "/se/log", {"type": "browser"})]
