"""Draws CHART.json as plot.py does, and asks matplotlib where each text lies: chart_texts.py PLOT.py CHART.json."""

import importlib.util
import json
import sys

spec = importlib.util.spec_from_file_location("plot", sys.argv[1])
plot = importlib.util.module_from_spec(spec)
sys.path.insert(0, sys.argv[1].rpartition("/")[0])
spec.loader.exec_module(plot)

with open(sys.argv[2], encoding="utf-8") as file:
    figure = plot.draw(json.load(file))
figure.canvas.draw()
renderer = figure.canvas.get_renderer()
page = figure.bbox
texts = [t for t in figure.findobj(plot.matplotlib.text.Text) if t.get_visible() and t.get_text()]
# Of the text alone: the extent of an annotation includes the line to its point.
boxes = [(t.get_text(), plot.matplotlib.text.Text.get_window_extent(t, renderer)) for t in texts]
# Ticks outside the limits of an axis are kept, but not drawn.
ticks = {id(t) for a in figure.axes for axis in (a.xaxis, a.yaxis) for t in axis.get_ticklabels(which="both")}
shown = [(text, box) for (text, box), t in zip(boxes, texts) if id(t) not in ticks]

for text, box in shown:
    if box.x0 < page.x0 or box.x1 > page.x1 or box.y0 < page.y0 or box.y1 > page.y1:
        print("outside the figure:", repr(text))
for number, (text, box) in enumerate(shown):
    for other, its in shown[number + 1 :]:
        # A pixel at the edges is the space around letters.
        if min(box.x1, its.x1) - max(box.x0, its.x0) > 1 and min(box.y1, its.y1) - max(box.y0, its.y0) > 1:
            print("overlap:", repr(text), repr(other))
    for axes in figure.axes:
        panel = axes.get_window_extent()
        if min(box.x1, panel.x1) - max(box.x0, panel.x0) > 1 and min(box.y1, panel.y1) - max(box.y0, panel.y0) > 1:
            print("in a panel:", repr(text))
print(len(shown), "texts")
