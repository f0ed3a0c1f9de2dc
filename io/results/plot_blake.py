#!/usr/bin/python3
"""Blake's problem: pressure over r at the last frame of one or more runs, on the closed form, as one SVG; prints each run's relative L1 error.

  for k in constant linear limited; do ./nanson run configs/blake.toml --out results/$k --set physics.reconstruction=$k --set physics.flux_correction=none; done
  io/results/plot_blake.py results/constant results/linear results/limited -o blake.svg

Needs gnuplot, python3-h5py and python3-numpy. Data of configs/blake.toml; the closed form is that of tests/scenes/blake_exact.hpp."""
import argparse
import os
import subprocess
import sys

import h5py
import numpy as np

from gnuplot_text import quoted, quoted_path

A, P, RHO0, E, NU = 0.1, 1e6, 3000.0, 62.5e9, 0.25   # [m] [Pa] [kg/m^3] [Pa] [-]


def closed_form(r, t):
    """Pressure [Pa], compression positive: phi = g(tau)/r, tau = t - (r - a)/c_p, p = -kappa g''(tau)/(r c_p^2)."""
    K, kappa = (1 - NU) / (2 * (1 - 2 * NU)), E / (3 * (1 - 2 * NU))
    cp = np.sqrt(E * (1 - NU) / ((1 + NU) * (1 - 2 * NU) * RHO0))
    q, alpha = np.sqrt(4 * K - 1), cp / (2 * A * K)
    beta, tau = alpha * q, t - (r - A) / cp
    phase = beta * tau - np.arctan(1 / q)
    B = P * A ** 3 * K / (RHO0 * cp ** 2) * np.sqrt(4 * K) / q * np.exp(-alpha * np.maximum(tau, 0))
    second = B * ((alpha ** 2 - beta ** 2) * np.cos(phase) + 2 * alpha * beta * np.sin(phase))
    return np.where(tau < 0, 0, -kappa * second / (r * cp ** 2))


def profile(folder):
    """Radii [m], mean pressure of the nodes on each [Pa], end [s]."""
    with h5py.File(os.path.join(folder, "run.vtkhdf"), "r") as f:
        X, times = f["VTKHDF/Points"][:], f["VTKHDF/Steps/Values"][:]
        p = f[f"frames/{len(times) - 1:06d}/pressure"][:]
    r, which = np.unique(np.round(np.linalg.norm(X, axis=1), 9), return_inverse=True)
    return r, np.bincount(which, p) / np.bincount(which), times[-1]


def main():
    o = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    o.add_argument("results", nargs="+", help="folders of runs")
    o.add_argument("-o", "--out", required=True, help="SVG file")
    o = o.parse_args()
    blocks, curves = [], []
    for folder in (name.rstrip("/") for name in o.results):
        r, p, end = profile(folder)
        weight = np.r_[0.5, np.ones(len(r) - 2), 0.5]
        exact = closed_form(r, end)
        print(f"{folder}: relative L1 error of pressure {(weight * abs(p - exact)).sum() / (weight * abs(exact)).sum():.3f}")
        blocks.append("\n".join(f"{a:.5g} {b:.5g}" for a, b in zip(r, p)))
        curves.append(f'$data index {len(blocks)} with lines lw 1.4 title {quoted(os.path.basename(folder))}')
    r = np.linspace(A, 1, 600)
    blocks.insert(0, "\n".join(f"{a:.5g} {b:.5g}" for a, b in zip(r, closed_form(r, end))))
    data = "\n\n\n".join(blocks)
    script = f"""set terminal svg size 640,360 font "sans-serif,12" background "white"
set output {quoted_path(o.out)}
set grid
set key noenhanced top left
set xlabel "r [m]"
set ylabel "pressure [Pa], t = {end:.3g} s"
set format "%.3g"
$data << EOD
{data}
EOD
plot $data index 0 with lines lw 2 lc rgb "black" title "closed form", {", ".join(curves)}
"""
    sys.exit(subprocess.run(["gnuplot", "-"], input=script, text=True).returncode)


main()
