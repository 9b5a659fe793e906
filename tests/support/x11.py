"""What xdotool can't do on an X display, done with libX11: resources, pings, the clipboard, dropping files (XDND 5)."""

import ctypes
import time

PATIENCE = 120  # seconds: for a busy machine
CLIENT_MESSAGE, SELECTION_NOTIFY, SELECTION_REQUEST = 33, 31, 30
XA_STRING = 31
SUBSTRUCTURE_NOTIFY = 1 << 19
XDND_VERSION = 5

_x = ctypes.CDLL("libX11.so.6")
_pointer, _ulong, _int = ctypes.c_void_p, ctypes.c_ulong, ctypes.c_int
_ints = ctypes.POINTER(_int)
_uints = ctypes.POINTER(ctypes.c_uint)
_ulongs = ctypes.POINTER(_ulong)


def _declare(name, result, *arguments):
    function = getattr(_x, name)
    function.restype, function.argtypes = result, arguments


class _ClientMessage(ctypes.Structure):
    _fields_ = [("type", _int), ("serial", _ulong), ("send_event", _int), ("display", _pointer), ("window", _ulong),
                ("message_type", _ulong), ("format", _int), ("data", ctypes.c_long * 5)]


class _SelectionRequest(ctypes.Structure):
    _fields_ = [("type", _int), ("serial", _ulong), ("send_event", _int), ("display", _pointer), ("owner", _ulong),
                ("requestor", _ulong), ("selection", _ulong), ("target", _ulong), ("property", _ulong),
                ("time", _ulong)]


class _SelectionNotify(ctypes.Structure):
    _fields_ = [("type", _int), ("serial", _ulong), ("send_event", _int), ("display", _pointer),
                ("requestor", _ulong), ("selection", _ulong), ("target", _ulong), ("property", _ulong),
                ("time", _ulong)]


class _Event(ctypes.Union):
    _fields_ = [("type", _int), ("client", _ClientMessage), ("request", _SelectionRequest),
                ("notify", _SelectionNotify), ("room", ctypes.c_long * 24)]


class _ErrorEvent(ctypes.Structure):
    _fields_ = [("type", _int), ("display", _pointer), ("resource", _ulong), ("serial", _ulong),
                ("code", ctypes.c_ubyte), ("request", ctypes.c_ubyte), ("minor", ctypes.c_ubyte)]


_handler_type = ctypes.CFUNCTYPE(_int, _pointer, ctypes.POINTER(_ErrorEvent))
_declare("XOpenDisplay", _pointer, ctypes.c_char_p)
_declare("XCloseDisplay", _int, _pointer)
_declare("XDefaultRootWindow", _ulong, _pointer)
_declare("XInternAtom", _ulong, _pointer, ctypes.c_char_p, _int)
_declare("XChangeProperty", _int, _pointer, _ulong, _ulong, _ulong, _int, _int, ctypes.c_void_p, _int)
_declare("XDeleteProperty", _int, _pointer, _ulong, _ulong)
_declare("XGetWindowProperty", _int, _pointer, _ulong, _ulong, ctypes.c_long, ctypes.c_long, _int, _ulong, _ulongs,
         _ints, _ulongs, _ulongs, ctypes.POINTER(ctypes.c_void_p))
_declare("XCreateSimpleWindow", _ulong, _pointer, _ulong, _int, _int, ctypes.c_uint, ctypes.c_uint, ctypes.c_uint,
         _ulong, _ulong)
_declare("XTranslateCoordinates", _int, _pointer, _ulong, _ulong, _int, _int, _ints, _ints, _ulongs)
_declare("XGetGeometry", _int, _pointer, _ulong, _ulongs, _ints, _ints, _uints, _uints, _uints, _uints)
_declare("XSetSelectionOwner", _int, _pointer, _ulong, _ulong, _ulong)
_declare("XConvertSelection", _int, _pointer, _ulong, _ulong, _ulong, _ulong, _ulong)
_declare("XSelectInput", _int, _pointer, _ulong, ctypes.c_long)
_declare("XSendEvent", _int, _pointer, _ulong, _int, ctypes.c_long, ctypes.POINTER(_Event))
_declare("XPending", _int, _pointer)
_declare("XNextEvent", _int, _pointer, ctypes.POINTER(_Event))
_declare("XWarpPointer", _int, _pointer, _ulong, _ulong, _int, _int, ctypes.c_uint, ctypes.c_uint, _int, _int)
_declare("XSync", _int, _pointer, _int)
_declare("XFree", _int, ctypes.c_void_p)
_declare("XSetErrorHandler", _pointer, _handler_type)


@_handler_type
def _tell_error(_display, error):
    # libX11's default handler ends the process.
    print(f"X error {error.contents.code} of request {error.contents.request}")
    return 0


