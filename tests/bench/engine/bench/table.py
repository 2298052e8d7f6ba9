"""The results as markdown."""

import math

SHOWN = (("tachyon", "Tachyon"), ("embree", "Embree"), ("textbook", "textbook"), ("engine-double", "engine, double"),
         ("engine-float", "engine, float"))
PAIRS = (("engine-double", "embree", "double / Embree"), ("engine-float", "embree", "float / Embree"),
         ("engine-double", "tachyon", "double / Tachyon"),
         ("engine-float", "engine-double", "float / double"))


def faster(row, name, than):
    """How many times faster `name` is than another; None where one of them is absent."""
    times = row["render_seconds"]
    return times[than] / times[name] if name in times and than in times else None


def geometric_mean(values):
    values = [value for value in values if value is not None]
    return math.exp(sum(map(math.log, values)) / len(values)) if values else None


def means(rows):
    return {title: geometric_mean(faster(row, name, than) for row in rows)
            for name, than, title in [(name, "povray", f"{title} / POV-Ray") for name, title in SHOWN] + list(PAIRS)}


def markdown(result):
    parts = (speeds(result["rows"]), reached(result["goals"]), growths(result["growth"]), objects(result["per_object"]),
             rest(result))
    return "\n\n".join("\n".join(part) for part in parts if part)


def reached(goals):
    if not goals:
        return []
    lines = line(["figure", "to reach", "measured", ""]) + line(["---"] * 4)
    for goal in goals:
        lines += line([goal["title"], (">= " if goal["at_least"] else "<= ") + number(goal["target"]),
                       number(goal["measured"]), "met" if goal["met"] else "**missed**"])
    return lines


def speeds(rows):
    shown = [(name, title) for name, title in SHOWN if any(name in row["render_seconds"] for row in rows)]
    pairs = [pair for pair in PAIRS if any(faster(row, *pair[:2]) for row in rows)]
    lines = line(["scene", "depth", "POV-Ray, s"] + [title for _, title in shown] + [title for *_, title in pairs])
    lines += line(["---"] * (3 + len(shown) + len(pairs)))
    for row in rows:
        ratios = [(faster(row, name, "povray"), row["embree_mode"] if name == "embree" else "") for name, _ in shown]
        lines += line([row["scene"], str(row["depth"] - 1), f"{row['render_seconds']['povray']:.3f}"] +
                      [f"{number(value)} {note}".strip() for value, note in ratios] +
                      [number(faster(row, *pair[:2])) for pair in pairs])
    mean = means(rows)
    lines += line(["geometric mean", "", ""] + [number(mean[f"{title} / POV-Ray"]) for _, title in shown] +
                  [number(mean[title]) for *_, title in pairs])
    return ["Times faster than POV-Ray, render only, CPU time of one thread; depth 0: no secondary rays.", ""] + lines


def growths(found):
    if not found:
        return []
    lines = line(["family", "depth", "renderer", "scenes", "time ~ objects^"]) + line(["---"] * 5)
    for entry in found:
        lines += line([entry["family"], str(entry["depth"] - 1), entry["renderer"], str(entry["scenes"]),
                       f"{entry['exponent']:.3f}"])
    return lines


def objects(found):
    if not found:
        return []
    lines = line(["scene", "renderer", "build, us/object", "reading, us/object", "bytes/object"]) + line(["---"] * 5)
    for entry in found:
        for name in sorted({*entry["build_us"], *entry["read_us"], *entry["bytes"]}):
            lines += line([entry["scene"], name] + [number(entry[part].get(name)) for part in
                                                    ("build_us", "read_us", "bytes")])
    return lines


def rest(result):
    lines = [f"- two threads, {t['scene']}, depth {t['depth'] - 1}: {t['ratio']:.2f} times one" for t in
             result["threads"]]
    whole = result["whole_process"]
    if whole:
        for name in ("povray", "plumb", "plumb --version"):
            lines.append(f"- whole process, {name}: {whole[name]['cpu_s']:.4f} s CPU, {whole[name]['wall_s']:.4f} s wall")
        lines.append(f"- plumb render against povray: {whole['ratio']['cpu']:.1f} times less CPU, "
                     f"{whole['ratio']['wall']:.1f} times less wall time")
    return lines


def line(cells):
    return ["| " + " | ".join(cells) + " |"]


def number(value):
    return "-" if value is None else f"{value:.3g}" if value < 100 else f"{value:.0f}"
