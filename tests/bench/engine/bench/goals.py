"""The figures that the engine is to reach, each with what was measured; None where nothing was."""

from collections import namedtuple

from .table import faster, geometric_mean

# `measured` is the value nearest to failing, or a geometric mean where the title says so.
Goal = namedtuple("Goal", "title target at_least measured")


def goals(result):
    rows = result["rows"]
    return list(_speeds(rows)) + list(_beside(result))


def is_met(goal):
    return goal.measured >= goal.target if goal.at_least else goal.measured <= goal.target


def _speeds(rows):
    instances = [row for row in rows if row["family"] == "instances"]
    plain = [row for row in rows if row["family"] != "instances"]
    for low, high, target in ((1, 100, 25), (1e3, 1e4, 15), (1e5, 1e6, 10)):
        # A sphereflake's floor is not counted; 66,430 and 597,871 spheres belong to the class of 1e5..1e6.
        members = [row for row in plain if low <= row["objects"] <= high or high == 1e6 and 5e4 < row["objects"] <= low]
        yield Goal(f"double / POV-Ray, {low:g} to {high:g} objects", target, True,
                   _least(faster(row, "engine-double", "povray") for row in members))
    yield Goal("double / POV-Ray, instances", 12, True,
               _least(faster(row, "engine-double", "povray") for row in instances))
    yield Goal("double / Embree", 1, True, _least(faster(row, "engine-double", "embree") for row in rows))
    yield Goal("double / Tachyon", 5, True, _least(faster(row, "engine-double", "tachyon") for row in rows))
    for name, than, title, target in (("engine-double", "povray", "double / POV-Ray", 15),
                                      ("engine-double", "embree", "double / Embree", 2.5),
                                      ("engine-float", "embree", "float / Embree", 4),
                                      ("engine-float", "engine-double", "float / double", 1.8)):
        yield Goal(title + ", geometric mean", target, True, geometric_mean(faster(row, name, than) for row in rows))


def _beside(result):
    ours = "engine-double"
    yield Goal("two threads against one", 1.85, True, _least(found["ratio"] for found in result["threads"]))
    yield Goal("exponent of growth", 0.15, False,
               _most(found["exponent"] for found in result["growth"] if found["renderer"] == ours))
    for part, title, target in (("build_us", "build, us an object", 0.5), ("read_us", "reading, us an object", 0.3)):
        yield Goal(title, target, False, _most(found[part].get(ours) for found in result["per_object"]))
    yield Goal("bytes a sphere", 100, False, _most(found["bytes"].get(ours) for found in result["per_object"]
                                                    if found["scene"].startswith("sphereflake")))
    whole = result["whole_process"]
    if whole:
        yield Goal("plumb --version, s of CPU", 0.005, False, whole["plumb --version"]["cpu_s"])
        yield Goal("whole process, wall time of povray / plumb", 40, True, whole["ratio"]["wall"])
        yield Goal("whole process, CPU of povray / plumb", 20, True, whole["ratio"]["cpu"])


def _least(values):
    return min((value for value in values if value is not None), default=None)


def _most(values):
    return max((value for value in values if value is not None), default=None)
