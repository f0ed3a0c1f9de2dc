#!/usr/bin/env python3
"""No include runs up: kernels <- engine <- io's tools <- io/scene, io/mesh <- io/results <- io/study <- the verbs. Usage: check_includes.py SOURCE_FOLDER"""
import re
import sys
from pathlib import Path

root = Path(sys.argv[1])
floors = ["kernels/", "engine/", "io/", "io/scene/ io/mesh/", "io/results/", "io/study/"]
verbs = {"io/check", "io/keys", "io/main", "io/info", "io/new_scene", "io/restart", "io/run"}  # everything else in io/ itself is a tool


def floor(path):
    if path.rsplit(".", 1)[0] in verbs:
        return len(floors)
    folder = path.rsplit("/", 1)[0] + "/"
    return max(i for i, names in enumerate(floors) if any(folder.startswith(name) for name in names.split()))


files = [f for folder in ("kernels", "engine", "io") for f in sorted((root / folder).rglob("*.[ch]pp"))]
arrows = [(f.relative_to(root).as_posix(), to) for f in files for to in re.findall(r'^#include "((?:kernels|engine|io)/[^"]+)"', f.read_text(), re.M)]
up = [f"{f} includes {to}" for f, to in arrows if floor(to) > floor(f)]
print("\n".join(up) or f"{len(files)} files, {len(arrows)} includes, none runs up")
assert len(files) > 150 and len(arrows) > 300
sys.exit(bool(up))
