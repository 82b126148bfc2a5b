#!/usr/bin/env python3
"""Builds assets/city/street_sign.glb from street_sign.png. Plain Python, no packages.

Four meshes, each one connected surface, metres, y up, the face of the plate towards +z, origin at
the foot of the sign:

* `plate`: a pressed sheet: face, bevelled edge, rim and a narrow return behind it. The enamel is one
  chart: the edge is unfolded around the face, so there are no UV seams.
* `post_left`, `post_right`: round posts with domed caps.
* `fittings`: the bare back of the plate, two rails and four clamps, not painted.
"""
import json
import math
import struct
from pathlib import Path

CITY = Path(__file__).parent.parent
# The same figures as in street_sign_texture.py.
WIDTH, HEIGHT, CORNER, MARGIN = 1.30, 0.78, 0.07, 0.04
CENTRE_Y, DEPTH, BEVEL, RETURN = 1.72, 0.022, 0.004, 0.012
POST_X, POST_RADIUS, POST_TOP, POST_Z = 0.40, 0.030, 2.22, -0.062


class Mesh:
    def __init__(self):
        self.positions, self.normals, self.uvs, self.indices = [], [], [], []

    def vertex(self, position, normal, uv=(0.0, 0.0)):
        length = math.sqrt(sum(c * c for c in normal)) or 1.0
        self.positions.append(tuple(position))
        self.normals.append(tuple(c / length for c in normal))
        self.uvs.append(tuple(uv))
        return len(self.positions) - 1

    def quad(self, a, b, c, d):
        self.indices += [a, b, c, a, c, d]

    def strip(self, lower, upper, closed=True):
        """Two rings of equal length; seen from outside `upper` lies to the left of `lower`."""
        count = len(lower)
        for i in range(count if closed else count - 1):
            j = (i + 1) % count
            self.quad(lower[i], lower[j], upper[j], upper[i])

    def tube(self, base, radius, y0, y1, segments=32, cap=True):
        """A round post along y with a shallow dome on top."""
        # Radius, height, and the normal's outward and upward parts; equal places make a hard edge.
        profile = [(radius, y0, 1.0, 0.0), (radius, y1, 1.0, 0.0)]
        if cap:
            profile += [(radius, y1, 0.0, -1.0), (radius * 1.12, y1, 0.0, -1.0), (radius * 1.12, y1, 1.0, 0.0)]
            profile += [(radius * 1.12, y1 + 0.018, 1.0, 0.0)]
            profile += [
                (radius * 1.12 * math.cos(a), y1 + 0.018 + 0.02 * math.sin(a), math.cos(a), math.sin(a))
                for a in (math.radians(d) for d in (10, 25, 45, 65, 82))
            ]
        rings, length = [], 0.0
        for row, (r, y, out, up) in enumerate(profile):
            if row:
                length += math.hypot(r - profile[row - 1][0], y - profile[row - 1][1])
            ring = []
            for i in range(segments + 1):
                angle = 2 * math.pi * i / segments
                c, s = math.cos(angle), math.sin(angle)
                # The seam is at the back.
                ring.append(self.vertex(
                    (base[0] - r * s, y, base[1] - r * c), (-out * s, up, -out * c),
                    (i / segments, length),
                ))
            rings.append(ring)
        for row in range(len(rings) - 1):
            if profile[row][:2] == profile[row + 1][:2]:
                continue  # A hard edge: two rings at one place.
            lower, upper = rings[row], rings[row + 1]
            for i in range(segments):
                self.quad(lower[i], lower[i + 1], upper[i + 1], upper[i])
        if cap:
            top = self.vertex((base[0], y1 + 0.0385, base[1]), (0, 1, 0), (0.5, length + 0.01))
            for i in range(segments):
                self.indices += [rings[-1][i], rings[-1][i + 1], top]

    def box(self, low, high):
        for axis in range(3):
            for side in (0, 1):
                normal = [0.0, 0.0, 0.0]
                normal[axis] = 1.0 if side else -1.0
                u, v = (axis + 1) % 3, (axis + 2) % 3
                corners = []
                for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)) if side else ((0, 0), (0, 1), (1, 1), (1, 0)):
                    p = [0.0, 0.0, 0.0]
                    p[axis] = (low, high)[side][axis]
                    p[u] = (low, high)[a][u]
                    p[v] = (low, high)[b][v]
                    corners.append(self.vertex(p, normal, (p[u], p[v])))
                self.quad(*corners)


