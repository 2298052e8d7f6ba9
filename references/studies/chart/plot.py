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

from labels import drawn, label_of, least_gap, weight_of

matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "plumb", "font.size": 8.5, "axes.linewidth": 0.7,
                            "hatch.linewidth": 0.5, "font.family": "sans-serif"})

# Okabe and Ito, "Color Universal Design", 2008: told apart by the colour-blind; the marker tells the renderer, too.
STYLES = {"engine": ("#0072B2", "o"), "textbook": ("#D55E00", "s"), "povray": ("#009E73", "^")}
NAMES = {"engine": "engine", "textbook": "textbook tracer", "povray": "POV-Ray"}
DOMINATED, DOMINATED_TEXT = "#C4C4C4", "#606060"
COLUMNS = {"pixel_centres": "exactness", "pixel_areas": "sampling"}
LABEL_STEP = 0.155  # inches
LEFT, PANEL, GAP, RIGHT = 0.65, 2.9, 0.2, 0.25  # inches, of a column: its ticks, the panel, the leaders, what parts columns
# Of the axis, for what fails: one overflow (1e37) would leave the others a tenth of it.
BAND = 0.08


def floor_of(points):
    """Where an error of 0 is drawn: a decade below the smallest other."""
    errors = [p["error"]["rms"] for p in points if not p["fails"] and p["error"]["rms"] > 0]
    return 10.0 ** (math.floor(math.log10(min(errors))) - 1) if errors else 1e-10


def draw_front(axes, points, height):
    front = sorted((p["ratio"]["median"], height(p)) for p in points if p["pareto"] and not p["fails"])
    if not front:
        return
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
        axes.annotate(label_of(point, counts), (point["ratio"]["median"], height(point)), xytext=(1 + GAP / PANEL, place),
                      textcoords="axes fraction", va="center", color=color, arrowprops=line, annotation_clip=False,
                      fontweight=weight_of(point), zorder=2)


def limits_of(points):
    """The lowest and the highest error drawn to scale, and the end of the axis: above them the band, if any fail."""
    floor = floor_of(points)
    errors = [p["error"]["rms"] for p in points if not p["fails"]]
    low = floor / 2.5 if 0 in errors else min(errors, default=4 * floor) / 2
    high = max([e for e in errors if e > 0], default=10 * floor) * 3
    band = (high / low) ** (BAND / (1 - BAND)) if any(p["fails"] for p in points) else 1
    return low, high, high * band


