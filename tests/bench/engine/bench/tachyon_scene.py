"""A scene as Tachyon's text. Not representable, and refused: glass, for Tachyon does not bend rays; ellipsoids; colours of
one material that are no multiples of each other; coloured highlights and mirrors."""

import math

from . import process, sdf

MOST_TRIANGLES = 1_000_000  # beyond, writing and reading the text take minutes


def text(scene, job):
    """z is negated: Tachyon's space is left-handed."""
    yield "BEGIN_SCENE\n" + f"RESOLUTION {job.width + 1} {job.height + 1}\n"
    yield camera(scene, job)
    yield "BACKGROUND 0 0 0\n"
    for position, colour in scene.lights:
        yield f"LIGHT CENTER {_point(position)} RAD 0.00001 COLOR {_numbers(colour)}\n"
    for name, material in scene.materials.items():
        yield texture(name, material, scene.ambient)
    triangles = 0
    for shape, matrix in scene.leaves():
        if shape.kind == "sphere":
            yield sphere(shape, matrix)
        else:
            triangles += 12
            if triangles > MOST_TRIANGLES:
                raise process.Failed("Tachyon has no instances, and this many boxes are too many triangles")
            yield box(shape, matrix)
    yield "END_SCENE\n"


def camera(scene, job):
    """Tachyon's rays go through the corners of pixels, ours through the centres: in a picture that is one pixel wider and
    higher they are the same. Its image plane has the height 1 / ZOOM at distance 1."""
    distance = 0.5 / math.tan(math.radians(scene.fov_x_degrees) / 2)
    zoom = distance * job.width / (job.height + 1)
    return (f"CAMERA ZOOM {zoom:.9g} ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH {job.depth} CENTER {_point(scene.eye)} "
            f"VIEWDIR {_point(scene.direction)} UPDIR {_point(scene.up)} END_CAMERA\n")


def texture(name, material, ambient):
    grey = lambda colour: colour[0] == colour[1] == colour[2]
    if any(material.transmit):
        raise process.Failed("Tachyon does not bend rays in glass")
    if not grey(material.ks) or not grey(material.mirror):
        raise process.Failed("Tachyon has no coloured highlights and mirrors")
    shares = [a * i / d for a, i, d in zip(material.ka, ambient, material.kd) if d > 0]
    if not shares or max(shares) - min(shares) > 1e-5:
        raise process.Failed("Tachyon has one colour a material: ka and kd are no multiples of each other")
    # No highlight where ks is 0; Tachyon skips what is below 0.001.
    return (f"TEXDEF {name} AMBIENT {shares[0]:.9g} DIFFUSE 1 SPECULAR {material.mirror[0]:.9g} OPACITY 1 "
            f"PHONG PLASTIC {material.ks[0]:.9g} PHONG_SIZE {material.m:.9g} COLOR {_numbers(material.kd)} TEXFUNC 0\n")


def sphere(shape, matrix):
    factors = [math.sqrt(sum(row[i] ** 2 for row in matrix)) for i in range(3)]
    if max(factors) - min(factors) > 1e-6 * max(factors):
        raise process.Failed("Tachyon has no ellipsoids")
    return (f"SPHERE CENTER {_point(sdf.moved(matrix, shape.numbers[:3]))} RAD {factors[0] * shape.numbers[3]:.9g} "
            f"{shape.material}\n")


def box(shape, matrix):
    """Twelve triangles: Tachyon's own box is turned no way, and its normals are right for cubes alone."""
    low, high = shape.numbers[:3], shape.numbers[3:]
    corners = [_point(sdf.moved(matrix, [(high if i >> axis & 1 else low)[axis] for axis in range(3)]))
               for i in range(8)]
    lines = []
    for a, b, c, d in ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)):
        for i, j, k in ((a, b, c), (a, c, d)):
            lines.append(f"TRI V0 {corners[i]} V1 {corners[j]} V2 {corners[k]} {shape.material}\n")
    return "".join(lines)


def _numbers(values):
    return " ".join(format(value, ".9g") for value in values)


def _point(p):
    return _numbers((p[0], p[1], -p[2]))