def outline(segments=8):
    """The plate's rounded rectangle, counter-clockwise from the front: (x, y, nx, ny)."""
    points = []
    for corner, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        cx, cy = sx * (WIDTH / 2 - CORNER), sy * (HEIGHT / 2 - CORNER)
        for i in range(segments + 1):
            angle = math.pi / 2 * (corner + i / segments)
            points.append((cx, cy, math.cos(angle), math.sin(angle)))
    return points


def plate():
    mesh, points = Mesh(), outline()

    def uv(x, y):
        return ((x + WIDTH / 2 + MARGIN) / (WIDTH + 2 * MARGIN), (HEIGHT / 2 + MARGIN - y) / (HEIGHT + 2 * MARGIN))

    def ring(radius, z, unfolded, out, front):
        """`unfolded`: how far outside the face's corner arc the picture has the ring."""
        return [
            mesh.vertex(
                (cx + nx * radius, CENTRE_Y + cy + ny * radius, z), (nx * out, ny * out, front),
                uv(cx + nx * unfolded, cy + ny * unfolded),
            )
            for cx, cy, nx, ny in points
        ]

    # Profile from the face backwards; the bevel is smooth, rim and return meet at a hard edge.
    inner = CORNER - BEVEL
    face = ring(inner, DEPTH / 2, inner, 0.0, 1.0)
    bevel = [face]
    for step in (1, 2, 3):
        angle = math.pi / 2 * step / 3
        bevel.append(ring(
            inner + BEVEL * math.sin(angle), DEPTH / 2 - BEVEL * (1 - math.cos(angle)),
            inner + BEVEL * angle, math.sin(angle), math.cos(angle),
        ))
    edge = inner + BEVEL * math.pi / 2
    depth = DEPTH - BEVEL
    rim = ring(CORNER, -DEPTH / 2, edge + depth, 1.0, 0.0)
    back_edge = ring(CORNER, -DEPTH / 2, edge + depth, 0.0, -1.0)
    back = ring(CORNER - RETURN, -DEPTH / 2, edge + depth + RETURN, 0.0, -1.0)
    for outer, inner_ring in zip(bevel[1:] + [rim], bevel):
        mesh.strip(outer, inner_ring)
    mesh.strip(back, back_edge)
    # The face: four corner fans and a cross of rectangles, so that no sliver spans the plate.
    per = len(points) // 4
    corners = [
        mesh.vertex((cx, CENTRE_Y + cy, DEPTH / 2), (0, 0, 1), uv(cx, cy))
        for cx, cy, _, _ in points[::per]
    ]
    for c in range(4):
        first = c * per
        for i in range(per - 1):
            mesh.indices += [corners[c], face[first + i], face[first + i + 1]]
        following = (c + 1) % 4
        mesh.quad(corners[c], face[first + per - 1], face[following * per], corners[following])
    mesh.quad(*corners)
    return mesh


def post(side):
    mesh = Mesh()
    mesh.tube((side * POST_X, POST_Z), POST_RADIUS, 0.0, POST_TOP)
    return mesh


def fittings():
    mesh = Mesh()
    back = -DEPTH / 2 + 0.001
    half = (WIDTH / 2 - RETURN * 0.5, HEIGHT / 2 - RETURN * 0.5)
    inset = CORNER - RETURN * 0.5
    points = outline()
    per = len(points) // 4
    ring = [mesh.vertex((cx + nx * inset, CENTRE_Y + cy + ny * inset, back), (0, 0, -1)) for cx, cy, nx, ny in points]
    corners = [mesh.vertex((cx, CENTRE_Y + cy, back), (0, 0, -1)) for cx, cy, _, _ in points[::per]]
    for c in range(4):
        first, following = c * per, (c + 1) % 4
        for i in range(per - 1):
            mesh.indices += [corners[c], ring[first + i + 1], ring[first + i]]
        mesh.quad(corners[c], corners[following], ring[following * per], ring[first + per - 1])
    mesh.quad(*reversed(corners))
    for rail in (-0.22, 0.22):
        y = CENTRE_Y + rail
        mesh.box((-half[0] + 0.05, y - 0.02, POST_Z + POST_RADIUS), (half[0] - 0.05, y + 0.02, back - 0.0005))
        for side in (-1, 1):
            x, r = side * POST_X, POST_RADIUS + 0.006
            mesh.box((x - r - 0.012, y - 0.016, POST_Z - r), (x + r + 0.012, y + 0.016, POST_Z + POST_RADIUS))
    return mesh


