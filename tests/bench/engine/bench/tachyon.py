"""Tachyon, on one thread, with the classic Phong model."""

import os
import re

from . import process, sdf, tachyon_scene

TIME = re.compile(r"(Scene Parsing|Preprocessing|Ray Tracing) Time:\s*(\d+\.\d+) seconds")


class Tachyon:
    name = "tachyon"

    def __init__(self, job):
        """Converts the scene once. Raises Failed when Tachyon cannot show it."""
        self.directory = job.directory
        path = os.path.join(job.directory, "tachyon.dat")
        with open(path, "w", encoding="ascii") as file:
            file.writelines(tachyon_scene.text(sdf.Scene(job.scene), job))
        self.command = ["tachyon", "tachyon.dat", "-numthreads", "1", "-fullshade", "-shade_phong"]

    def picture(self):
        process.run(self.command + ["-format", "PPM48", "-o", "tachyon.ppm"], self.directory)
        path = os.path.join(self.directory, "tachyon.ppm")
        crop(path)
        return path

    def measure(self):
        """Tachyon prints wall times: each is taken times the share of its wall time that the process had the CPU."""
        run = process.run(self.command + ["-nosave"], self.directory)
        times = {what: float(wall) * min(1, run.cpu / run.wall) for what, wall in TIME.findall(run.output)}
        if "Ray Tracing" not in times:
            raise process.Failed("Tachyon printed no ray tracing time")
        return {"render": times["Ray Tracing"], "build": times.get("Preprocessing", 0.0),
                "read": times.get("Scene Parsing", 0.0)}


def crop(path):
    """Cuts the extra column at the right and the extra row at the top off a 48-bit PPM; see tachyon_scene.camera."""
    with open(path, "rb") as file:
        _, size, _ = (file.readline() for _ in range(3))
        width, height = map(int, size.split())
        rows = [file.read(6 * width)[:-6] for _ in range(height)]
    with open(path, "wb") as file:
        file.write(f"P6\n{width - 1} {height - 1}\n65535\n".encode() + b"".join(rows[1:]))


def version():
    return re.search(r"^(\d\S*)", process.run(["tachyon", "-version"], exits=(0, 255)).output).group(1)
