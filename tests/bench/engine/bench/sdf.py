"""Reads the scene files that make-scenes writes: no dialects, no defaults, nothing beyond what they hold."""

import math
from collections import namedtuple

Material = namedtuple("Material", "ka kd ks m mirror transmit")
Shape = namedtuple("Shape", "kind numbers material children")
IDENTITY = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0))  # rows of an affine map


class Scene:
    def __init__(self, path):
        self.materials, self.shapes, self.transforms, self.lights = {}, {}, {}, []
        with open(path, encoding="ascii") as file:
            for line in file:
                words = line.split("#")[0].split()
                if words:
                    self._statement(words)

    def _statement(self, words):
        if words[0] == "define":
            getattr(self, "_" + words[1])(words[2:])
        elif words[0] == "ambient":
            self.ambient = _floats(words[1:])
        elif words[0] == "transform":
            kept = self.transforms.get(words[1], IDENTITY)
            self.transforms[words[1]] = compose(_step(words[2], _floats(words[3:])), kept)

    def _material(self, words):
        n = _floats(words[1:11])
        extra = dict(zip(words[11::4], (_floats(words[i:i + 3]) for i in range(12, len(words), 4))))
        none = [0.0, 0.0, 0.0]
        self.materials[words[0]] = Material(n[0:3], n[3:6], n[6:9], n[9], extra.get("mirror", none),
                                            extra.get("transmit", none))

    def _shape(self, words):
        kind, name = words[0], words[1]
        if kind == "composite":
            self.shapes[name] = Shape(kind, None, None, words[2:])
        else:
            self.shapes[name] = Shape(kind, _floats(words[2:-1]), words[-1], ())

    def _light(self, words):
        n = _floats(words[1:])
        self.lights.append((n[0:3], [n[6] * c for c in n[3:6]]))

    def _camera(self, words):
        n = _floats(words[1:])
        self.fov_x_degrees, self.eye, self.direction, self.up = n[0], n[1:4], n[4:7], n[7:10]

    def leaves(self):
        """(shape, world_from_object) of every sphere and box, once per path."""
        children = {child for shape in self.shapes.values() for child in shape.children}
        for name in self.shapes:
            if name not in children:
                yield from self._below(name, IDENTITY)

    def _below(self, name, parent):
        shape = self.shapes[name]
        own = self.transforms.get(name)
        here = parent if own is None else compose(parent, own)
        if shape.kind != "composite":
            yield shape, here
        for child in shape.children:
            yield from self._below(child, here)


def _floats(words):
    return [float(word) for word in words]


def compose(then, first):
    return tuple(tuple(sum(row[k] * first[k][column] for k in range(3)) + (row[3] if column == 3 else 0.0)
                       for column in range(4)) for row in then)


def moved(matrix, point):
    return [sum(a * b for a, b in zip(row, point)) + row[3] for row in matrix]


def _step(kind, n):
    if kind == "translate":
        return tuple(tuple(row[:3]) + (by,) for row, by in zip(IDENTITY, n))
    if kind == "scale":
        n = n * 3 if len(n) == 1 else n
        return tuple(tuple(n[i] * value for value in IDENTITY[i]) for i in range(3))
    return _rotation(n[0], n[1:])


def _rotation(degrees, axis):
    """Rodrigues' formula."""
    length = math.sqrt(sum(a * a for a in axis))
    x, y, z = (a / length for a in axis)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    q = 1 - c
    return ((q * x * x + c, q * x * y - s * z, q * x * z + s * y, 0.0),
            (q * x * y + s * z, q * y * y + c, q * y * z - s * x, 0.0),
            (q * x * z - s * y, q * y * z + s * x, q * z * z + c, 0.0))
