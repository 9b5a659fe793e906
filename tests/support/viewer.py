"""penumbra view on a desktop: its window, its widgets by name, and simulated mouse and keyboard input."""

import itertools
import json
import pathlib
import shlex
import tempfile

from desktop import LEFT, PATIENCE, WHEEL_DOWN, end, start, wait_for
from support import PROGRAM, shader_cache

FEWEST_COLORS = 5  # of a picture that shows a scene, even without shadows
# A click is down in one frame and up in the next, a popup needs one frame to compute its size, and the layout is written
# after a second one that is the same.
FRAMES_OF_A_CLICK = 5


class Viewer:
    """To be used in a with statement. Widgets are named as in the file of --layout."""

    def __init__(self, desktop, *arguments, size=(800, 600), rests=True, folder=None, home=None):
        """`folder`: the working folder; `home`: keeps the settings, for tests that start the viewer again."""
        self._desktop, self._arguments, self._rests = desktop, arguments, rests
        self._size = ("--size", f"{size[0]}x{size[1]}") if size else ()
        self._start_folder, self._home = folder, home
        self._ended = False  # whether the test itself has ended it

    def __enter__(self):
        self._folder = tempfile.TemporaryDirectory(prefix="penumbra-viewer-")
        self._layout = pathlib.Path(self._folder.name, "layout.json")
        self._errors = open(f"{self._folder.name}/stderr", "w+", encoding="utf-8")
        home = self._home or self._folder.name
        environment = {**self._desktop.environment(), "XDG_CONFIG_HOME": f"{home}/config",
                       "XDG_CACHE_HOME": f"{home}/cache", "MESA_SHADER_CACHE_DIR": shader_cache()}
        self.process = start([PROGRAM, "view", *self._arguments, *self._size, "--layout", self._layout],
                             stderr=self._errors, env=environment, cwd=self._start_folder)
        try:
            self.window = self.wait_for(lambda: self._desktop.find_window(self.process.pid), "its window")
            self.wait_for(self._layout.exists, "its layout")
            if self._rests:
                assert len(self.rest().colors()) > FEWEST_COLORS, "an empty picture"
        except BaseException as fault:
            self.__exit__(type(fault))
            raise
        return self

    def __exit__(self, fault=None, *_):
        lives, told = self.process.poll() is None, self.stderr()
        end(self.process)
        self._errors.close()
        self._folder.cleanup()
        if fault is None:
            assert lives or self._ended, f"ended by itself with {self.process.returncode}: {told}"
            assert told == "", f"it told on stderr: {told}"

    def wait_for(self, condition, what, **options):
        """wait_for() of desktop.py, which also fails if the viewer ends."""
        def met():
            assert self.process.poll() is None, f"ended with {self.process.returncode}: {self.stderr()}"
            return condition()
        return wait_for(met, what, **options)

    def follow(self):
        """Waits until the viewer has handled all earlier input, shown the result and written the layout."""
        # The viewer handles events, and so answers, once per frame.
        for _ in range(FRAMES_OF_A_CLICK + 1):
            self._desktop.client.ping(self.window)
            self.wait_for(self._desktop.client.answered, "an answer of the window", pause=0.005)

    # What the window shows.

    def layout(self):
        return json.loads(self._layout.read_text())

    def has(self, widget):
        return widget in self.layout()

    def box(self, widget):
        """Waits for a widget. Returns left, top, right, bottom in pixels of the window."""
        return self.wait_for(lambda: self.layout().get(widget), f"the widget {widget}")

    def middle(self, widget):
        left, top, right, bottom = self.box(widget)
        return (left + right) // 2, (top + bottom) // 2

    def seen(self, widget):
        """The pixels of a widget, or of the whole picture for "picture"."""
        left, top, right, bottom = self.box(widget)
        x, y = self._desktop.client.position(self.window)
        return self._desktop.screenshot(x + left, y + top, x + right, y + bottom)

    def picture(self):
        """The middle of the picture, which no message covers."""
        whole = self.seen("picture")
        return whole.crop(0, whole.height // 3, whole.width, whole.height * 3 // 4)

    def rest(self):
        """Moves the pointer away, waits until the picture is finished, and returns it."""
        self.leave()
        seen = None

        def rests():
            nonlocal seen
            self.follow()
            last, seen = seen, self.picture() if self.has("idle") else None
            return seen if seen == last else None

        return self.wait_for(rests, "a finished picture")

    def changed(self, before):
        """Waits for a finished picture that differs from `before`, and returns it."""
        self.leave()

        def other():
            now = self.rest() if self.picture() != before else before
            return now if now != before else None

        return self.wait_for(other, "another picture")

    # Mouse and keyboard.

    def move(self, x, y):
        """Moves the pointer to a pixel of the window."""
        self._desktop.xdotool("mousemove", "--window", self.window, x, y)

    def leave(self):
        self._desktop.move(*self._desktop.corner)

    def point_at(self, widget):
        """Moves the pointer to the middle of a widget, also if the widget is still moving."""
        place = None
        while place != self.middle(widget):
            place = self.middle(widget)
            self.move(*place)
            self.follow()

    def click(self, widget, until, what):
        """Clicks on a widget and waits until the condition holds."""
        self.point_at(widget)
        self._desktop.xdotool("click", LEFT)
        self.wait_for(until, what)

    def drag(self, x, y, button, until, what):
        """Drags to and fro from a pixel of the window, with pauses, until the condition holds."""
        # At once, so that the viewer gets both in one frame as from a quick hand: the way to (x, y) is no part of the drag.
        self._desktop.xdotool("mousemove", "--window", self.window, x, y, "mousedown", button)
        self.follow()  # otherwise the viewer would get the press at a later position of the pointer
        way = itertools.cycle([*range(1, 21), *[20] * 20, *range(19, 9, -1), *[10] * 20, *range(9, -1, -1)])

        def moved():
            step = next(way)
            self.move(x + 4 * step, y + 2 * step)
            return step >= 10 and until()  # far enough not to count as a click

        try:
            self.wait_for(moved, what)
        finally:
            self._desktop.xdotool("mouseup", button)

    def wheel(self, button, until, what):
        """Turns the wheel by one notch over the picture, and waits until the condition holds."""
        self.point_at("picture")
        self._desktop.xdotool("click", button)
        self.wait_for(until, what)

    def press(self, key, until, what):
        """Holds a key down until the condition holds."""
        self._desktop.xdotool("keydown", key)
        try:
            self.wait_for(until, what)
        finally:
            self._desktop.xdotool("keyup", key)
        self.follow()  # so that the next press is a separate one

    def tap(self, key):
        """Presses and releases a key, faster than the viewer draws a picture."""
        self._desktop.xdotool("key", key)

    def copied(self):
        """The words of the command line that Ctrl + C copies."""
        self.tap("ctrl+c")
        self.follow()
        return shlex.split(self._desktop.client.clipboard())

    def type(self, text):
        self._desktop.xdotool("type", text)

    def open_tab(self, name, widget):
        self.click(f"tab {name}", lambda: self.has(widget), f"the tab {name}")

    def choose(self, widget, word):
        """Opens the list of a widget and clicks on an entry."""
        item = f"{widget}={word}"
        self.click(widget, lambda: self.has(item), f"the list of {widget}")
        self.click(item, lambda: not self.has(item), f"{item} to be chosen")

    def look_at(self, what):
        """Chooses it from the list of what can be shown, which is longer than its place."""
        before, item = self.rest(), f"show={what}"
        self.point_at("shown list")

        def is_seen():
            _, top, _, bottom = self.box("shown list")
            self.follow()
            if top <= self.box(item)[1] and self.box(item)[3] <= bottom:
                return True
            self._desktop.xdotool("click", WHEEL_DOWN)
            return False

        self.wait_for(is_seen, item)
        self.click(item, lambda: self.has("legend"), "a legend")
        return self.changed(before)

    def find(self, param):
        """Searches for the parameter, so that the panel shows no other one."""
        self.find_all(param)

        def alone():
            # Rows move up while the viewer handles the last letters.
            rows = {name.split("=")[0].split(" ")[0] for name in self.layout() if "." in name.split("=")[0]}
            return rows == {param}
        self.wait_for(alone, f"{param} alone")

    def find_all(self, text):
        """Searches for the parameters whose names have this text."""
        self._focus("search")
        self._desktop.xdotool("key", "ctrl+a")
        self.type(text)
        self.follow()

    def _focus(self, widget):
        """Clicks on a field and waits until it looks different, since it then accepts text."""
        self.point_at(widget)  # which changes its colour
        before = self.seen(widget)
        self._desktop.xdotool("click", LEFT)
        self.wait_for(lambda: self.seen(widget) != before, f"{widget} to take text")

    def fill_in(self, param, text, until, what):
        """Types a number into a slider: Ctrl + click, the number, Enter."""
        self.point_at(param)
        resting = self.seen(param)
        self._desktop.xdotool("keydown", "ctrl", "click", LEFT)
        self.wait_for(lambda: self.seen(param) != resting, f"{param} to take text")
        self._desktop.xdotool("keyup", "ctrl")
        self.type(text)
        self.press("Return", until, what)

    # The end of the viewer.

    def signal(self, number):
        self.process.send_signal(number)
        return self.exit_code()

    def exit_code(self):
        self._ended = True
        return self.process.wait(timeout=PATIENCE)

    def stderr(self):
        self._errors.seek(0)
        return self._errors.read()

    def memory(self):
        """Resident memory, MiB."""
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS")) / 1024