def set_heights(axes, points, low, high, end):
    floor = floor_of(points)
    axes.set_yscale("log")
    axes.set_ylim(low, end)
    ticks = [10.0 ** e for e in range(math.floor(math.log10(floor)), 2) if max(1.5 * floor, low) < 10.0 ** e < high]
    places = [(t, f"$10^{{{round(math.log10(t))}}}$") for t in ticks[:: 1 + len(ticks) // 7]]
    if any(p["error"]["rms"] == 0 for p in points):
        axes.axhline(floor, color="#808080", linewidth=0.8, linestyle=(0, (2, 2)), zorder=1)
        places.insert(0, (floor, "0"))
    if end > high:
        axes.axhspan(high, end, facecolor="#F3F3F3", edgecolor="#D0D0D0", hatch="////", linewidth=0, zorder=0)
        places.append((math.sqrt(high * end), "fails"))
    axes.set_yticks([place for place, _ in places])
    axes.set_yticklabels([name for _, name in places])


def draw_panel(axes, points, against):
    low, high, end = limits_of(points)
    height = lambda point: math.sqrt(high * end) if point["fails"] else point["error"]["rms"] or floor_of(points)
    axes.set_xscale("log")
    axes.set_xlim(0.6, 2 * max(p["ratio"]["max"] for p in points))
    set_heights(axes, points, low, high, end)
    axes.grid(which="major", color="#ECECEC", linewidth=0.7, zorder=0)
    axes.spines[["top", "right"]].set_visible(False)
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.minorticks_off()
    draw_front(axes, points, height)
    draw_points(axes, points, height)
    draw_labels(axes, points, height, against == "pixel_centres")


def width_of(text, **style):
    """In inches, of its widest line."""
    figure = pyplot.figure(dpi=100)
    extent = figure.text(0, 0, text, **style).get_window_extent(figure.canvas.get_renderer())
    pyplot.close(figure)
    return extent.width / 100


def widths_of(chart):
    """Of the columns, in inches: as wide as their longest labels."""
    widths = []
    for against, title in titles_of(chart).items():
        points = [p for s in chart["scenes"] for p in drawn(s["points"]) if p["against"] == against]
        texts = {(label_of(p, against == "pixel_centres"), weight_of(p)) for p in points}
        labels = max((width_of(text, fontweight=weight) for text, weight in texts), default=0)
        widths.append(max(LEFT + PANEL + GAP + labels, LEFT + width_of(title, fontsize=9.5)) + RIGHT)
    return widths


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


def short(name):
    return name if len(name) <= 60 else "\u2026" + name[-59:]


def draw_scene(figure, scene, left, bottom, height, widths, titles):
    """`left`, `bottom`, `height` (of the panels) and `widths` (of the columns) in inches."""
    width, total = figure.get_size_inches()
    for column, against in enumerate(COLUMNS):
        at = (left + LEFT + sum(widths[:column])) / width
        points = [p for p in drawn(scene["points"]) if p["against"] == against]
        if not points:
            continue
        axes = figure.add_axes([at, bottom / total, PANEL / width, height / total])
        draw_panel(axes, points, against)
        axes.set_xlabel("processor time, times that of the fastest", labelpad=2)
        above = {"xycoords": "axes fraction", "textcoords": "offset points", "fontsize": 9.5, "va": "bottom"}
        if titles:
            axes.annotate(titles[against], (-0.17, 1), xytext=(0, 26), **above)
        if column == 0:
            axes.annotate(short(scene["scene"]), (-0.17, 1), xytext=(0, 10), fontweight="bold", **above)


def draw_legend(figure, chart):
    kinds = [k for k in STYLES if any(p["renderer"] == k for s in chart["scenes"] for p in s["points"])]
    marks = [matplotlib.lines.Line2D([], [], color=STYLES[k][0], marker=STYLES[k][1], linestyle="", label=NAMES[k])
             for k in kinds]
    marks.append(matplotlib.lines.Line2D([], [], color="black", linewidth=1, 
                                         label="Pareto front: nothing is faster and as exact"))
    marks.append(matplotlib.lines.Line2D([], [], color=DOMINATED, marker="o", markeredgecolor="#606060",
                                         markeredgewidth=0.7, linestyle="", label="dominated"))
    figure.legend(handles=marks, loc="upper left", ncol=len(marks), frameon=False, fontsize=9.5, columnspacing=1.6,
                  handletextpad=0.4, bbox_to_anchor=(0, 1 - 0.02 / figure.get_size_inches()[1]))
    runs = f"median and range of {chart['runs']} runs" if chart["runs"] > 1 else "one run"
    notes = f"plumb {chart['plumb']}, {chart['machine']}; one thread; {runs}; POV-Ray without its start"
    if any(p["fails"] for s in chart["scenes"] for p in s["points"]):
        notes += "\nfails: RMS error over 1, or pixels that are no finite numbers"
    figure.text(0.01, 0.08 / figure.get_size_inches()[1], notes, fontsize=8, color=DOMINATED_TEXT, va="bottom")


def draw(chart):
    across = rows_of(chart)
    scenes = chart["scenes"]
    rows = [scenes[i:i + across] for i in range(0, len(scenes), across)]
    heights = [max(height_of(s) for s in row) for row in rows]
    total = 0.35 + 0.35 + sum(heights) + 0.85 * len(rows) + 0.45
    widths = widths_of(chart)
    figure = pyplot.figure(figsize=(sum(widths) * across, total))
    draw_legend(figure, chart)
    top = total - 0.35 - 0.35
    for number, (row, height) in enumerate(zip(rows, heights)):
        top -= 0.4 + height
        for column, scene in enumerate(row):
            draw_scene(figure, scene, sum(widths) * column, top, height, widths,
                       titles_of(chart) if number == 0 else None)
        top -= 0.45
    return figure


def main(arguments):
    if arguments == ["--check"]:
        return
    with open(arguments[0], encoding="utf-8") as file:
        chart = json.load(file)
    figure = draw(chart)
    for path in arguments[1:]:
        # No date: the same figures give the same bytes.
        figure.savefig(path, dpi=150, metadata={"Date": None} if path.endswith(".svg") else None)


if __name__ == "__main__":
    main(sys.argv[1:])
