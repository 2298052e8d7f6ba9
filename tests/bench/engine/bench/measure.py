"""Times all renderers on one scene at one depth, in turn, several times."""

import os
from collections import namedtuple
from statistics import median

from .agreement import Agreement
from .embree import Embree
from .plumb import Plumb, has_engine
from .povray import Povray
from .process import Failed
from .tachyon import Tachyon

# `directory` is scratch space of this job alone; depth counts rays as plumb render --depth does: 1 is no secondary ray.
Job = namedtuple("Job", "scene directory width height depth")
Programs = namedtuple("Programs", "plumb embree")

REALS = ("double", "float")
MOST_OBJECTS_OF_TEXTBOOK = 100  # it tests every object: beyond, its time says nothing new


class Row:
    def __init__(self, programs, job, entry):
        self.programs, self.job, self.entry = programs, job, entry
        self.renderers, self.absent, self.times = [], {}, {}

    def check(self):
        """Prepares every renderer and keeps those whose pictures agree. Raises Failed when one of ours, Embree's or
        POV-Ray's does not; a renderer that cannot show the scene is absent, with the reason."""
        plumb, job = self.programs.plumb, self.job
        agreement = Agreement(plumb, job, self.entry.objects)
        povray = Povray(plumb, job)
        agreement.povray(povray)
        embree = Embree(self.programs.embree, job)
        for mode, picture in embree.pictures().items():
            agreement.others(f"embree-{mode}", picture)
        self.renderers = [povray, embree]
        self._add_tachyon(agreement)
        if self.entry.objects <= MOST_OBJECTS_OF_TEXTBOOK:
            self.renderers.append(Plumb(plumb, job, "textbook", "double"))
        if has_engine(plumb):
            for real in REALS:
                renderer = Plumb(plumb, job, "engine", real)
                agreement.engine(renderer, is_float=real == "float")
                self.renderers.append(renderer)
        self.agreement = agreement.results

    def _add_tachyon(self, agreement):
        try:
            tachyon = Tachyon(self.job)
            agreement.others(tachyon.name, tachyon.picture())
            self.renderers.append(tachyon)
        except Failed as reason:
            self.absent["tachyon"] = str(reason)

    def run_once(self):
        for renderer in self.renderers:
            self.times.setdefault(renderer.name, []).append(renderer.measure())

    def as_json(self):
        medians = {name: median(run["render"] for run in runs) for name, runs in self.times.items()}
        return {"scene": self.entry.name, "family": self.entry.family, "objects": self.entry.objects,
                "distinct": self.entry.distinct, "depth": self.job.depth,
                "size": [self.job.width, self.job.height], "agreement": self.agreement, "absent": self.absent,
                "runs": self.times, "render_seconds": medians, "embree_mode": self._best_mode(),
                "build_seconds": self._medians("build"), "read_seconds": self._medians("read"),
                "bytes": self._medians("bytes")}

    def _best_mode(self):
        best = min(self.times["embree"], key=lambda run: run["render"])["modes"]
        return min(best, key=best.get)

    def _medians(self, part):
        return {name: median(run[part] for run in runs) for name, runs in self.times.items()
                if all(run.get(part) is not None for run in runs)}


def scratch(parent, entry, depth):
    directory = os.path.join(parent, f"{entry.name}-{depth}")
    os.makedirs(directory, exist_ok=True)
    return directory
