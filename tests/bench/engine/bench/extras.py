"""Figures beside the table: threads, growth, build, memory, reading, the whole process."""

import math
import os
from statistics import median

from . import process
from .plumb import Plumb, has_engine
from .povray import Povray


def growth(rows):
    """Exponent p of render time ~ objects^p, least squares over the scenes of a family, by renderer and depth."""
    found = []
    for family in ("random", "sphereflake"):
        for depth in sorted({row["depth"] for row in rows}):
            of_family = [row for row in rows if row["family"] == family and row["depth"] == depth]
            for name in sorted({name for row in of_family for name in row["render_seconds"]}):
                points = [(math.log(row["objects"]), math.log(row["render_seconds"][name])) for row in of_family
                          if name in row["render_seconds"]]
                if len(points) >= 2:
                    found.append({"family": family, "depth": depth, "renderer": name, "scenes": len(points),
                                  "exponent": slope(points)})
    return found


def slope(points):
    mean_x, mean_y = (sum(values) / len(points) for values in zip(*points))
    return (sum((x - mean_x) * (y - mean_y) for x, y in points) / sum((x - mean_x) ** 2 for x, _ in points))


def per_object(rows):
    """Microseconds of building and reading, and bytes, by object of the text, where there are 1,000 or more."""
    found = []
    for row in rows:
        if row["distinct"] >= 1000 and row["depth"] == 1:
            scaled = lambda values, factor: {name: factor * value / row["distinct"] for name, value in values.items()}
            found.append({"scene": row["scene"], "build_us": scaled(row["build_seconds"], 1e6),
                          "read_us": scaled(row["read_seconds"], 1e6), "bytes": scaled(row["bytes"], 1)})
    return found


def threads(program, jobs, runs):
    """Wall time of the engine on one thread over that on two, in turn."""
    found = []
    if not has_engine(program):
        return found
    for job in jobs:
        walls = {1: [], 2: []}
        for _ in range(runs):
            for count, times in walls.items():
                times.append(Plumb(program, job, "engine", "double", count).measure()["wall"])
        found.append({"scene": os.path.basename(job.scene), "depth": job.depth, "one_s": median(walls[1]),
                      "two_s": median(walls[2]), "ratio": median(walls[1]) / median(walls[2])})
    return found


def whole_process(program, job, runs):
    """From start to written PNG, all threads on both sides; and the start alone."""
    Povray(program, job)
    commands = {
        "povray": ["povray", "+Iscene.pov", "+Owhole.png", f"+W{job.width}", f"+H{job.height}", "-D", "-A"],
        "plumb": [program, "render", job.scene, "--size", f"{job.width}x{job.height}", "--depth", str(job.depth), "-o",
                  "whole.png"],
        "plumb --version": [program, "--version"]}
    times = {name: [] for name in commands}
    for _ in range(runs):
        for name, command in commands.items():
            times[name].append(process.run(command, job.directory))
    found = {name: {"cpu_s": median(run.cpu for run in all_runs), "wall_s": median(run.wall for run in all_runs)}
             for name, all_runs in times.items()}
    found["ratio"] = {part: found["povray"][part + "_s"] / found["plumb"][part + "_s"] for part in ("cpu", "wall")}
    return found
