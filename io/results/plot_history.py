#!/usr/bin/python3
"""Columns of history.csv over time as one SVG: a panel a column, a curve a run.

  io/results/plot_history.py results/stent --columns middle_displacement_x -o stent.svg
  io/results/plot_history.py results/coarse results/fine --columns centre_displacement_z top_P_22 --labels 4x24x4 8x48x8 -o plate.svg

Needs gnuplot. A column that a run does not have is answered with those it has."""
import argparse
import os
import subprocess
import sys

from gnuplot_text import quoted, quoted_path


def headers(folder):
    with open(os.path.join(folder, "history.csv")) as file:
        return file.readline().strip().split(",")


def column(folder, name):
    """Its number from 1, and its header with the unit."""
    names = headers(folder)
    short = [header.rsplit(" [", 1)[0] for header in names]
    if name not in short:
        sys.exit(f"{folder}: no column {name}; there are {' '.join(short)}")
    return short.index(name) + 1, names[short.index(name)]


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("results", nargs="+", help="folders of runs")
    p.add_argument("--columns", nargs="+", required=True, help="names without unit")
    p.add_argument("--labels", nargs="+", help="one a run; default: the folders' names")
    p.add_argument("-o", "--out", required=True, help="SVG file")
    o = p.parse_args()
    labels = o.labels or [os.path.basename(os.path.normpath(folder)) for folder in o.results]
    if len(labels) != len(o.results):
        sys.exit(f"{len(labels)} labels for {len(o.results)} runs")
    panels = []
    for name in o.columns:
        curves = [f'{quoted_path(folder + "/history.csv")} using {column(folder, "t")[0]}:{column(folder, name)[0]} with lines lw 1.5 title {quoted(label)}'
                  for folder, label in zip(o.results, labels)]
        panels.append(f'set ylabel {quoted(column(o.results[0], name)[1])} noenhanced\nplot {", ".join(curves)}')
    script = f"""set terminal svg size 640,{280 * len(panels) + 40} font "sans-serif,12" background "white"
set output {quoted_path(o.out)}
set datafile separator comma
set grid
set key outside right noenhanced
set lmargin 12
set xlabel "t [s]"
set format "%.3g"
set multiplot layout {len(panels)},1
{chr(10).join(panels)}
unset multiplot
"""
    sys.exit(subprocess.run(["gnuplot", "-"], input=script, text=True).returncode)


main()
