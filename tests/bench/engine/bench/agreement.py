"""Only renderers whose pictures agree are timed."""

from . import plumb, process
from .plumb import Plumb

# Doubles against doubles. Because spheres that touch are ties, which rounding decides: 1 pixel in 100,000 may differ. Where
# more do, long double decides: five mirrors among 597,871 spheres magnify the rounding of either double to 1e-6.
EXACT, TIES = 1e-6, 1e-5
# Others: 99 % of the pixels within 2/255. Because float (Embree, our float kernels) and fixed offsets (Tachyon) move
# silhouettes and edges of shadows by less than a pixel, and five mirrors among 597,871 small spheres magnify that: 0.7 % of
# the pixels there; Tachyon drops terms below 0.001; POV-Ray's and Tachyon's files hold 16 bits, clamped at 1.
LOOSE, EDGES = 2 / 255, 1e-2
# Textbook pictures cost objects x pixels: beyond these the exact check is made on a smaller picture of the same view.
MOST_TESTS = 4e8


def size_of_exact_check(job, objects):
    shrink = max(1, objects * job.width * job.height / MOST_TESTS) ** 0.5
    return max(8, round(job.width / shrink)), max(6, round(job.height / shrink))


def is_full_size(job, objects):
    return size_of_exact_check(job, objects) == (job.width, job.height)


class Agreement:
    """Checks one scene at one depth; `results` says what was compared and how many pixels differ."""

    def __init__(self, program, job, objects):
        self.program, self.job, self.results = program, job, {}
        self.small = size_of_exact_check(job, objects)
        self.textbook = Plumb(program, job, "textbook", "double", threads=2).picture(self.small)
        # POV-Ray's picture stands in where the textbook's is too dear; plumb verify shows that these agree.
        self.reference = self.textbook if is_full_size(job, objects) else None

    def povray(self, renderer):
        picture = renderer.picture()
        if self.reference is None:
            self.reference = picture
            self.results[renderer.name] = {"is_reference": True}
        else:
            self._check(renderer.name, self.reference, picture, LOOSE, EDGES)

    def others(self, name, picture):
        self._check(name, self.reference, picture, LOOSE, EDGES)

    def engine(self, renderer, is_float):
        if is_float:
            return self._check(renderer.name, self.reference, renderer.picture(), LOOSE, EDGES)
        picture = renderer.picture(self.small)
        try:
            return self._check(renderer.name, self.textbook, picture, EXACT, TIES)
        except process.Failed:
            exact = Plumb(self.program, self.job, "textbook", "long-double", threads=2).picture(self.small)
            return self._check(renderer.name, exact, picture, EXACT, TIES)

    def _check(self, name, reference, picture, tolerance, share):
        over, pixels = plumb.pixels_over(self.program, reference, picture, tolerance, self.job.directory)
        self.results[name] = {"tolerance": tolerance, "pixels": pixels, "over": over, "allowed_share": share}
        if over > share * pixels:
            raise process.Failed(f"{name} and the reference differ by more than {tolerance:g} on {over} of {pixels} "
                                 f"pixels ({self.job.scene}, depth {self.job.depth}); expected at most {share:.3%}")
