#!/usr/bin/env python3
"""Writes flat_tet.msh: a Kuhn cube of 4 x 4 x 4 cells, one inner node moved until one of its tets keeps a hundredth of its height (Gmsh 2.2, faces by name)."""
import itertools
import pathlib

n = 4
number = lambda i, j, k: (k * (n + 1) + j) * (n + 1) + i + 1
X = {number(i, j, k): [i / n, j / n, k / n] for i, j, k in itertools.product(range(n + 1), repeat=3)}


def volume(t):
    a, b, c = ([X[m][i] - X[t[0]][i] for i in range(3)] for m in t[1:])
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6


tets = []
for corner in itertools.product(range(n), repeat=3):
    for order in itertools.permutations(range(3)):
        at, t = list(corner), [number(*corner)]
        for axis in order:
            at[axis] += 1
            t.append(number(*at))
        tets.append(t if volume(t) > 0 else [t[0], t[1], t[3], t[2]])

moved = number(2, 2, 2)
flat = next(t for t in tets if moved in t)
foot = [sum(X[m][i] for m in flat if m != moved) / 3 for i in range(3)]
X[moved] = [x + 0.99 * (f - x) for x, f in zip(X[moved], foot)]
assert min(volume(t) for t in tets) > 0

count = {}
for t in tets:
    for f in itertools.combinations(sorted(t), 3):
        count[f] = count.get(f, 0) + 1
triangles = [(2 * a + s + 1, f) for f, c in count.items() if c == 1 for a in range(3) for s in (0, 1) if all(X[m][a] == s for m in f)]

lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "7"]
lines += [f'2 {g + 1} "{name}"' for g, name in enumerate(("xmin", "xmax", "ymin", "ymax", "zmin", "zmax"))] + ['3 7 "body"', "$EndPhysicalNames"]
lines += ["$Nodes", str(len(X))] + [f"{m} {x!r} {y!r} {z!r}" for m, (x, y, z) in sorted(X.items())] + ["$EndNodes", "$Elements", str(len(triangles) + len(tets))]
lines += [f"{e} 2 2 {g} {g} {f[0]} {f[1]} {f[2]}" for e, (g, f) in enumerate(triangles, 1)]
lines += [f"{e} 4 2 7 7 {t[0]} {t[1]} {t[2]} {t[3]}" for e, t in enumerate(tets, len(triangles) + 1)] + ["$EndElements", ""]
pathlib.Path(__file__).with_name("flat_tet.msh").write_text("\n".join(lines))
