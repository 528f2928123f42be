#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws and compares what tandem-bench and interface_types/measure.py have measured. Pictures are SVG, by gnuplot.

report.py plot REPORT.json FOLDER            one picture for each group of rows, FOLDER/NAME.svg
report.py compare OLD.json NEW.json          the rows that differ by more than their runs do
report.py interface-types ROWS.csv FOLDER    interface_types_p50.svg, interface_types_p99.svg, and a table
"""
import collections
import csv
import json
import math
import pathlib
import statistics
import subprocess
import sys

FORMAT_VERSION = 2  # of report.cpp
# Two runs of a program on an idle machine differ by at least the first, two single runs by the second.
MIN_NOISE, NOISE_OF_ONE_RUN = 0.05, 0.15
# Baselines are grey and dashed, Tandem is blue and thick; the colour-blind can tell the peers' colours apart (Okabe, Ito).
COLOURS = {"baseline": ["#999999", "#555555", "#bbbbbb"], "tandem": ["#0072b2", "#3fa0e0", "#003f66"],
           "peer": ["#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d31", "#7f3c8d"]}
WIDTHS = {"baseline": "lw 2 dt (8,4)", "tandem": "lw 3.5", "peer": "lw 1.8"}
TYPE_COLOURS = {"direct_read": "#8c564b", "direct": "#2ca02c", "corba_cdr": "#1f77b4", "corba_cdr_read": "#17becf",
                "shared_memory": "#d62728", "data_service": "#9467bd", "bridge": "#ff7f0e"}
TIME_AXIS = ("set logscale xy\nset ylabel 'time'\nset ytics ('10 ns' 10, '100 ns' 100, '1 us' 1e3, '10 us' 1e4, "
             "'100 us' 1e5, '1 ms' 1e6, '10 ms' 1e7, '100 ms' 1e8)\n")
PERCENTILE_AXIS = ("set xlabel 'percentile'\nset xtics ('0' 1, '50' 2, '90' 10, '99' 100, '99.9' 1000, '99.99' 10000, "
                   "'99.999' 100000)\nset xrange [1:]\n")
SIZE_AXIS = ("set logscale xy\nset xlabel 'bytes'\nset xtics ('8' 8, '64' 64, '1 Ki' 1024, '16 Ki' 16384, '256 Ki' 262144, "
             "'1 Mi' 1048576, '6 Mi' 6291456)\nset xrange [6:9e6]\n")


def gnuplot(output, title, axes, curves):
    """curves: (title, style, points) for each line."""
    script = (f"set terminal svg noenhanced size 900,460 dynamic font 'Helvetica,13' background rgb 'white'\n"
              f"set output '{output.name}'\nset title '{title}'\nset grid lt 1 lw 1 lc rgb '#e4e4e4'\n"
              f"set key outside right top samplen 2\n{axes}")
    for number, (_, _, points) in enumerate(curves):
        script += f"$data{number} << END\n" + "".join(f"{x:.9g} {y:.9g}\n" for x, y in points) + "END\n"
    script += "plot " + ", ".join(f"$data{number} with {style} title '{name}'"
                                  for number, (name, style, _) in enumerate(curves))
    try:
        subprocess.run(["gnuplot", "-"], input=script + "\n", text=True, check=True, cwd=output.parent)
    except FileNotFoundError:
        sys.exit("report.py: gnuplot is missing; install gnuplot-nox")


def styles(groups, with_style):
    used = collections.Counter()
    for group in groups:
        colours = COLOURS[group]
        yield f"{with_style} lc rgb '{colours[used[group] % len(colours)]}' {WIDTHS[group]}"
        used[group] += 1


def plot_distribution(rows, name, title, folder):
    """Each step to the right is ten times rarer: x is 1 / (1 - share)."""
    rows = [row for row in rows if row["unit"] == "ns" and row["curve"] and row["placement"] in ("processes", "same-core")]
    curves = [(f"{row['subject']} {row['wake']} {row['detail']}".strip(), style,
               [(1 / (1 - share), value) for share, value in row["curve"] if share < 1])
              for row, style in zip(rows, styles([row["group"] for row in rows], "lines"))]
    if curves:
        gnuplot(folder / f"{name}.svg", title, TIME_AXIS + PERCENTILE_AXIS, curves)


def plot_by_size(rows, name, title, axis, value, folder):
    """One line for each subject and detail. Small messages have no detail: they begin the line of each detail."""
    lines = collections.defaultdict(list)
    for row in rows:
        if row["conditions"] == "normal" and row["placement"] == "processes":
            lines[row["group"], row["subject"], row["detail"]].append((row["bytes"], value(row)))
    with_detail = {key[:2] for key in lines if key[2]}
    keys = sorted(key for key in lines if key[2] or key[:2] not in with_detail)
    curves = [(f"{key[1]} {key[2]}".strip(), style, sorted(lines[key] + (lines.get((*key[:2], ""), []) if key[2] else [])))
              for key, style in zip(keys, styles([key[0] for key in keys], "linespoints pt 7 ps 0.6"))]
    if curves:
        gnuplot(folder / f"{name}.svg", title, SIZE_AXIS + axis, curves)


def read_report(file):
    try:
        report = json.loads(pathlib.Path(file).read_text())
        if report["tandem_bench"] != FORMAT_VERSION:
            sys.exit(f"report.py: {file} has format {report['tandem_bench']}, expected {FORMAT_VERSION}; measure again")
        return report, [row for row in report["rows"] if "skipped" not in row]
    except OSError as error:
        sys.exit(f"report.py: cannot read {file}: {error.strerror}; give a file written by tandem-bench --json")
    except (ValueError, KeyError, TypeError):
        sys.exit(f"report.py: {file} is not a report; give a file written by tandem-bench --json")


def plot(file, folder):
    _, rows = read_report(file)
    for name, title, conditions, asleep in (("awake", "One way, 64 B, reader awake", "normal", False),
                                            ("asleep", "One way, 64 B, reader asleep", "normal", True),
                                            ("asleep_low_latency_idle", "One way, 64 B, reader asleep, low-latency idle",
                                             "low-latency-idle", True),
                                            ("asleep_same_core", "One way, 64 B, reader asleep, same core", "same-core", True)):
        plot_distribution([row for row in rows if row["operation"] == "one-way" and row["conditions"] == conditions
                           and (row["bytes"] == 64 or row["subject"] == "cache-line")
                           and (row["wake"] == "blocking") == asleep], name, title, folder)
    plot_distribution([row for row in rows if row["operation"] == "one-way" and row["bytes"] == 64
                       and row["conditions"] == "loaded"], "loaded", "One way, 64 B, loaded machine", folder)
    plot_distribution([row for row in rows if row["operation"] == "call" and row["conditions"] == "normal"],
                      "call", "Call, 64 B there and back", folder)
    plot_distribution([row for row in rows if row["operation"] == "paced"],
                      "paced", "Round trip due every millisecond, from when it was due", folder)
    plot_by_size([row for row in rows if row["operation"] == "one-way" and row["wake"] == "spin" and row["group"] != "peer"],
                 "by_size", "One way by size, polling, p50", TIME_AXIS, lambda row: row["p50"], folder)
    plot_by_size([row for row in rows if row["operation"] == "stream" and row["bytes"] > 0], "throughput",
                 "Throughput by size", "set ylabel 'GB/s'\n",
                 lambda row: row["p50"] if row["unit"] == "GB/s" else row["p50"] * row["bytes"] / 1e3, folder)


def noise(runs):
    if len(runs) < 2:
        return NOISE_OF_ONE_RUN
    return (max(runs) - min(runs)) / statistics.median(runs) if statistics.median(runs) > 0 else 0


def compare(old_file, new_file):
    (old_report, old_rows), (new_report, new_rows) = read_report(old_file), read_report(new_file)
    machines = [[report["machine"][key] for key in ("processor", "cores")] for report in (old_report, new_report)]
    print(f"compared with {old_report['machine']['date']} ({old_report['machine']['kernel']})")
    if machines[0] != machines[1]:
        print(f"measured on another machine: {machines[0][0]}, {machines[0][1]} cores; "
              "only ratios within one report are comparable")
    old_rows = {row["case"]: row for row in old_rows}
    common, changes = 0, []
    for row in new_rows:
        old = old_rows.get(row["case"])
        if old is None or old["p50"] <= 0 or row["p50"] <= 0:
            continue
        common += 1
        runs, old_runs = ([run for run in each["runs"] if run is not None] for each in (row, old))
        overlap = runs and old_runs and min(runs) <= max(old_runs) and min(old_runs) <= max(runs)
        limit, ratio = max(MIN_NOISE, noise(runs), noise(old_runs)), row["p50"] / old["p50"]
        if max(ratio, 1 / ratio) > 1 + limit and not overlap:
            better = (ratio > 1) == (row["unit"] not in ("ns", "count", "ratio"))
            changes.append((abs(math.log(ratio)), f"{'better' if better else 'WORSE':<7} {row['case']:<60} {old['p50']:>9.4g} -> "
                            f"{row['p50']:>9.4g} {row['unit']:<5} x {ratio:.2f} (noise {limit:.0%})"))
    for _, line in sorted(changes, reverse=True):
        print(line)
    print(f"{len(changes)} of {common} common rows changed beyond noise")


def interface_types(file, folder):
    series = collections.defaultdict(lambda: collections.defaultdict(list))  # (engine, type) -> bytes -> rows of all rounds
    with open(file, newline="") as lines:
        for row in csv.DictReader(lines):
            if int(row["samples"]) > 0:
                series[row["engine"], row["interface_type"]][int(row["bytes"])].append(row)
    median = lambda rows, column: statistics.median(float(row[column]) for row in rows)
    for column, title in {"p50_us": "one way, median", "p99_us": "one way, 99th percentile"}.items():
        curves = [(f"{kind}, {engine}",
                   f"linespoints lw 2 pt 7 ps 0.5 dt {1 if engine == 'Tandem' else 2} lc rgb '{TYPE_COLOURS[kind]}'",
                   [(size, median(rows, column)) for size, rows in sorted(sizes.items())])
                  for (engine, kind), sizes in series.items()]
        gnuplot(folder / f"interface_types_{column.removesuffix('_us')}.svg", "",
                SIZE_AXIS + f"set format y '%g'\nset ylabel '{title}, us'\n", curves)
    figure = lambda value: f"{value:.2f}" if value < 1 else f"{value:.1f}" if value < 100 else f"{value:.0f}"
    all_sizes = sorted({size for sizes in series.values() for size in sizes})
    print("| interface type | engine | " + " | ".join(f"{size} B" for size in all_sizes) + " |")
    print("|---" * (len(all_sizes) + 2) + "|")
    for (engine, kind), sizes in series.items():
        cells = [f"{figure(median(sizes[size], 'p50_us'))} / {figure(median(sizes[size], 'p99_us'))}" if size in sizes else "-"
                 for size in all_sizes]
        print(f"| {kind} | {engine} | " + " | ".join(cells) + " |")


def main():
    command, *arguments = sys.argv[1:] or [""]
    if command == "compare" and len(arguments) == 2:
        compare(*arguments)
    elif command in ("plot", "interface-types") and len(arguments) == 2:
        folder = pathlib.Path(arguments[1])
        if not folder.is_dir():
            sys.exit(f"report.py: {folder} is not a folder; create it first")
        (plot if command == "plot" else interface_types)(arguments[0], folder)
    else:
        sys.exit(__doc__.strip())


if __name__ == "__main__":
    main()
