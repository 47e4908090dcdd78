"""Supervisor of the program in its arguments: kills the program and all its descendants once standard input closes.

`programs` runs this script in a separate session. To start quickly, the script imports no module of Perilune.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading

NOT_RUN = 126  # exit status for a program that cannot be run, as in shells


def main() -> None:
    """Run the program, and exit with its status or signal."""
    try:
        process = subprocess.Popen(sys.argv[1:], stdin=subprocess.DEVNULL)
    except OSError as error:
        print(error.strerror, file=sys.stderr, flush=True)
        os._exit(NOT_RUN)
    threading.Thread(target=_kill_after_input, args=(process,), daemon=True).start()
    status = process.wait()
    if status < 0:
        if -status != signal.SIGKILL:
            signal.signal(-status, signal.SIG_DFL)
        os.kill(os.getpid(), -status)
    os._exit(status)


def _kill_after_input(process: subprocess.Popen[bytes]) -> None:
    os.read(0, 1)  # nothing is ever written, so this waits for the end of the input
    if sys.platform == "win32":
        process.kill()
    else:
        os.killpg(0, signal.SIGKILL)


if __name__ == "__main__":
    main()
