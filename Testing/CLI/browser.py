# SPDX-License-Identifier: BSD-3-Clause
"""A headless Chromium, driven through a pipe: pages from the disk, what they log, what they ask for, keys and pictures of them."""
import base64
import contextlib
import json
import os
import shutil
import subprocess
import tempfile
import time

FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
         "--disable-sync", "--disable-extensions", "--disable-default-apps", "--mute-audio", "--hide-scrollbars", "--remote-debugging-pipe", "about:blank"]
KEYS = {"Enter": 13, "PageUp": 33, "PageDown": 34, "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40, "Escape": 27, "Tab": 9}


def chromium():
    """The program, or None."""
    return shutil.which("chromium")


class Browser:
    """A page. Use it in `with`."""

    def __init__(self, width=1400, height=900, dark=False, patience=120):
        self.folder = tempfile.mkdtemp(prefix="dgtk-browser-")
        self.patience = patience
        read_commands, self.commands = os.pipe()
        self.answers, write_answers = os.pipe()

        def descriptors():
            os.dup2(read_commands, 103)  # by way of other numbers: they may be 3 and 4 themselves
            os.dup2(write_answers, 104)
            os.dup2(103, 3)
            os.dup2(104, 4)
        self.process = subprocess.Popen([chromium(), f"--user-data-dir={self.folder}", f"--window-size={width},{height}", *FLAGS], preexec_fn=descriptors,
                                        close_fds=True, pass_fds=(3, 4, read_commands, write_answers), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(read_commands)
        os.close(write_answers)
        self.last, self.rest, self.session = 0, b"", None
        self._show(next(one for one in self.ask("Target.getTargets")["targetInfos"] if one["type"] == "page")["targetId"], width, height, dark)

    def _show(self, target, width, height, dark):
        self.requests, self.problems, self.events = [], [], set()
        self.session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.ask(domain + ".enable")
        self.ask("Page.setLifecycleEventsEnabled", enabled=True)
        self.resize(width, height)
        self.ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])

    @contextlib.contextmanager
    def page(self, width=1400, height=900, dark=False):
        """Another page, which shares nothing with those before but the process: that takes longer to start than most pages to show."""
        self.session = None
        context = self.ask("Target.createBrowserContext")["browserContextId"]
        self._show(self.ask("Target.createTarget", url="about:blank", browserContextId=context)["targetId"], width, height, dark)
        try:
            yield self
        finally:
            self.session = None
            self.ask("Target.disposeBrowserContext", browserContextId=context)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.ask("Browser.close")
            self.process.wait(timeout=120)
        except Exception:  # it goes one way or the other
            self.process.kill()
            self.process.wait()
        os.close(self.commands)
        os.close(self.answers)
        shutil.rmtree(self.folder, ignore_errors=True)

    def _message(self):
        while b"\0" not in self.rest:
            more = os.read(self.answers, 1 << 20)
            if not more:
                raise RuntimeError("the browser has ended")
            self.rest += more
        text, self.rest = self.rest.split(b"\0", 1)
        return json.loads(text)

    def _note(self, message):
        if message.get("sessionId") != self.session:
            return  # of a page before
        method, values = message.get("method"), message.get("params", {})
        self.events.add((values["name"], values["loaderId"]) if method == "Page.lifecycleEvent" else method)
        if method == "Network.requestWillBeSent":
            self.requests.append(values["request"]["url"])
        elif method == "Runtime.exceptionThrown":
            self.problems.append(str(values["exceptionDetails"].get("exception", {}).get("description", values["exceptionDetails"]["text"])))
        elif method == "Runtime.consoleAPICalled" and values["type"] in ("error", "warning", "assert"):
            self.problems.append(str(values["args"]))
        elif method == "Log.entryAdded" and values["entry"]["level"] in ("error", "warning"):
            self.problems.append(values["entry"]["text"])

    def ask(self, method, **values):
        self.last += 1
        message = {"id": self.last, "method": method, "params": values}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.commands, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._message()
            if answer.get("id") == self.last:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self._note(answer)

    def resize(self, width, height):
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def open(self, path):
        """Loads a file to its end."""
        loader = self.ask("Page.navigate", url="file://" + os.path.abspath(path))["loaderId"]
        while ("load", loader) not in self.events:
            self._note(self._message())

    def evaluate(self, expression):
        """The value of JavaScript, promises awaited."""
        result = self.ask("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(result["exceptionDetails"].get("exception", {}).get("description", "failed"))
        return result["result"].get("value")

    def until(self, expression):
        """Waits until JavaScript is true."""
        end = time.monotonic() + self.patience
        while not self.evaluate(expression):
            if time.monotonic() > end:
                raise RuntimeError(f"never true: {expression}")
            time.sleep(0.05)

    def key(self, key, shift=False):
        code = KEYS.get(key, ord(key[0].upper()))
        text = {"text": key} if len(key) == 1 else {"text": "\r"} if key == "Enter" else {}
        for kind in ("keyDown", "keyUp"):
            self.ask("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code, modifiers=8 if shift else 0, **(text if kind == "keyDown" else {}))

    def mouse(self, x, y):
        self.ask("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)

    def picture(self, path, whole=False):
        """A PNG of what is in view, or of the whole page."""
        with open(path, "wb") as file:
            file.write(base64.b64decode(self.ask("Page.captureScreenshot", format="png", captureBeyondViewport=whole)["data"]))