class Connection:
    """A client of a display, with a small window of its own that is never shown."""

    def __init__(self, display):
        _x.XSetErrorHandler(_tell_error)
        self._display = _x.XOpenDisplay(display.encode())
        assert self._display, f"no display {display}"
        self._root = _x.XDefaultRootWindow(self._display)
        self._window = _x.XCreateSimpleWindow(self._display, self._root, 0, 0, 1, 1, 0, 0, 0)
        _x.XSelectInput(self._display, self._root, SUBSTRUCTURE_NOTIFY)  # windows send their answers to pings there
        self._pings = 0
        self._sync()

    def close(self):
        _x.XCloseDisplay(self._display)

    def _sync(self):
        _x.XSync(self._display, 0)

    def _atom(self, name):
        return _x.XInternAtom(self._display, name.encode(), 0)

    def _set_property(self, window, name, kind, data):
        _x.XChangeProperty(self._display, window, name, kind, 8, 0, data, len(data))
        self._sync()

    def set_resources(self, text):
        """What xrdb loads, as "Xft.dpi: 192"; programs that start later read it."""
        self._set_property(self._root, self._atom("RESOURCE_MANAGER"), XA_STRING, text.encode() + b"\n")

    def position(self, window):
        """The position of the window's upper left corner on the screen."""
        x, y, child = _int(), _int(), _ulong()
        _x.XTranslateCoordinates(self._display, window, self._root, 0, 0, x, y, child)
        return x.value, y.value

    def move_pointer(self, x, y):
        """Moves the pointer to a pixel of the screen, in less time than xdotool takes to start."""
        _x.XWarpPointer(self._display, 0, self._root, 0, 0, 0, 0, x, y)
        self._sync()

    def size(self, window):
        """The window's size in pixels, without the frame of the window manager."""
        root, x, y = _ulong(), _int(), _int()
        width, height, border, depth = (ctypes.c_uint() for _ in range(4))
        _x.XGetGeometry(self._display, window, root, x, y, width, height, border, depth)
        return width.value, height.value

    def _events(self):
        """The events that have arrived. Answers requests for the selection among them."""
        while _x.XPending(self._display):
            event = _Event()
            _x.XNextEvent(self._display, event)
            if event.type == SELECTION_REQUEST:
                self._answer(event.request)
            yield event

    def _wait_for(self, wanted, what):
        """Waits for the first event for which `wanted` holds."""
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            for event in self._events():
                if wanted(event):
                    return event
            time.sleep(0.01)
        raise AssertionError(f"no {what} came")

    def _message(self, name):
        """Waits for the next message of that name to this client, and returns its data."""
        kind = self._atom(name)
        return self._wait_for(lambda event: event.type == CLIENT_MESSAGE and event.client.window == self._window and
                              event.client.message_type == kind, name).client.data

    def _send(self, window, name, *data):
        event = _Event()
        event.client.type, event.client.window, event.client.format = CLIENT_MESSAGE, window, 32
        event.client.message_type = self._atom(name)
        for i, value in enumerate(data):
            event.client.data[i] = value
        _x.XSendEvent(self._display, window, 0, 0, event)
        self._sync()

    def _answer(self, request):
        known = request.target == self._atom("text/uri-list")
        if known:
            self._set_property(request.requestor, request.property, request.target, self._offer)
        event = _Event()
        event.notify.type, event.notify.requestor = SELECTION_NOTIFY, request.requestor
        event.notify.selection, event.notify.target = request.selection, request.target
        event.notify.property = request.property if known else 0
        event.notify.time = request.time
        _x.XSendEvent(self._display, request.requestor, 0, 0, event)
        self._sync()

    def ask_to_close(self, window):
        """As a window manager does for the button of a window's frame; also reaches a window that is minimised."""
        self._send(window, "WM_PROTOCOLS", self._atom("WM_DELETE_WINDOW"))

    def ping(self, window):
        """Asks the window's program for an answer, which it sends when it handles its events: see answered()."""
        self._pings += 1
        self._send(window, "WM_PROTOCOLS", self._atom("_NET_WM_PING"), self._pings, window)

    def answered(self):
        """Whether the answer to the last ping has arrived."""
        wanted = self._atom("_NET_WM_PING"), self._pings
        return any(event.type == CLIENT_MESSAGE and tuple(event.client.data[:2]) == wanted
                   for event in self._events())

    def drop(self, window, x, y, *paths):
        """Drops files on a point of a window; returns once its program has accepted them."""
        self._offer = "".join(f"{path.resolve().as_uri()}\r\n" for path in paths).encode()
        selection, left, top = self._atom("XdndSelection"), *self.position(window)
        _x.XSetSelectionOwner(self._display, selection, self._window, 0)
        source = self._window
        self._send(window, "XdndEnter", source, XDND_VERSION << 24, self._atom("text/uri-list"))
        self._send(window, "XdndPosition", source, 0, (left + x) << 16 | (top + y), 0, self._atom("XdndActionCopy"))
        assert self._message("XdndStatus")[1] & 1, "the window takes no files"
        self._send(window, "XdndDrop", source, 0, 0)
        self._message("XdndFinished")

    def clipboard(self):
        """The text that a program has copied, or None."""
        name = self._atom("PENUMBRA_TEST")
        _x.XConvertSelection(self._display, self._atom("CLIPBOARD"), self._atom("UTF8_STRING"), name, self._window, 0)
        self._sync()
        answer = self._wait_for(lambda event: event.type == SELECTION_NOTIFY, "clipboard")
        if not answer.notify.property:
            return None
        kind, bits, count, left, data = _ulong(), _int(), _ulong(), _ulong(), ctypes.c_void_p()
        _x.XGetWindowProperty(self._display, self._window, name, 0, 1 << 20, 1, 0, kind, bits, count, left, data)
        text = ctypes.string_at(data, count.value).decode()
        _x.XFree(data)
        return text
