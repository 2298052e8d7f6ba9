"""Runs programs and measures them."""

import os
import subprocess
import tempfile
import time
from collections import namedtuple

# Seconds of CPU (user and system, all threads) and of the wall clock; peak memory in bytes; what it printed.
Run = namedtuple("Run", "cpu wall peak_bytes output")


class Failed(Exception):
    """A program that cannot be measured, with the reason."""


def run(command, directory=None, limit=300, exits=(0,)):
    """Runs a command to its end. Raises Failed when it ends otherwise or takes longer than `limit` seconds."""
    began = time.monotonic()
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as output:
        process = subprocess.Popen(command, cwd=directory, stdout=output, stderr=subprocess.STDOUT,
                                   stdin=subprocess.DEVNULL)
        usage = _wait(process, began + limit)
        wall = time.monotonic() - began
        output.seek(0)
        text = output.read()
    if usage is None:
        raise Failed(f"{command[0]} took longer than {limit} s")
    if process.returncode not in exits:
        raise Failed(f"{' '.join(command)} ended with {process.returncode}: {text[-500:].strip()}")
    return Run(usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss * 1024, text)


def _wait(process, deadline):
    """The resources that the process used; None when it had to be killed. Waits without using CPU time."""
    pause = 0.001
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid != 0:
            process.returncode = os.waitstatus_to_exitcode(status)
            return usage
        if time.monotonic() > deadline:
            process.kill()
            os.wait4(process.pid, 0)
            process.returncode = -9
            return None
        time.sleep(pause)
        pause = min(2 * pause, 0.02)
