"""Draws the JSON of `plumb chart`: plot.py CHART.json FILE.svg|FILE.png ...; --check only looks for matplotlib."""

import json
import math
import os
import sys
import tempfile

os.environ.setdefault("MPLCONFIGDIR", tempfile.gettempdir())  # its cache of fonts, removed with plumb's directory
try:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError as error:
    sys.exit(f"matplotlib is missing ({error}): apt-get install python3-matplotlib")

# Okabe and Ito, "Color Universal Design", 2008: told apart by the colour-blind; the marker tells the renderer, too.
STYLES = {"engine": ("#0072B2", "o"), "textbook": ("#D55E00", "s"), "povray": ("#009E73", "^")}
NAMES = {"engine": "engine", "textbook": "textbook tracer", "povray": "POV-Ray"}
DOMINATED, DOMINATED_TEXT = "#C4C4C4", "#606060"
COLUMNS = {"pixel_centres": "exactness", "pixel_areas": "sampling"}
SCENE_WIDTH, LABEL_STEP, FONT = 10.6, 0.155, 8.5  # inches, inches, points


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
        title += f", {point['error']['non_finite']} not finite"
    return title


def floor_of(points):
    """Where an error of 0 is drawn: a decade below the smallest other."""
    errors = [p["error"]["rms"] for p in points if p["error"]["rms"] > 0]
    return 10.0 ** (math.floor(math.log10(min(errors))) - 1) if errors else 1e-10


def draw_front(axes, points, height):
    front = sorted((p["ratio"]["median"], height(p)) for p in points if p["pareto"])
    right = axes.get_xlim()[1]
    xs = [x for x, _ in front] + [right]
    ys = [y for _, y in front] + [front[-1][1]]
    axes.step(xs, ys, where="post", color="black", linewidth=1, zorder=1)


def draw_points(axes, points, height):
    for point in points:
        color, marker = STYLES[point["renderer"]]
        face = color if point["pareto"] else DOMINATED
        edge = "white" if point["pareto"] else color
        ratio = point["ratio"]
        spread = [[ratio["median"] - ratio["min"]], [ratio["max"] - ratio["median"]]]
        axes.errorbar(ratio["median"], height(point), xerr=spread, fmt=marker, markersize=6.5, color=face,
                      markeredgecolor=edge, markeredgewidth=0.7, ecolor=face, elinewidth=1.2, capsize=2.5,
                      zorder=4 if point["pareto"] else 3)


def draw_labels(axes, points, height, counts):
    """In a column beside the panel, in the order of the errors, each with a line to its point."""
    inches = axes.get_position().height * axes.figure.get_size_inches()[1]
    fraction = lambda p: axes.transAxes.inverted().transform(axes.transData.transform((1, height(p))))[1]
    ordered = sorted(points, key=lambda p: (height(p), -p["ratio"]["median"]))
    places = least_gap([fraction(p) for p in ordered], LABEL_STEP / inches, 0.0, 1.0)
    for point, place in zip(ordered, places):
        color = STYLES[point["renderer"]][0] if point["pareto"] else DOMINATED_TEXT
        line = {"arrowstyle": "-", "linewidth": 0.5, "color": color if point["pareto"] else "#C8C8C8", "shrinkA": 1,
                "shrinkB": 3, "relpos": (0, 0.5)}
        axes.annotate(label_of(point, counts), (point["ratio"]["median"], height(point)), xytext=(1.06, place),
                      textcoords="axes fraction", va="center", color=color, arrowprops=line, annotation_clip=False,
                      fontweight="bold" if point["pareto"] else "normal", zorder=2)


