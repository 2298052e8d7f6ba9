"""POV-Ray: the scene that `plumb export` writes, without antialiasing, on one thread."""

import os
import re

from . import process

# Of its statistics: "Trace Time: ... (0.525 seconds)", then "using 1 thread(s) with 0.485 CPU-seconds total".
TIMES = re.compile(r"(Parse|Bounding|Trace) Time:.*\((\d+\.\d+) seconds\)\s*\n\s*using \d+ thread\(s\) with "
                   r"(\d+\.\d+) CPU-seconds")


class Povray:
    name = "povray"

    def __init__(self, plumb, job):
        """Exports the scene once; Raises Failed when that cannot be done."""
        self.directory = job.directory
        self.pov = os.path.join(job.directory, "scene.pov")
        process.run([plumb, "export", job.scene, "--depth", str(job.depth), "-o", self.pov], job.directory)
        self.options = ["+Iscene.pov", f"+W{job.width}", f"+H{job.height}", "-D", "-A", "+WT1", "File_Gamma=1.0", "-GD",
                        "-GR"]

    def picture(self):
        process.run(["povray", *self.options, "+Opovray.png", "+FN16"], self.directory)
        return os.path.join(self.directory, "povray.png")

    def measure(self):
        """CPU seconds of tracing, as POV-Ray itself counts them, and of parsing and bounding."""
        times = {what: float(cpu) for what, _, cpu in TIMES.findall(
            process.run(["povray", *self.options, "-F"], self.directory).output)}
        if "Trace" not in times:
            raise process.Failed("POV-Ray printed no trace time")
        return {"render": times["Trace"], "build": times.get("Bounding", 0.0), "read": times.get("Parse", 0.0)}


def version():
    return re.search(r"POV-Ray (\S+)", process.run(["povray", "--version"]).output).group(1)
