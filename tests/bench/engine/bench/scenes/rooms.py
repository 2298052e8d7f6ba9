"""Small scenes as a lecture has them: ten objects on a table, and a room of mirrors and glass."""

from . import text


def lecture():
    """Ten objects: every kind of shape and transform, two lights, mirrors, no glass and no ellipsoid (Tachyon has none)."""
    return ["# Ten objects, as in a lecture; made by tests/bench/engine/scenes.py",
            text.material("table", (0.6, 0.45, 0.3), ambient=0.3, diffuse=0.8),
            text.material("wall", (0.7, 0.7, 0.75), ambient=0.3, diffuse=0.7),
            text.material("red", (0.8, 0.25, 0.2), ambient=0.2, diffuse=0.7, specular=0.3, m=30),
            text.material("green", (0.3, 0.7, 0.35), ambient=0.2, diffuse=0.7, specular=0.2, m=10),
            text.material("blue", (0.25, 0.4, 0.8), ambient=0.2, diffuse=0.7, specular=0.4, m=60),
            text.material("chrome", (0.8, 0.8, 0.8), ambient=0.05, diffuse=0.15, specular=0.4, m=80, mirror=0.6),
            text.box("table", (-4.1, -1.3, -9.2), (4.3, -1, -1.7), "table"),
            text.box("wall", (-4.3, -1.3, -9.6), (4.4, 3.1, -9.3), "wall"),
            text.sphere("ball", (-1.21, -0.13, -5.7), 0.87, "chrome"),
            text.sphere("marble1", (0.13, -0.61, -4.3), 0.39, "red"),
            text.sphere("marble2", (0.97, -0.71, -3.9), 0.29, "blue"),
            text.sphere("marble3", (-0.71, -0.69, -3.7), 0.31, "green"),
            text.sphere("lemon", (0, 0, 0), 1, "red"),
            text.box("block1", (-0.5, -0.5, -0.5), (0.5, 0.5, 0.5), "blue"),
            text.box("block2", (-0.5, -0.5, -0.5), (0.5, 0.5, 0.5), "green"),
            text.box("block3", (1.83, -1, -5.7), (2.57, -0.21, -4.9), "chrome"),
            text.transform("lemon", "scale", [0.53]),
            text.transform("lemon", "translate", [1.93, 0.4, -5.3]),
            text.transform("block1", "scale", [0.8, 1.5, 0.7]),
            text.transform("block1", "rotate", [29, 0, 1, 0]),
            text.transform("block1", "translate", [0.57, -0.25, -6.3]),
            text.transform("block2", "rotate", [-17, 0, 1, 0]),
            text.transform("block2", "translate", [-2.47, -0.5, -4.7]),
            text.light("window", (-4.1, 4.7, -0.9), 0.65), text.light("lamp", (2.9, 3.9, -2.7), 0.4),
            ] + text.view((0.11, 1.07, 0.3), (0.09, 0.33, -2.5), 55)


def room():
    """Three mirrors on the walls, two glass balls, a glass block and a chrome ball; the camera is inside the room."""
    return ["# A room of mirrors and glass; made by tests/bench/engine/scenes.py",
            text.material("wall", (0.8, 0.75, 0.65), ambient=0.2, diffuse=0.6),
            text.material("mirror", (0.7, 0.8, 0.8), ambient=0.02, diffuse=0.05, specular=0.2, m=40, mirror=0.8),
            text.material("glass", (0.8, 0.9, 0.9), ambient=0.02, diffuse=0.04, specular=0.3, m=80, mirror=0.1,
                          transmit=0.8, eta=1.5),
            text.material("chrome", (0.8, 0.8, 0.8), ambient=0.05, diffuse=0.1, specular=0.4, m=60, mirror=0.6),
            text.material("red", (0.8, 0.3, 0.2), ambient=0.2, diffuse=0.6, specular=0.3, m=25),
            text.box("room", (-2.53, -1.51, -6.71), (2.61, 1.93, 1.83), "wall"),
            text.box("left", (-2.47, -1.03, -5.91), (-2.39, 1.47, 0.93), "mirror"),
            text.box("right", (2.43, -1.07, -5.87), (2.51, 1.43, 0.91), "mirror"),
            text.box("back", (-2.1, -1.1, -6.67), (2.2, 1.4, -6.59), "mirror"),
            text.sphere("glass1", (-0.63, -0.71, -3.3), 0.59, "glass"),
            text.sphere("glass2", (1.13, -0.83, -2.7), 0.43, "glass"),
            text.sphere("chrome", (-1.43, -0.79, -4.9), 0.67, "chrome"),
            text.sphere("red", (0.31, -1.03, -5.1), 0.47, "red"),
            text.box("pane", (-0.43, -0.6, -0.21), (0.43, 0.6, 0.21), "glass"),
            text.box("block", (-0.4, -0.5, -0.4), (0.4, 0.5, 0.4), "red"),
            text.transform("pane", "rotate", [34, 0, 1, 0]), text.transform("pane", "translate", [0.43, -0.81, -3.9]),
            text.transform("block", "rotate", [21, 0, 1, 0]), text.transform("block", "translate", [1.63, -1, -4.6]),
            text.light("lamp", (0.37, 1.61, -2.9), 0.6), text.light("candle", (-1.9, 0.7, -0.6), 0.3),
            ] + text.view((1.57, 0.47, 0.3), (0.3, -0.1, -3), 66)
