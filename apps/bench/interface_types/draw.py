#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws what measure.py has measured, by gnuplot, and prints it as a table: of each figure the median of the rounds.
Usage: draw.py CSV FOLDER; writes FOLDER/interface_types_p50.svg and FOLDER/interface_types_p99.svg"""
import collections
import csv
import pathlib
import statistics
import subprocess
import sys

COLOURS = {"direct_read": "#8c564b", "direct": "#2ca02c", "corba_cdr": "#1f77b4", "shared_memory": "#d62728", "data_service": "#9467bd", "bridge": "#ff7f0e"}
HEAD = """set terminal svg noenhanced size 860,620 background '#ffffff' font 'sans-serif,13'
set logscale xy
set xtics ('8 B' 8, '64 B' 64, '1 KiB' 1024, '16 KiB' 16384, '256 KiB' 262144, '1 MiB' 1048576, '6 MiB' 6291456)
set format y '%g'
set grid
set key below maxrows 4
set xrange [6:9e6]
set xlabel 'data of the message'
"""


def read(file):
    """(engine, interface type) -> bytes -> the rows of all rounds; a row without samples is left out."""
    series = collections.defaultdict(lambda: collections.defaultdict(list))
    with open(file, newline="") as lines:
        for row in csv.DictReader(lines):
            if int(row["samples"]) > 0:
                series[row["engine"], row["interface_type"]][int(row["bytes"])].append(row)
    return series


def median(rows, column):
    return statistics.median(float(row[column]) for row in rows)


def draw(series, column, title, output):
    script = HEAD + f"set output '{output}'\nset ylabel '{title}, us'\n"
    curves = []
    for number, ((engine, kind), sizes) in enumerate(series.items()):
        points = "\n".join(f"{size} {median(rows, column)}" for size, rows in sorted(sizes.items()))
        script += f"$curve{number} << END\n{points}\nEND\n"
        curves.append(f"$curve{number} with linespoints lw 2 pt 7 ps 0.5 dt {1 if engine == 'Tandem' else 2} "
                      f"lc rgb '{COLOURS[kind]}' title '{kind}, {engine}'")
    subprocess.run(["gnuplot"], input=script + "plot " + ", ".join(curves) + "\n", text=True, check=True)


def figure(value):
    return f"{value:.2f}" if value < 1 else f"{value:.1f}" if value < 100 else f"{value:.0f}"


def print_table(series):
    sizes = sorted({size for rows in series.values() for size in rows})
    print("| interface type | engine | " + " | ".join(f"{size} B" for size in sizes) + " |")
    print("|---" * (len(sizes) + 2) + "|")
    for (engine, kind), rows in series.items():
        cells = [f"{figure(median(rows[size], 'p50_us'))} / {figure(median(rows[size], 'p99_us'))}" if size in rows else "-"
                 for size in sizes]
        print(f"| {kind} | {engine} | " + " | ".join(cells) + " |")


def main():
    if len(sys.argv) != 3 or not pathlib.Path(sys.argv[1]).is_file() or not pathlib.Path(sys.argv[2]).is_dir():
        sys.exit("usage: draw.py CSV FOLDER: a file that measure.py has written, and a folder that is there")
    series = read(sys.argv[1])
    for column, title in {"p50_us": "one way, median", "p99_us": "one way, 99th percentile"}.items():
        draw(series, column, title, f"{sys.argv[2]}/interface_types_{column.removesuffix('_us')}.svg")
    print_table(series)


main()
