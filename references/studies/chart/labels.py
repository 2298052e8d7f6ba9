"""Which points of a chart are drawn, what they are called, and where their names go."""

import json


def least_gap(wanted, gap, low, high):
    """The places nearest to the wanted ones (ascending) that are `gap` apart, between low and high."""
    pools = []  # of [sum, count]: pool adjacent violators (Ayer et al. 1955)
    for index, place in enumerate(wanted):
        pools.append([place - index * gap, 1])
        while len(pools) > 1 and pools[-2][0] / pools[-2][1] >= pools[-1][0] / pools[-1][1]:
            total, count = pools.pop()
            pools[-1][0] += total
            pools[-1][1] += count
    free = [total / count for total, count in pools for _ in range(count)]
    top = max(high - (len(wanted) - 1) * gap, low)
    return [min(max(place, low), top) + index * gap for index, place in enumerate(free)]


def drawn(points):
    """Of textbook tracers in one real type that make pictures of the same error, one: sets that a scene has no use for."""
    groups = {}
    for point in points:
        same = json.dumps(point["error"]) + point["real"] if point["renderer"] == "textbook" else point["id"]
        groups.setdefault(same, []).append(point)
    for alike in groups.values():
        lecture = next((p for p in alike if p["methods"] == "lecture"), alike[0])
        shown = next((p for p in alike if p["pareto"]), lecture)
        others = f" + {len(alike) - 1} alike" if len(alike) > 1 else ""
        yield {**shown, "title": shown["title"] + others}


def label_of(point, counts):
    title = point["title"]
    if counts:
        title += f" ({point['error']['pixels_over']:,})"
    if point["error"]["non_finite"]:
        title += f", {point['error']['non_finite']:,} not finite"
    elif point["fails"]:
        title += f", RMS {point['error']['rms']:.0e}"
    return title


def weight_of(point):
    return "bold" if point["pareto"] else "normal"
