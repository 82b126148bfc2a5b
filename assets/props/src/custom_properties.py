#!/usr/bin/env python3
"""Builds assets/props/custom_properties.glb: boxes whose custom properties say how they are painted, written as
Blender writes them. Plain Python, no packages. Metres, y up; each box stands on the ground.

* `cabinet`: properties of the object, with settings of its own; `drawer` below it has none of its own.
* `rail`: properties of its mesh, which has two materials.
* `panel`: properties of its material.
* `window`: is not painted.
* `misspelt`: names a preset that there is not.
* `stone`: has properties, but none about paint.
"""
import json
import struct
from pathlib import Path

FILE = Path(__file__).parent.parent / "custom_properties.glb"

binary, views, accessors = bytearray(), [], []


def accessor(values, kind, component, code, target):
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[kind]
    while len(binary) % 4:
        binary.append(0)
    rows = values if width > 1 else [(value,) for value in values]
    views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": 0, "target": target})
    for row in rows:
        binary.extend(struct.pack("<" + code * width, *row))
    views[-1]["byteLength"] = len(binary) - views[-1]["byteOffset"]
    made = {"bufferView": len(views) - 1, "componentType": component, "count": len(rows), "type": kind}
    if kind == "VEC3":
        made["min"], made["max"] = ([float(f(row[i] for row in rows)) for i in range(3)] for f in (min, max))
    accessors.append(made)
    return len(accessors) - 1


def sides(size, axes):
    """Primitive of the two sides of a box across each of the axes."""
    positions, normals, uvs, indices = [], [], [], []
    for axis in axes:
        for sign in (-1, 1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(positions)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                corner, normal = [0.0] * 3, [0.0] * 3
                corner[axis], corner[u], corner[v] = sign, a * sign, b
                normal[axis] = float(sign)
                place = [0.5 * c * s for c, s in zip(corner, size)]
                place[1] += 0.5 * size[1]
                positions.append(tuple(place))
                normals.append(tuple(normal))
                uvs.append((0.5 + 0.5 * a, 0.5 - 0.5 * b))
            indices += [first, first + 1, first + 2, first, first + 2, first + 3]
    return {
        "POSITION": accessor(positions, "VEC3", 5126, "f", 34962),
        "NORMAL": accessor(normals, "VEC3", 5126, "f", 34962),
        "TEXCOORD_0": accessor(uvs, "VEC2", 5126, "f", 34962),
    }, accessor(indices, "SCALAR", 5123, "H", 34963)


def primitive(size, axes, material):
    attributes, indices = sides(size, axes)
    return {"attributes": attributes, "indices": indices, "material": material}


def paint(name, color, **more):
    factors = {"baseColorFactor": [*color, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.4}
    return {"name": name, "pbrMetallicRoughness": factors, **more}


def box(name, size, material, **more):
    return {"name": name, "primitives": [primitive(size, (0, 1, 2), material)], **more}


materials = [
    paint("green", (0.1, 0.3, 0.15)),
    paint("yellow", (0.7, 0.5, 0.05)),
    paint("black", (0.03, 0.03, 0.03)),
    paint("powder", (0.5, 0.5, 0.52), extras={"coating": "powder_coat"}),
]
size = (0.5, 0.7, 0.3)
two = [primitive(size, (0, 2), 1), primitive(size, (1,), 2)]
meshes = [
    box("cabinet", size, 0),
    box("drawer", (0.4, 0.15, 0.1), 0),
    {"name": "rail", "primitives": two, "extras": {"coating": "marine"}},
    box("panel", size, 3),
    box("window", size, 2),
    box("misspelt", size, 0),
    box("stone", size, 2),
]
cabinet = {
    "coating": "harsh",
    # As Blender writes 1.8 in single precision.
    "coating.adhesion.mean": 1.7999999523162842,
    "coating_seed": 7,
    "coating_start_age": 0.5,
    "mass": 40,
}
nodes = [
    {"name": "cabinet", "mesh": 0, "children": [1], "extras": cabinet},
    {"name": "drawer", "mesh": 1, "translation": [0, 0.8, 0]},
    {"name": "rail", "mesh": 2, "translation": [0.8, 0, 0]},
    {"name": "panel", "mesh": 3, "translation": [1.6, 0, 0]},
    {"name": "window", "mesh": 4, "translation": [2.4, 0, 0], "extras": {"coating": False}},
    {"name": "misspelt", "mesh": 5, "translation": [3.2, 0, 0], "extras": {"coating": "hrash"}},
    {"name": "stone", "mesh": 6, "translation": [4.0, 0, 0], "extras": {"mass": 90}},
]
document = {
    "asset": {"version": "2.0", "generator": "custom_properties.py", "copyright": "CC0-1.0"},
    "scene": 0,
    "scenes": [{"name": "yard", "nodes": [0, 2, 3, 4, 5, 6]}],
    "nodes": nodes,
    "meshes": meshes,
    "materials": materials,
    "accessors": accessors,
    "bufferViews": views,
    "buffers": [{"byteLength": len(binary)}],
}
text = json.dumps(document, separators=(",", ":")).encode()
text += b" " * (-len(text) % 4)
binary += b"\0" * (-len(binary) % 4)
whole = 12 + 8 + len(text) + 8 + len(binary)
FILE.write_bytes(
    struct.pack("<4sII", b"glTF", 2, whole)
    + struct.pack("<I4s", len(text), b"JSON")
    + text
    + struct.pack("<I4s", len(binary), b"BIN\0")
    + binary
)
print(f"{FILE.name}: {whole} bytes")
