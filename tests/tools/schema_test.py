#!/usr/bin/env python3
"""Every scene and study of configs/ keeps to its schema, and the schema refuses what the reader refuses. Usage: schema_test.py SOURCE_FOLDER"""
import copy
import json
import sys
import tomllib
from pathlib import Path

import jsonschema

configs = Path(sys.argv[1]) / "configs"


def validator(name):
    schema = json.loads((configs / name).read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


scene, study = validator("scene.schema.json"), validator("study.schema.json")
scenes = [*configs.glob("*.toml"), *configs.glob("extreme/*.toml")]
studies = [*configs.glob("studies/*.toml")]
assert len(scenes) >= 18 and len(studies) >= 20, (len(scenes), len(studies))
for files, schema, name in ((scenes, scene, "scene.schema.json"), (studies, study, "study.schema.json")):
    for file in files:
        for error in schema.iter_errors(tomllib.loads(file.read_text())):
            raise SystemExit(f"{file}: {error.json_path}: {error.message}")
        first = file.read_text().splitlines()[0]
        assert first.startswith("#:schema ") and (file.parent / first.split()[1]).resolve() == (configs / name).resolve(), file

small = tomllib.loads('''scene = "small"
mesh = { box = { size = [1, 2, 3] } }
material = { law = "neo_hookean", density = 1000, youngs_modulus = 1e6, poissons_ratio = 0.3 }
boundary = [{ face = "xmin", kind = "fixed" }]
time = { end = 1 }
''')
assert scene.is_valid(small)


def refused(change):
    changed = copy.deepcopy(small)
    change(changed)
    assert not scene.is_valid(changed), changed


refused(lambda s: s.pop("mesh"))
refused(lambda s: s["mesh"].pop("box"))
refused(lambda s: s["mesh"].update(cylinder={"radius": 1, "length": 1}))
refused(lambda s: s["mesh"].update(cells=[1, 2]))
refused(lambda s: s["material"].update(law="ogden"))
refused(lambda s: s["material"].update(xi=1))  # of mooney_rivlin only
refused(lambda s: s["material"].update(law="mooney_rivlin"))  # without its xi
refused(lambda s: s["material"].update(poissons_ratio=0.6))
refused(lambda s: s["material"].update(denisty=1))
refused(lambda s: s["boundary"][0].update(p=1))
refused(lambda s: s["boundary"][0].update(kind="pressure"))
refused(lambda s: s.update(body_force=[0, 0, -9.81]))
refused(lambda s: s.update(initial={"v": [0, 0, 1]}))  # the field is at rest by default
refused(lambda s: s.update(initial={"field": "twist", "omega": [0, 0, 1], "height": 1, "centre": "mass"}))
refused(lambda s: s.update(output={"fields": ["stress"]}))
print(f"{len(scenes)} scenes and {len(studies)} studies keep to their schemas")