def draw_panel(axes, points, against):
    floor = floor_of(points)
    height = lambda point: point["error"]["rms"] or floor
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(0.6, 2 * max(p["ratio"]["max"] for p in points))
    top = max(height(p) for p in points)
    axes.set_ylim(floor / 2.5 if any(p["error"]["rms"] == 0 for p in points) else floor * 4, top * 4)
    axes.grid(which="major", color="#ECECEC", linewidth=0.7, zorder=0)
    axes.spines[["top", "right"]].set_visible(False)
    if any(p["error"]["rms"] == 0 for p in points):
        axes.axhline(floor, color="#808080", linewidth=0.8, linestyle=(0, (2, 2)), zorder=1)
        ticks = [t for t in axes.get_yticks() if 1.5 * floor < t < 4 * top]
        axes.set_yticks([floor] + ticks[:: 1 + len(ticks) // 6])
        axes.set_yticklabels(["0"] + [f"$10^{{{round(math.log10(t))}}}$" for t in axes.get_yticks()[1:]])
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.minorticks_off()
    draw_front(axes, points, height)
    draw_points(axes, points, height)
    draw_labels(axes, points, height, against == "pixel_centres")


def titles_of(chart):
    return {"pixel_centres": "Exactness: one sample a pixel, RMS error against 113 bits\n"
                             f"(in brackets: pixels of {chart['size']['width']:,} x {chart['size']['height']:,} off by "
                             "over 1e-6)",
            "pixel_areas": "Sampling: RMS error against the mean over the\npixel's area (1024 samples)"}


def rows_of(chart):
    """Scenes a row: one, or two on a page of many."""
    return 1 if len(chart["scenes"]) <= 4 else 2


def height_of(scene):
    count = max(sum(p["against"] == against for p in drawn(scene["points"])) for against in COLUMNS)
    return max(1.7, count * LABEL_STEP)


def draw_scene(figure, scene, left, bottom, height, titles):
    """`left`, `bottom` and `height`, of the panels, in inches."""
    width, total = figure.get_size_inches()
    for column, against in enumerate(COLUMNS):
        at = (left + 0.65 + 5.3 * column) / width
        axes = figure.add_axes([at, bottom / total, 2.55 / width, height / total])
        points = [p for p in drawn(scene["points"]) if p["against"] == against]
        draw_panel(axes, points, against)
        axes.set_xlabel("processor time, times that of the fastest", labelpad=2)
        if titles:
            axes.annotate(titles[against], (-0.17, 1), xytext=(0, 26), textcoords="offset points",
                          xycoords="axes fraction", fontsize=9.5, va="bottom")
        if column == 0:
            axes.annotate(scene["scene"], (-0.17, 1), xytext=(0, 10), textcoords="offset points",
                          xycoords="axes fraction", fontsize=9.5, fontweight="bold", va="bottom")


def draw_legend(figure, chart):
    kinds = [k for k in STYLES if any(p["renderer"] == k for s in chart["scenes"] for p in s["points"])]
    marks = [matplotlib.lines.Line2D([], [], color=STYLES[k][0], marker=STYLES[k][1], linestyle="", label=NAMES[k])
             for k in kinds]
    marks.append(matplotlib.lines.Line2D([], [], color="black", linewidth=1, label="Pareto front: nothing is faster and as exact"))
    marks.append(matplotlib.lines.Line2D([], [], color=DOMINATED, marker="o", markeredgecolor="#606060",
                                         markeredgewidth=0.7, linestyle="", label="dominated"))
    figure.legend(handles=marks, loc="upper left", ncol=len(marks), frameon=False, fontsize=9.5, columnspacing=1.6,
                  handletextpad=0.4, bbox_to_anchor=(0, 1 - 0.02 / figure.get_size_inches()[1]))
    runs = f"median and range of {chart['runs']} runs" if chart["runs"] > 1 else "one run"
    figure.text(0.01, 0.08 / figure.get_size_inches()[1], f"plumb {chart['plumb']}, {chart['machine']}; {runs}; "
                "one thread; POV-Ray without its start", fontsize=8, color=DOMINATED_TEXT, va="bottom")


def draw(chart):
    across = rows_of(chart)
    scenes = chart["scenes"]
    rows = [scenes[i:i + across] for i in range(0, len(scenes), across)]
    heights = [max(height_of(s) for s in row) for row in rows]
    total = 0.35 + 0.35 + sum(heights) + 0.85 * len(rows) + 0.3
    figure = pyplot.figure(figsize=(SCENE_WIDTH * across, total))
    draw_legend(figure, chart)
    top = total - 0.35 - 0.35
    for number, (row, height) in enumerate(zip(rows, heights)):
        top -= 0.4 + height
        for column, scene in enumerate(row):
            draw_scene(figure, scene, SCENE_WIDTH * column, top, height, titles_of(chart) if number == 0 else None)
        top -= 0.45
    return figure


def main(arguments):
    if arguments == ["--check"]:
        return
    with open(arguments[0], encoding="utf-8") as file:
        chart = json.load(file)
    matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "plumb", "font.size": FONT,
                                "axes.linewidth": 0.7, "font.family": "DejaVu Sans"})
    figure = draw(chart)
    for path in arguments[1:]:
        # No date: the same figures give the same bytes.
        figure.savefig(path, dpi=150, metadata={"Date": None} if path.endswith(".svg") else None)


if __name__ == "__main__":
    main(sys.argv[1:])
