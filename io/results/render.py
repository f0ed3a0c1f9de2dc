#!/usr/bin/python3
"""Pictures of a run without a viewer: the deformed surface of chosen frames of run.vtkhdf, coloured by a nodal field, as one SVG.

  io/results/render.py results/twisting_column --field pressure --frames 0 8 20 --view 30 15 -o column.svg
  io/results/render.py results/taylor_bar --field plastic_strain --mirror xy -o bar.svg          a quarter model, made whole

Needs python3-h5py and python3-numpy. Triangles are sorted by depth; colours are averaged over their corners, in steps that keep the file small."""
import argparse
import itertools
import os
import sys

import h5py
import numpy as np

COLOURS = np.array([[49, 54, 149], [69, 117, 180], [116, 173, 209], [224, 243, 248], [254, 224, 144], [253, 174, 97], [244, 109, 67], [165, 0, 38]], float)


SHADES, LIGHTS, LAYERS, GRID = 24, 4, 60, 4     # steps of colour, light and depth; places are whole quarters of a pixel


def colour(s):
    x = np.clip(s, 0, 1) * (len(COLOURS) - 1)
    i = np.minimum(x.astype(int), len(COLOURS) - 2)
    return COLOURS[i] + (COLOURS[i + 1] - COLOURS[i]) * (x - i)[:, None]


def surface(tets):
    """Triangles that belong to one tet only, seen from outside counter-clockwise."""
    faces = np.concatenate([tets[:, k] for k in ([1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1])])
    key = np.sort(faces, axis=1)
    order = np.lexsort(key.T[::-1])
    same = (key[order][1:] == key[order][:-1]).all(axis=1)
    single = ~(np.r_[False, same] | np.r_[same, False])
    return faces[order][single]


def mirrored(x, triangles, X, planes):
    """The surface and its images in the planes through the origin, without the cuts that lie in them."""
    for axis in ("xyz".index(p) for p in planes):
        triangles = triangles[np.abs(X[triangles][:, :, axis]).max(axis=1) > 1e-9 * np.ptp(X[:, axis])]
    at = [x]
    for axis in ("xyz".index(p) for p in planes):
        at += [a * np.where(np.arange(3) == axis, -1, 1) for a in at]
    odd = [bool(bin(k).count("1") % 2) for k in range(len(at))]
    return np.concatenate(at), np.concatenate([(triangles[:, ::-1] if o else triangles) + k * len(x) for k, o in enumerate(odd)])


def outline(corners):
    """A triangle in whole steps, its second and third corner relative."""
    q = np.rint(corners * GRID).astype(int)
    d = (q[1:] - q[:-1]).ravel()
    if d[0] * d[3] == d[1] * d[2]:
        return ""
    return f"M{q[0][0]} {q[0][1]}l" + "".join(f"{' ' if i and n >= 0 else ''}{n}" for i, n in enumerate(d)) + "z"


def paths(corners, depth, style):
    """Far layers first; within a layer triangles of one style share a path."""
    layer = np.floor((depth - depth.min()) / (np.ptp(depth) + 1e-300) * LAYERS).astype(int)
    out = []
    for key, members in itertools.groupby(np.lexsort([style, layer]), key=lambda t: (layer[t], style[t])):
        shapes = "".join(outline(corners[t]) for t in members)
        if shapes:
            out.append(f'<path class="{chr(97 + key[1] // SHADES)}{key[1] % SHADES}" d="{shapes}"/>')
    return out


