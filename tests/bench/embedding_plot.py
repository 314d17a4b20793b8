#!/usr/bin/env python3
"""Draw time against size from the tables of bench_embedding: embedding_plot.py OUT.svg FILE.csv ..."""
import csv
import math
import sys

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 760, 440, 70, 200, 24, 52
SERIES = [  # solver, column, label, colour, dashes
    ("rhombloom", 3, "rhombloom, |g| ≤ 1e-8", "#c0392b", ""),
    ("rhombloom", 2, "rhombloom, 1e-6", "#c0392b", "5 4"),
    ("liblbfgs", 2, "liblbfgs, 1e-6", "#2471a3", ""),
    ("Ceres dogleg", 2, "Ceres dogleg, 1e-6", "#7d8c2b", ""),
    ("Ceres LM", 2, "Ceres LM, 1e-6", "#229954", ""),
    ("projected Newton, Eigen LDLT", 2, "projected Newton, 1e-6", "#7d3c98", ""),
]


def read(paths):
    points = {}
    for path in paths:
        with open(path, encoding="utf-8", newline="") as file:
            for row in csv.reader(file, delimiter=";"):
                kind, _, size = row[0].partition("-")
                if kind == "plain":
                    for solver, column, *_ in SERIES:
                        if row[1] == solver and row[column] != "-":
                            points.setdefault((solver, column), {})[int(size)] = float(row[column])
    return {key: sorted(values.items()) for key, values in points.items()}


class Scale:
    """Logarithmic, from decades of values to pixels."""

    def __init__(self, values, first, last):
        self.low, self.high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
        self.first, self.last = first, last

    def __call__(self, value):
        share = (math.log10(value) - self.low) / (self.high - self.low)
        return self.first + share * (self.last - self.first)

    def decades(self):
        return [10.0**k for k in range(self.low, self.high + 1)]


def text(x, y, content, anchor="start", colour="#333"):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}">{content}</text>'


def line(x0, y0, x1, y1, style):
    return f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" {style}/>'


def duration(ms):
    return f"{ms / 1000:g} s" if ms >= 1000 else f"{ms:g} ms"


def grid(x, y):
    faint = 'stroke="#ddd"'
    out = []
    for value in x.decades():
        out += [line(x(value), TOP, x(value), HEIGHT - BOTTOM, faint),
                text(x(value), HEIGHT - BOTTOM + 18, f"{value:,.0f}", "middle")]
    for value in y.decades():
        out += [line(LEFT, y(value), WIDTH - RIGHT, y(value), faint), text(LEFT - 8, y(value) + 4, duration(value), "end")]
    out.append(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 12, "elements", "middle"))
    return out


def power_line(x, y, points):
    """n^1.5 through the time at 1,920 elements."""
    times = dict(points)
    if 1920 not in times:
        return []
    last = points[-1][0]
    end = times[1920] * (last / 1920) ** 1.5
    return [line(x(1920), y(times[1920]), x(last), y(end), 'stroke="#999" stroke-dasharray="2 3"'),
            text(x(last) + 6, y(end) + 4, "n^1.5", colour="#777")]


def curves(x, y, data):
    out = []
    for k, (solver, column, label, colour, dashes) in enumerate(SERIES):
        points = data.get((solver, column), [])
        path = " ".join(f"{x(n):.1f},{y(ms):.1f}" for n, ms in points)
        dash = f' stroke-dasharray="{dashes}"' if dashes else ""
        out.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.8"{dash}/>')
        out += [f'<circle cx="{x(n):.1f}" cy="{y(ms):.1f}" r="2.6" fill="{colour}"/>' for n, ms in points]
        legend = TOP + 12 + 20 * k
        left = WIDTH - RIGHT + 22
        out.append(line(left, legend - 4, left + 22, legend - 4, f'stroke="{colour}" stroke-width="1.8"{dash}'))
        out.append(text(left + 28, legend, label))
    return out


def main(out, *paths):
    data = read(paths)
    sizes = [n for points in data.values() for n, _ in points]
    times = [ms for points in data.values() for _, ms in points]
    x, y = Scale(sizes, LEFT, WIDTH - RIGHT), Scale(times, HEIGHT - BOTTOM, TOP)
    body = grid(x, y) + power_line(x, y, data[("rhombloom", 3)]) + curves(x, y, data)
    head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}" '
            'font-family="sans-serif" font-size="12">\n<rect width="100%" height="100%" fill="white"/>\n')
    with open(out, "w", encoding="utf-8") as file:
        file.write(head + "\n".join(body) + "\n</svg>\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
