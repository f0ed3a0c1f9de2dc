#!/usr/bin/env python3
"""What the program tells of its keys, put where people and editors look for it:
    configs/reference.py PROGRAM           writes the reference of configs/README.md, both schemas, the completions, README.md's scene
    configs/reference.py --check PROGRAM   writes nothing; exit 1 and the names when one of them is not the program's"""
import subprocess
import sys
import tempfile
from pathlib import Path

root = Path(__file__).resolve().parent.parent
check = sys.argv[1:2] == ["--check"]
program = sys.argv[2 if check else 1]


def told(*arguments):
    return subprocess.run([program, "keys", *arguments], check=True, capture_output=True, text=True).stdout


def between(path, begin, end, text):
    """The file with `text` between the line `begin` and the line `end`."""
    before, rest = path.read_text().split(begin + "\n", 1)
    return before + begin + "\n" + text + end + rest.split(end, 1)[1]


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([Path(program).resolve(), "new", "beam"], cwd=folder, check=True, capture_output=True)
    beam = (Path(folder) / "beam.toml").read_text()

wanted = {
    root / "configs/scene.schema.json": told("--json"),
    root / "configs/study.schema.json": told("--json", "--study"),
}
door = root / "README.md"
wanted[door] = between(door, "```toml", "```", beam)
readme, completions = root / "configs/README.md", root / "completions/nanson"
wanted[readme] = between(readme, "<!-- keys:begin -->", "<!-- keys:end -->", told("--markdown"))
wanted[completions] = between(completions, "  local settings='", "'  # end of settings", told("--settings"))

other = [path for path, text in wanted.items() if not path.exists() or path.read_text() != text]
for path in other:
    print(f"{path.relative_to(root)}: {'is not what the program tells: run configs/reference.py' if check else 'written'}")
    if not check:
        path.write_text(wanted[path])
sys.exit(check and bool(other))