def camera(azimuth, elevation):
    a, e = np.radians([azimuth, elevation])
    right = np.array([-np.sin(a), np.cos(a), 0])
    to_eye = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    return np.array([right, np.cross(to_eye, right), to_eye])


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("results", help="folder of a run")
    p.add_argument("--field", default="pressure", help="scalar field, or the length of a vector field")
    p.add_argument("--frames", type=int, nargs="+", help="frame numbers; default: first, middle, last")
    p.add_argument("--view", type=float, nargs=2, default=[30, 15], metavar=("AZIMUTH", "ELEVATION"), help="[deg]")
    p.add_argument("--range", type=lambda text: [float(x) for x in text.split(":")], metavar="LOW:HIGH",
                   help="of the colours, written --range=LOW:HIGH; default: 2 and 98 percent of the shown values")
    p.add_argument("--mirror", default="", metavar="xyz", help="planes through the origin in which a part of a symmetric body is mirrored")
    p.add_argument("--scale", type=float, default=1, help="of the displacement, for small vibrations")
    p.add_argument("--height", type=int, default=420, help="[px]")
    p.add_argument("-o", "--out", required=True, help="SVG file")
    o = p.parse_args()
    f = h5py.File(os.path.join(o.results, "run.vtkhdf"), "r")
    X, tets = f["VTKHDF/Points"][:], f["VTKHDF/Connectivity"][:].reshape(-1, 4)
    times = f["VTKHDF/Steps/Values"][:]
    frames = o.frames or sorted({0, len(times) // 2, len(times) - 1})
    missing = [k for k in frames if not 0 <= k < len(times)]
    if missing:
        sys.exit(f"{o.results}: the run has frames 0 to {len(times) - 1}, not {' '.join(map(str, missing))}")
    for name in ("displacement", o.field):
        if name not in f["frames/000000"]:
            sys.exit(f"{o.results}: the run has no field {name}; it has {' '.join(f['frames/000000'])}")
    unit = f["VTKHDF/PointData/" + o.field].attrs.get("unit", "")
    unit = unit.decode() if isinstance(unit, bytes) else unit
    outer, view, shown = surface(tets), camera(*o.view), []
    for k in frames:
        g = f[f"frames/{k:06d}"]
        v = g[o.field][:]
        v = v if v.ndim == 1 else np.linalg.norm(v, axis=1)
        x, triangles = mirrored(X + o.scale * g["displacement"][:], outer, X, o.mirror)
        v = np.tile(v, 2 ** len(o.mirror))
        y = x @ view.T
        n = np.cross(x[triangles[:, 1]] - x[triangles[:, 0]], x[triangles[:, 2]] - x[triangles[:, 0]])
        n /= np.linalg.norm(n, axis=1)[:, None] + 1e-300
        front = n @ view[2] > 0
        shown.append((k, y, v[triangles].mean(axis=1), triangles, front, np.clip(n @ (view.T @ [0.3, 0.5, 0.81]), 0, 1)))
    values = np.concatenate([s[2][s[4]] for s in shown])
    low, high = o.range or np.percentile(values, [2, 98])
    high = high if high > low else low + 1
    corners = np.concatenate([s[1][:, :2] for s in shown])
    least, span = corners.min(axis=0), np.ptp(corners, axis=0)
    scale = (o.height - 70) / span[1]
    width = span[0] * scale + 24
    styles = [f".{chr(97 + l)}{s}{{fill:{c};stroke:{c}}}" for l in range(LIGHTS) for s in range(SHADES)
              for c in ["#%02x%02x%02x" % tuple(int(c) for c in colour(np.array([s / (SHADES - 1)]))[0] * (0.55 + 0.45 * l / (LIGHTS - 1)))]]
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width * len(frames) + 130:.0f} {o.height}" font-family="sans-serif" font-size="13">',
           '<rect width="100%" height="100%" fill="#fff"/>', f'<style>path{{stroke-width:{GRID};stroke-linejoin:round}}' + "".join(styles) + "</style>", f'<g transform="scale({1 / GRID})">']
    for i, (k, y, v, tri, front, light) in enumerate(shown):
        q = (y[:, :2] - least) * scale
        q = np.stack([q[:, 0] + i * width + 12, o.height - 45 - q[:, 1]], axis=1)
        shade = np.rint(np.clip((v - low) / (high - low), 0, 1) * (SHADES - 1)).astype(int)
        step = np.rint(light * (LIGHTS - 1)).astype(int)
        out += paths(q[tri[front]], y[tri[front]].mean(axis=1)[:, 2], (step * SHADES + shade)[front])
    out.append("</g>")
    magnified = f", displacement x {o.scale:g}" if o.scale != 1 else ""
    for i, k in enumerate(frames):
        out.append(f'<text x="{i * width + width / 2:.0f}" y="{o.height - 14}" text-anchor="middle">t = {times[k]:.3g} s{magnified}</text>')
    x0 = width * len(frames) + 14
    for j in range(60):
        c = "#%02x%02x%02x" % tuple(int(c) for c in colour(np.array([j / 59.0]))[0])
        out.append(f'<rect x="{x0:.0f}" y="{o.height - 60 - (j + 1) * (o.height - 110) / 60:.1f}" width="14" height="{(o.height - 110) / 60 + .5:.1f}" fill="{c}"/>')
    out.append(f'<text x="{x0:.0f}" y="24">{o.field} [{unit}]</text>' if unit else f'<text x="{x0:.0f}" y="24">{o.field}</text>')
    out.append(f'<text x="{x0 + 18:.0f}" y="{o.height - 58}">{low:.2g}</text><text x="{x0 + 18:.0f}" y="58">{high:.2g}</text></svg>')
    with open(o.out, "w") as file:
        file.write("\n".join(out) + "\n")


main()
