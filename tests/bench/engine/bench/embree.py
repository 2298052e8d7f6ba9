"""Our program around Embree 3 (embree/), in float, every mode in one process."""

import json
import os

from . import process


class Embree:
    name = "embree"

    def __init__(self, program, job):
        self.directory = job.directory
        self.command = [program, job.scene, "--depth", str(job.depth), "--width", str(job.width), "--height",
                        str(job.height)]

    def pictures(self):
        """Path by mode."""
        modes = json.loads(process.run(self.command + ["-o", "embree-"], self.directory).output)["modes"]
        return {mode: os.path.join(self.directory, f"embree-{mode}.pfm") for mode in modes}

    def measure(self):
        """The best mode counts; what it was, and all of them, are kept."""
        result = json.loads(process.run(self.command, self.directory).output)
        modes = {mode: times["cpu"] for mode, times in result["modes"].items()}
        return {"render": min(modes.values()), "build": result["build"]["cpu"], "bytes": result["bytes"],
                "modes": modes}
