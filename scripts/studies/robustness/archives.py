"""Catches what febio4 dumps: it writes each archive over the one before, here into a pipe that is read meanwhile."""

import os
import select
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_WAIT = 50  # ms


@contextmanager
def first_archive(path: Path) -> Iterator[list[bytes]]:
    """Make `path` a pipe; the first archive that is written into it until the end of the context is in the list.

    Where febio4 is faster than the reader, two archives follow one another in it; febio4 reads the first of them.
    """
    path.unlink(missing_ok=True)
    os.mkfifo(path)
    caught: list[bytes] = []
    over = threading.Event()
    reader = threading.Thread(target=_read, args=(path, caught, over))
    reader.start()
    try:
        yield caught
    finally:
        over.set()
        reader.join()
        path.unlink()


def _read(path: Path, caught: list[bytes], over: threading.Event) -> None:
    """Read until the writer closes; later archives are read, too, since it would wait for that, and dropped."""
    pipe = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    poll = select.poll()
    poll.register(pipe, select.POLLIN)
    pieces: list[bytes] = []
    while True:
        events = poll.poll(_WAIT)
        if events and events[0][1] & select.POLLIN:
            pieces.append(os.read(pipe, 1 << 20))
            continue
        if pieces and events:  # all read, and nobody writes any more
            caught += [b"".join(pieces)] if not caught else []
            pieces = []
        if over.wait(0.001):
            break
    os.close(pipe)
