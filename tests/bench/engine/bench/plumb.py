"""plumb render: the textbook tracer, and the engine in each real type once there is one."""

import json
import os
import re

from . import process


class TooLarge(Exception):
    """A scene beyond the limits of this plumb."""


def has_engine(program):
    """Whether this plumb has --engine and --stats-json."""
    said = process.run([program, "render", "--help"]).output
    return "--engine" in said and "--stats-json" in said


class Plumb:
    def __init__(self, program, job, engine, real, threads=1):
        self.name = engine if (engine, real) == ("textbook", "double") else f"{engine}-{real}"
        self.job, self.program = job, program
        self.has_engine = has_engine(program)
        self.options = ["--depth", str(job.depth), "--threads", str(threads), "--real", real]
        if self.has_engine:
            self.options += ["--engine", engine]

    def _command(self, size, picture):
        return [self.program, "render", self.job.scene, "--size", "%dx%d" % size, "-o", picture, *self.options]

    def picture(self, size=None):
        size = size or (self.job.width, self.job.height)
        path = os.path.join(self.job.directory, "%s-%dx%d.pfm" % (self.name, *size))
        try:
            process.run(self._command(size, path), self.job.directory)
        except process.Failed as reason:
            if "expected fewer" in str(reason):
                raise TooLarge(str(reason)) from reason
            raise
        return path

    def measure(self):
        """CPU seconds of rendering, building and reading from the program's own statistics; without these, rendering
        is what the picture costs beyond one of a few pixels."""
        size = (self.job.width, self.job.height)
        if not self.has_engine:
            whole, small = (process.run(self._command(s, "timed.pfm"), self.job.directory).cpu for s in (size, (4, 3)))
            return {"render": whole - small}
        process.run(self._command(size, "timed.pfm") + ["--stats-json", "stats.json"], self.job.directory)
        with open(os.path.join(self.job.directory, "stats.json"), encoding="utf-8") as file:
            stats = json.load(file)
        wall, cpu = stats["seconds"], stats.get("cpu_seconds", {})
        times = {part: cpu.get(part, wall.get(part)) for part in ("render", "build", "read")}
        return {**times, "wall": wall["render"], "bytes": stats.get("bytes")}


def pixels_over(program, reference, picture, tolerance, directory):
    """(pixels that differ by more than the tolerance, all pixels), by plumb compare. Raises process.Failed when the
    pictures cannot be compared."""
    said = process.run([program, "compare", reference, picture, "--tolerance", str(tolerance)], directory, exits=(0, 1))
    over, pixels = re.search(r"pixels over\s+(\d+) of (\d+)", said.output).groups()
    return int(over), int(pixels)


def version(program):
    return process.run([program, "--version"]).output.strip()
