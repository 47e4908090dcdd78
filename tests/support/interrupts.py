"""Ctrl-C at a chosen moment, also where a shell in the background has SIGINT ignored."""

import os
import signal
import threading
import time
from contextlib import contextmanager


@contextmanager
def interrupted_when(condition):
    """A KeyboardInterrupt in the main thread as soon as ``condition()`` is true in another."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    over = threading.Event()

    def watch():
        while not condition() and not over.is_set():
            time.sleep(0.002)
        if not over.is_set():
            os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=watch, daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()
        signal.signal(signal.SIGINT, before)
