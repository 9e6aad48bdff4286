"""A process of its own for runs: one that dies takes nothing with it but its run.

Both ends of it: `Child` starts the process and gives it work, `main` is what the process does. Requests go to its standard
input and answers come from its standard output, as pickles. It ends when its input does, in the middle of a run if need be:
so none is left over when the process that wanted the result is killed.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import queue
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from typing import Any, BinaryIO


class ChildDied(Exception):
    """The process ended before it answered."""


class Child:
    """A process that does one thing after the other."""

    def __init__(self) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-m", __name__], stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True
        )

    def do(self, work: Callable[[Any], Any], item: Any) -> Any:
        """``work(item)``, done there; what it raises is raised here. ChildDied when the process ends before."""
        assert self._process.stdin is not None and self._process.stdout is not None
        try:
            _write(self._process.stdin, pickle.dumps((work, item)))
            good, value = pickle.loads(_read(self._process.stdout))
        except (EOFError, OSError, pickle.UnpicklingError):  # nothing, or the beginning of an answer
            self.end()
            raise ChildDied from None
        if not good:
            raise value
        return value

    def end(self) -> None:
        """Ends the process, whatever it does."""
        self._process.kill()
        self._process.wait()


def main() -> None:
    """Answers requests until the input ends."""
    from ..progress import show_no_progress

    show_no_progress()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # an interrupt is for who wants the result
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # what runs print is no answer
    requests: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(sys.stdin.buffer, requests), daemon=True).start()
    while True:
        _write(answers, _answer(requests.get()))


def _listen(source: BinaryIO, requests: queue.SimpleQueue[bytes]) -> None:
    with contextlib.suppress(EOFError):
        while True:
            requests.put(_read(source))
    os._exit(0)


def _answer(request: bytes) -> bytes:
    try:
        work, item = pickle.loads(request)
        return pickle.dumps((True, work(item)))
    except Exception as problem:
        return _problem(problem)


def _problem(problem: Exception) -> bytes:
    """An exception as an answer; in words where its class does not travel."""
    try:
        answer = pickle.dumps((False, problem))
        pickle.loads(answer)
        return answer
    except Exception:
        return pickle.dumps((False, RuntimeError(f"{type(problem).__name__}: {problem}")))


def _write(target: BinaryIO, data: bytes) -> None:
    pickle.dump(data, target)
    target.flush()


def _read(source: BinaryIO) -> bytes:
    data: bytes = pickle.load(source)
    return data


if __name__ == "__main__":
    main()
