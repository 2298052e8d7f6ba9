"""Lines of a scene file in Plumb's course grammar; every length with seven digits, as float32 has."""


def numbers(values):
    return " ".join(format(value, ".7g") for value in values)


def material(name, colour, ambient=0.2, diffuse=0.7, specular=0.0, m=1, mirror=0.0, transmit=0.0, eta=1.0):
    """ka and kd are multiples of one colour, all other weights are grey: other renderers' materials are no richer."""
    words = ["define material", name, numbers(ambient * c for c in colour), numbers(diffuse * c for c in colour),
             numbers([specular] * 3), str(m)]
    if mirror:
        words.append("mirror " + numbers([mirror] * 3))
    if transmit:
        words.append("transmit " + numbers([transmit] * 3) + " eta " + numbers([eta]))
    return " ".join(words)


def sphere(name, center, radius, of):
    return f"define shape sphere {name} {numbers(center)} {numbers([radius])} {of}"


def box(name, low, high, of):
    return f"define shape box {name} {numbers(low)} {numbers(high)} {of}"


def composite(name, children):
    return f"define shape composite {name} " + " ".join(children)


def transform(name, kind, values):
    return f"transform {name} {kind} {numbers(values)}"


def light(name, position, brightness):
    return f"define light {name} {numbers(position)} 1 1 1 {numbers([brightness])}"


def view(eye, at, fov_x_degrees, up=(0, 1, 0)):
    """Camera, ambient light and size, 640 x 480 as in all measurements; the background is black, because Tachyon adds
    it, unweighted, where the recursion ends, and ours is black there."""
    direction = [b - a for a, b in zip(eye, at)]
    return ["ambient 1 1 1", "background 0 0 0",
            f"define camera eye {numbers([fov_x_degrees])} {numbers(eye)} {numbers(direction)} {numbers(up)}",
            "render eye image.ppm 640 480"]
