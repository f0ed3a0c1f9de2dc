#!/usr/bin/python3
"""A column of history.csv over time, one curve a run, as one SVG.

  io/plot_history.py results/stent --column middle_displacement_x -o stent.svg
  io/plot_history.py results/coarse results/fine --column top_P_yy --labels 4x24x4 8x48x8 -o plate.svg

Needs gnuplot. Without --column it lists the columns there are."""
import argparse
import os
import subprocess
import sys


def headers(folder):
    with open(os.path.join(folder, "history.csv")) as file:
        return file.readline().strip().split(",")


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("results", nargs="+", help="folders of runs")
    p.add_argument("--column", help="name without unit")
    p.add_argument("--labels", nargs="+", help="one a run; default: the folders' names")
    p.add_argument("-o", "--out", help="SVG file")
    o = p.parse_args()
    o.results = [folder.rstrip("/") for folder in o.results]
    labels = o.labels or [os.path.basename(folder) for folder in o.results]
    if len(labels) != len(o.results):
        sys.exit(f"{len(labels)} labels for {len(o.results)} runs")
    curves = []
    for folder, label in zip(o.results, labels):
        names = headers(folder)
        full = [name for name in names if name.rsplit(" [", 1)[0] == o.column]
        if not full:
            sys.exit(f"{folder}: no column {o.column}; there are {' '.join(name.rsplit(' [', 1)[0] for name in names)}")
        curves.append(f'"{folder}/history.csv" using {names.index("t [s]") + 1}:{names.index(full[0]) + 1} with lines lw 1.5 title "{label}"')
    if not o.out:
        p.error("-o is needed")
    script = f"""set terminal svg size 640,360 font "sans-serif,12" background "white"
set output "{o.out}"
set datafile separator comma
set grid
set key outside right
set xlabel "t [s]"
set ylabel "{full[0]}" noenhanced
set key noenhanced
set format "%.3g"
plot {", ".join(curves)}
"""
    sys.exit(subprocess.run(["gnuplot", "-"], input=script, text=True).returncode)


main()
