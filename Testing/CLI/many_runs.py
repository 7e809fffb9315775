# SPDX-License-Identifier: BSD-3-Clause
"""dgtk run some thousand times: started and linked once, and a fork of it runs its main() again and again (Testing/Support/dgtkManyRuns.cxx)."""
import glob
import os
import queue
import select
import signal
import struct
import subprocess

from harness import DGTK, Case

BUILD = os.environ["DGTK_BUILD"]
SERVER = os.path.join(BUILD, "lib", "libdgtk_many_runs.so")
# What is opened on demand, by the name that it is asked for by (that of its ABI, the shortest with a version).
OTHERS = os.environ.get("LD_PRELOAD") or ":".join(min(glob.glob(os.path.join(BUILD, "lib", f"libdgtk{name}.so.*")), key=len) for name in ("Verification", "Embree"))


class ManyRuns:
    """As many at a time as there are threads that call run(); a context manager, after which no process is left."""

    def __init__(self):
        self.idle, self.all = queue.SimpleQueue(), []

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        for server in self.all:
            server.stdin.close()
            server.stdout.close()
        if any([server.wait() for server in self.all]) and kind is None:
            raise AssertionError("the program ended after its last run otherwise than by itself")

    def _server(self):
        try:
            return self.idle.get_nowait()
        except queue.Empty:
            server = subprocess.Popen([DGTK], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                      start_new_session=True, env={**os.environ, "LD_PRELOAD": f"{SERVER}:{OTHERS}", "LD_BIND_NOW": "1"})
            self.all.append(server)
            return server

    def run(self, *arguments, timeout=600):
        """The finished process, as of subprocess.run(..., capture_output=True, timeout=timeout)."""
        if os.environ.get("DGTK_TEST_SANITIZED"):  # sanitizers start before all others
            return subprocess.run([DGTK, *arguments], stdin=subprocess.DEVNULL, capture_output=True, timeout=timeout)
        server = self._server()
        words = b"".join(os.fsencode(word) + b"\0" for word in arguments)
        server.stdin.write(struct.pack("I", len(words)) + words)
        server.stdin.flush()
        if not select.select([server.stdout], [], [], timeout)[0]:
            os.killpg(server.pid, signal.SIGKILL)
            raise subprocess.TimeoutExpired([DGTK, *arguments], timeout)
        status, *sizes = struct.unpack("iii", server.stdout.read(12))
        texts = [server.stdout.read(size) for size in sizes]
        self.idle.put(server)
        return subprocess.CompletedProcess([DGTK, *arguments], status, *texts)


class ManyCase(Case):
    """Cases in which dgtk runs so often that it is started once for all of a class, but where it has an environment of its own."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.runs = cls.enterClassContext(ManyRuns())

    @classmethod
    def ran(cls, *arguments, timeout=600):
        """The finished process, with texts, whatever its status."""
        done = cls.runs.run(*map(str, arguments), timeout=timeout)
        done.stdout, done.stderr = done.stdout.decode(), done.stderr.decode()
        return done

    def dgtk(self, *arguments, status=0, environment=None, timeout=600):
        if environment:
            return super().dgtk(*arguments, status=status, environment=environment, timeout=timeout)
        done = self.ran(*arguments, timeout=timeout)
        self.assertEqual(done.returncode, status, f"dgtk {' '.join(map(str, arguments))}\n{done.stdout}\n{done.stderr}")
        return done

    def alone(self, *arguments):
        """As dgtk(), by a process of its own, where what must not depend on it is compared."""
        return super().dgtk(*arguments)