def glb(parts, materials, image):
    blob, views, accessors, meshes, nodes = bytearray(), [], [], [], []

    def view(data, target=None):
        while len(blob) % 4:
            blob.append(0)
        views.append({"buffer": 0, "byteOffset": len(blob), "byteLength": len(data)})
        if target:
            views[-1]["target"] = target
        blob.extend(data)
        return len(views) - 1

    def accessor(rows, kind):
        flat = [c for row in rows for c in row]
        entry = {
            "bufferView": view(struct.pack(f"<{len(flat)}f", *flat), 34962),
            "componentType": 5126, "count": len(rows), "type": kind,
        }
        if kind == "VEC3":
            # Bounds in the precision of the file.
            single = [struct.unpack("<3f", struct.pack("<3f", *row)) for row in rows]
            entry["min"] = [min(c) for c in zip(*single)]
            entry["max"] = [max(c) for c in zip(*single)]
        accessors.append(entry)
        return len(accessors) - 1

    for name, mesh, material in parts:
        attributes = {
            "POSITION": accessor(mesh.positions, "VEC3"),
            "NORMAL": accessor(mesh.normals, "VEC3"),
            "TEXCOORD_0": accessor(mesh.uvs, "VEC2"),
        }
        accessors.append({
            "bufferView": view(struct.pack(f"<{len(mesh.indices)}H", *mesh.indices), 34963),
            "componentType": 5123, "count": len(mesh.indices), "type": "SCALAR",
        })
        meshes.append({"name": name, "primitives": [
            {"attributes": attributes, "indices": len(accessors) - 1, "material": material}]})
        nodes.append({"name": name, "mesh": len(meshes) - 1})
    picture = view(image)
    document = {
        "asset": {"version": "2.0", "generator": "street_sign_model.py"},
        "scene": 0,
        "scenes": [{"name": "street_sign", "nodes": list(range(len(nodes)))}],
        "nodes": nodes, "meshes": meshes, "materials": materials,
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 33071, "wrapT": 33071}],
        "images": [{"name": "street_sign", "bufferView": picture, "mimeType": "image/png"}],
        "buffers": [{"byteLength": len(blob)}], "bufferViews": views, "accessors": accessors,
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    blob.extend(b"\0" * (-len(blob) % 4))
    return (struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(blob))
            + struct.pack("<II", len(text), 0x4E4F534A) + text
            + struct.pack("<II", len(blob), 0x004E4942) + bytes(blob))


def main():
    materials = [
        {"name": "enamel", "pbrMetallicRoughness": {
            "baseColorTexture": {"index": 0}, "metallicFactor": 0.0, "roughnessFactor": 0.38}},
        {"name": "post_paint", "pbrMetallicRoughness": {
            "baseColorFactor": [0.30, 0.33, 0.33, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.5}},
        {"name": "galvanised", "pbrMetallicRoughness": {
            "baseColorFactor": [0.42, 0.43, 0.44, 1.0], "metallicFactor": 0.85, "roughnessFactor": 0.55}},
    ]
    parts = [("plate", plate(), 0), ("post_left", post(-1), 1), ("post_right", post(1), 1), ("fittings", fittings(), 2)]
    target = CITY / "street_sign.glb"
    target.write_bytes(glb(parts, materials, (CITY / "street_sign.png").read_bytes()))
    for name, mesh, _ in parts:
        print(name, len(mesh.positions), "vertices", len(mesh.indices) // 3, "triangles")
    print(target.name, target.stat().st_size, "bytes")


main()
