"""Chromium without a window, by WebDriver (W3C) over HTTP."""

import base64
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest
import urllib.error
import urllib.request

from support import TestCase

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the protocol's key of an element
FLAGS = ("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--hide-scrollbars",
         "--disable-background-networking", "--disable-component-update", "--disable-sync")
KEYS = {"left": "\ue012", "up": "\ue013", "right": "\ue014", "down": "\ue015", "home": "\ue011", "end": "\ue010",
        "enter": "\ue007", "tab": "\ue004"}


class Browser:
    """A separate browser with an empty profile; to be used in a with statement."""

    def __init__(self, width=1280, height=800, dark=False):
        self._size, self._dark = (width, height), dark

    def __enter__(self):
        driver, browser = shutil.which("chromedriver"), shutil.which("chromium") or shutil.which("google-chrome")
        if not driver or not browser:
            raise unittest.SkipTest("there is no chromedriver or no Chromium")
        self._profile = tempfile.TemporaryDirectory(prefix="penumbra-browser-", ignore_cleanup_errors=True)
        self._driver = subprocess.Popen([driver, "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                        text=True)
        try:
            self._address = f"http://127.0.0.1:{self._port()}"
            self._session = self._open_session(browser)
            self._set_size(*self._size)
        except BaseException:
            self._stop()
            raise
        return self

    def __exit__(self, *_):
        try:
            self._call("DELETE", "")
        finally:
            self._stop()

    def _stop(self):
        self._driver.terminate()
        self._driver.communicate()
        self._profile.cleanup()

    def _port(self):
        for line in self._driver.stdout:
            if "started successfully on port" in line:
                return int(line.rstrip().rstrip(".").rsplit(" ", 1)[1])
        raise AssertionError("chromedriver did not start")

    def _open_session(self, browser):
        self._session = None
        flags = [*FLAGS, f"--user-data-dir={self._profile.name}", *(["--force-dark-mode"] if self._dark else [])]
        always = {"browserName": "chrome", "goog:chromeOptions": {"binary": browser, "args": flags},
                  "goog:loggingPrefs": {"browser": "ALL"}}
        return self._send("POST", "/session", {"capabilities": {"alwaysMatch": always}})["sessionId"]

    def _send(self, method, path, body=None):
        data = None if body is None and method != "POST" else json.dumps(body or {}).encode()
        headers = {"Content-Type": "application/json"}
        request = urllib.request.Request(self._address + path, data, headers, method=method)
        opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        try:
            with opener.open(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise AssertionError(f"{method} {path}: {error.read().decode()[:400]}") from None

    def _call(self, method, path, body=None):
        return self._send(method, f"/session/{self._session}{path}", body)

    def _chrome(self, command, **parameters):
        return self._call("POST", "/goog/cdp/execute", {"cmd": command, "params": parameters})

    def _set_size(self, width, height):
        # Sets the width of the page itself, since a window can't be narrower than its buttons.
        self._chrome("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                     mobile=False)

    def resize(self, width, height):
        self._set_size(width, height)

    def set_dark(self, dark):
        value = "dark" if dark else "light"
        self._chrome("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": value}])

    def open(self, path):
        """Opens a file and empties the log."""
        self.log()
        self._call("POST", "/url", {"url": pathlib.Path(path).resolve().as_uri()})

    def script(self, text, *arguments):
        """Runs JavaScript and returns its result."""
        return self._call("POST", "/execute/sync", {"script": text, "args": list(arguments)})

    def all(self, selector):
        found = self._call("POST", "/elements", {"using": "css selector", "value": selector})
        return [element[ELEMENT] for element in found]

    def one(self, selector):
        found = self.all(selector)
        assert found, f"nothing matches {selector}"
        return found[0]

    def click(self, element):
        self._call("POST", f"/element/{element}/click", {})

    def press(self, element, *keys):
        """Focuses an element and presses keys, given by name (see KEYS) or as characters."""
        self._call("POST", f"/element/{element}/value", {"text": "".join(KEYS.get(key, key) for key in keys)})

    def text(self, element):
        return self._call("GET", f"/element/{element}/text")

    def drag(self, element, x, y):
        """Drags the mouse from the element's middle by (x, y) pixels."""
        origin = {"type": "pointerMove", "duration": 50}
        actions = [{**origin, "origin": {ELEMENT: element}, "x": 0, "y": 0}, {"type": "pointerDown", "button": 0},
                   {**origin, "origin": "pointer", "x": x, "y": y}, {"type": "pointerUp", "button": 0}]
        mouse = {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": actions}
        self._call("POST", "/actions", {"actions": [mouse]})
        self._call("DELETE", "/actions")

    def log(self):
        """The warnings and errors of the console since the last call."""
        entries = self._call("POST", "/se/log", {"type": "browser"})
        return [entry["message"] for entry in entries if entry["level"] in ("WARNING", "SEVERE")]

    def screenshot(self, path, whole=False):
        """A PNG of the visible part, or of the whole page."""
        picture = self._chrome("Page.captureScreenshot", format="png", captureBeyondViewport=whole, **(
            {"clip": {"x": 0, "y": 0, **self._page_size(), "scale": 1}} if whole else {}))
        pathlib.Path(path).parent.mkdir(parents=True, exist_ok=True)
        pathlib.Path(path).write_bytes(base64.b64decode(picture["data"]))

    def _page_size(self):
        size = self._chrome("Page.getLayoutMetrics")["cssContentSize"]
        return {"width": size["width"], "height": size["height"]}


class PageTest(TestCase):
    """Tests of one page in a browser, in which it must log nothing. A class makes its file, `page`, in make_page()."""

    page = None

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.browser.__enter__()
        cls.addClassCleanup(cls.browser.__exit__)
        cls.make_page()

    def setUp(self):
        super().setUp()
        self.browser.resize(1280, 800)
        self.browser.open(self.page)

    def tearDown(self):
        self.assertEqual(self.browser.log(), [])


def results_folder():
    """The folder in which tests put pictures for people to look at."""
    build = os.environ.get("PENUMBRA_BUILD")
    return pathlib.Path(build or tempfile.gettempdir()) / "test-results"
