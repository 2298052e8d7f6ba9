"""Spheres and boxes at random places in a cube, one half each, every fifth a mirror; alone, or as a composite of which
moved, turned and scaled copies fill the cube."""

import random

from . import text

COLOURS = [(0.9, 0.3, 0.25), (0.3, 0.8, 0.35), (0.3, 0.45, 0.9), (0.85, 0.8, 0.3), (0.8, 0.8, 0.8)]


def materials():
    lines = [text.material(f"m{i}", c, ambient=0.1, diffuse=0.5, specular=0.2, m=20) for i, c in enumerate(COLOURS[:4])]
    return lines + [text.material("m4", COLOURS[4], ambient=0.05, diffuse=0.2, specular=0.3, m=40, mirror=0.5)]


def objects(count, rng, half_edge=1.0):
    """Their sizes fall with the cube root of their number: the share of the volume that they fill is the same."""
    size = 0.6 * half_edge / count ** (1 / 3)
    lines = []
    for i in range(count):
        center = [rng.uniform(-half_edge, half_edge) for _ in range(3)]
        of = f"m{rng.randrange(len(COLOURS))}"
        if i % 2 == 0:
            lines.append(text.sphere(f"o{i}", center, size * rng.uniform(0.5, 1), of))
        else:
            half = [size * rng.uniform(0.4, 0.8) for _ in range(3)]
            low, high = zip(*((c - h, c + h) for c, h in zip(center, half)))
            lines.append(text.box(f"o{i}", low, high, of))
    return lines


def _frame(body, what):
    return ([f"# {what}; made by tests/bench/engine/scenes.py"] + materials() + body +
            [text.light("a", (3, 5, 4), 0.7), text.light("b", (-4, 3, 2.5), 0.4)] +
            text.view((2.3, 1.7, 3.1), (0, 0, 0), 44))


def scene(count):
    return _frame(objects(count, random.Random(count)), f"{count} random spheres and boxes")


def instances(copies, count):
    rng = random.Random(copies * count)
    body = objects(count, rng)
    body.append(text.composite("group", [f"o{i}" for i in range(count)]))
    size = 0.75 / copies ** (1 / 3)
    for i in range(copies):
        axis = [rng.uniform(-1, 1) for _ in range(3)]
        body += [text.composite(f"c{i}", ["group"]),
                 text.transform(f"c{i}", "scale", [size * rng.uniform(0.5, 1)]),
                 text.transform(f"c{i}", "rotate", [rng.uniform(0, 360)] + axis),
                 text.transform(f"c{i}", "translate", [rng.uniform(-1, 1) for _ in range(3)])]
    return _frame(body, f"{copies} copies of a composite of {count} random spheres and boxes")
