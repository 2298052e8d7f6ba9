"""The sphereflake ("balls") of Eric Haines, "A Proposal for Standard Graphics Environments", IEEE CG&A 7(11), 1987:
every sphere carries nine of a third of its radius, six around its equator and three above, touching it. 1, 10, 91, 820,
7381, 66430, 597871 spheres, on a floor, seen from where the SPD's camera stands, with two of its three lights."""

import math

from . import text

UP = (0.0, 0.0, 1.0)


def _directions():
    """Nine of the twelve neighbours in the closest packing of equal spheres, without the three below."""
    equator = [(math.cos(a), math.sin(a), 0.0) for a in (math.radians(60 * i) for i in range(6))]
    flat, high = math.sqrt(1 / 3), math.sqrt(2 / 3)
    above = [(flat * math.cos(a), flat * math.sin(a), high) for a in (math.radians(30 + 120 * i) for i in range(3))]
    return equator + above


def _turned(vector, axis):
    """`vector`, turned as UP must be turned to become the unit vector `axis` (Rodrigues' formula)."""
    x, y, z = axis
    if z < -0.999999:
        return (vector[0], -vector[1], -vector[2])
    k = (-y, x)  # UP x axis, of length sin; the cosine is z
    along = (k[0] * vector[0] + k[1] * vector[1]) / (1 + z)
    cross = (k[1] * vector[2], -k[0] * vector[2], k[0] * vector[1] - k[1] * vector[0])
    return (z * vector[0] + cross[0] + along * k[0], z * vector[1] + cross[1] + along * k[1], z * vector[2] + cross[2])


def spheres(levels):
    """(center, radius) of all spheres, generation by generation."""
    directions = _directions()
    generation = [((0.0, 0.0, 0.0), 0.5, UP)]
    for level in range(levels + 1):
        yield from ((center, radius) for center, radius, _ in generation)
        if level < levels:
            generation = [_child(parent, _turned(d, parent[2])) for parent in generation for d in directions]


def _child(parent, direction):
    center, radius, _ = parent
    distance = radius * 4 / 3
    return (tuple(c + distance * d for c, d in zip(center, direction)), radius / 3, direction)


def scene(levels):
    lines = ["# Sphereflake of Haines' SPD (1987); made by tests/bench/engine/scenes.py",
             text.material("floor", (1, 0.75, 0.33), ambient=0.15, diffuse=0.7),
             text.material("ball", (1, 0.9, 0.7), ambient=0.1, diffuse=0.4, specular=0.3, m=12, mirror=0.3),
             text.box("floor", (-12, -12, -0.6), (12, 12, -0.5), "floor")]
    lines += [text.sphere(f"s{i}", center, radius, "ball") for i, (center, radius) in enumerate(spheres(levels))]
    lines += [text.light("a", (4, 3, 2), 0.6), text.light("b", (1, -4, 4), 0.6)]
    return lines + text.view((2.1, 1.3, 1.7), (0, 0, 0), 45, UP)
