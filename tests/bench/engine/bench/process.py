"""Runs programs and measures them."""

import os
import subprocess
import tempfile
import threading
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
        usage, was_killed = _wait(process, limit)
        wall = time.monotonic() - began
        output.seek(0)
        text = output.read()
    if was_killed:
        raise Failed(f"{command[0]} took longer than {limit} s")
    if process.returncode not in exits:
        raise Failed(f"{' '.join(command)} ended with {process.returncode}: {text[-500:].strip()}")
    return Run(usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss * 1024, text)


def _wait(process, limit):
    """The resources that the process used, and whether it had to be killed."""
    timer = threading.Timer(limit, process.kill)
    timer.start()
    _, status, usage = os.wait4(process.pid, 0)
    was_killed = not timer.is_alive()
    timer.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    return usage, was_killed
