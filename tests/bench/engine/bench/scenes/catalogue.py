"""All scenes of the benchmark by name, smallest first."""

import os
from collections import namedtuple

from . import random_objects, rooms, sphereflake

# `objects` counts spheres and boxes as they stand in the world, `distinct` those in the text. `family` tells which
# scenes differ in their number of objects alone.
Entry = namedtuple("Entry", "name objects distinct family make")


def _entries():
    yield Entry("lecture", 10, 10, "room", rooms.lecture)
    yield Entry("room", 10, 10, "room", rooms.room)
    for levels in (2, 4, 5, 6):
        count = sum(9 ** i for i in range(levels + 1))
        yield Entry(f"sphereflake-{count}", count + 1, count + 1, "sphereflake",
                    lambda levels=levels: sphereflake.scene(levels))
    for count in (10, 100, 1000, 10_000, 100_000, 1_000_000):
        yield Entry(f"random-{count}", count, count, "random", lambda count=count: random_objects.scene(count))
    for copies in (10, 1000):
        yield Entry(f"instances-{copies}x1000", copies * 1000, 1000, "instances",
                    lambda copies=copies: random_objects.instances(copies, 1000))


SCENES = sorted(_entries(), key=lambda entry: entry.objects)


def write(path, lines):
    """Aside, then renamed."""
    with open(path + ".part", "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")
    os.replace(path + ".part", path)
