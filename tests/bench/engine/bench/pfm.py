"""Linear float pictures, as plumb writes them."""

import array
import sys


def values(path):
    """All values of a colour PFM: r g b of each pixel, the lowest row first."""
    with open(path, "rb") as file:
        if file.readline() != b"PF\n":
            raise ValueError(f"{path}: expected a colour PFM")
        width, height = (int(word) for word in file.readline().split())
        is_little = float(file.readline()) < 0
        floats = array.array("f", file.read(12 * width * height))
    if is_little != (sys.byteorder == "little"):
        floats.byteswap()
    return floats
