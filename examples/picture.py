#!/usr/bin/env python3
"""picture.py LINES.loft MESH.obj PICTURE.png - contours on the left, their surface on the right.

Draws examples/vase.png, tree.png, island.png and jacksboro.png: a depth buffer, one light, and nothing that the
standard library lacks.  Solids stand upright, the origin in the middle; of maps, which are seen from
higher up, the lines are taken to where the mesh's comments say that it was put."""

import math
import struct
import sys
import zlib

WIDTH, FINE, MARGIN = 800, 3, 20        # FINE x FINE samples a pixel
TURN = math.radians(-38)
LIGHT = (-0.45, -0.55, 0.70)
PAPER, CLAY, INK, EDGE = (255, 255, 255), (222, 164, 120), (70, 84, 110), (120, 82, 58)
LIFT, FEW = 2, 100                     # pixels by which lines stand out of a surface, if there are fewer than that


class View:
    """height: of the picture, in pixels; thick: lines, likewise."""

    def __init__(self, terrain):
        self.height, self.thick = (320, 0.7) if terrain else (560, 1.1)
        self.tilt = math.radians(38 if terrain else 24)

    def turned(self, p):
        """World to view: x right, y up, z towards the eye."""
        x, y, z = p
        x, y = x * math.cos(TURN) - y * math.sin(TURN), x * math.sin(TURN) + y * math.cos(TURN)
        rise, depth = math.cos(self.tilt), math.sin(self.tilt)
        return x, z * rise + y * depth, z * depth - y * rise

    def pixels(self, points):
        """Pixels a unit, so that POINTS fit half the picture, and the lowest of them."""
        low, high = min(p[1] for p in points), max(p[1] for p in points)
        wide = max(abs(p[0]) for p in points)
        return min((self.height - 2 * MARGIN) / (high - low), (WIDTH / 4 - MARGIN / 2) / wide), low


def read_lines(path):
    """Rings and lines as lists of points, the first again behind a ring's last; and: are they terrain's?"""
    lines, rings, terrain, z = [], [], False, 0.0
    for line in open(path, encoding="utf-8"):
        word = line.split()
        if word[:2] == ["kind", "terrain"]:
            terrain = True
        elif word and word[0] == "slice":
            z = float(word[1])
        elif word and word[0] in ("ring", "line"):
            lines.append([])
            if word[0] == "ring":
                rings.append(lines[-1])
        elif len(word) == 2 and word[0][0] in "-0123456789":
            lines[-1].append((float(word[0]), float(word[1]), z))
    for ring in rings:
        ring.append(ring[0])
    return lines, terrain


def read_mesh(path):
    """Points, triangles, and the mesh's place: a point times scale plus offset is where it is on the map."""
    points, triangles, place = [], [], {"offset": (0, 0, 0), "scale": (1, 1, 1)}
    for line in open(path, encoding="utf-8"):
        word = line.split()
        if word and word[0] == "v":
            points.append(tuple(map(float, word[1:4])))
        elif word and word[0] == "f":
            triangles.append([int(w.split("/")[0]) - 1 for w in word[1:4]])
        elif word[:2] == ["#", "stack"] and word[3] in place and len(word) == 7:
            place[word[3]] = tuple(map(float, word[4:7]))
    return points, triangles, place


def corner_normals(points, triangles, crease=math.cos(math.radians(50))):
    """Normals of the triangles' corners: the mean of the faces around a vertex that bend little from this one."""
    faces, around = [], [[] for _ in points]
    for k, (a, b, c) in enumerate(triangles):
        u = [points[b][i] - points[a][i] for i in range(3)]
        v = [points[c][i] - points[a][i] for i in range(3)]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        size = math.sqrt(sum(x * x for x in n)) or 1.0
        faces.append((n, tuple(x / size for x in n)))
        for p in (a, b, c):
            around[p].append(k)
    result = []
    for k, corners in enumerate(triangles):
        row = []
        for p in corners:
            total = [0.0, 0.0, 0.0]
            for other in around[p]:
                if sum(faces[k][1][i] * faces[other][1][i] for i in range(3)) > crease:
                    total = [total[i] + faces[other][0][i] for i in range(3)]
            size = math.sqrt(sum(x * x for x in total)) or 1.0
            row.append([x / size for x in total])
        result.append(row)
    return result


class Canvas:
    def __init__(self, height, scale, low):
        self.w, self.h = WIDTH * FINE, height * FINE
        self.depth = [-1e9] * (self.w * self.h)
        self.color = bytearray(PAPER * (self.w * self.h))
        self.scale, self.low = scale * FINE, low

    def place(self, p, middle, lift=0):
        x, y = middle * FINE + p[0] * self.scale, (p[1] - self.low) * self.scale
        return x, self.h - y - MARGIN * FINE, p[2] + lift * FINE / self.scale

    def dot(self, x, y, z, color):
        if 0 <= x < self.w and 0 <= y < self.h:
            k = y * self.w + x
            if z >= self.depth[k]:
                self.depth[k] = z
                self.color[3 * k:3 * k + 3] = bytes(color)

    def line(self, a, b, color, width):
        n = int(max(abs(b[0] - a[0]), abs(b[1] - a[1]))) + 1
        r = width * FINE / 2
        for i in range(n + 1):
            x, y, z = (a[k] + (b[k] - a[k]) * i / n for k in range(3))
            for dy in range(-int(r) - 1, int(r) + 2):
                for dx in range(-int(r) - 1, int(r) + 2):
                    if dx * dx + dy * dy <= r * r:
                        self.dot(int(x) + dx, int(y) + dy, z, color)

    def triangle(self, p, normals):
        det = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1])
        if abs(det) < 1e-12:
            return
        x0, x1 = max(0, int(min(q[0] for q in p))), min(self.w - 1, int(max(q[0] for q in p)) + 1)
        y0, y1 = max(0, int(min(q[1] for q in p))), min(self.h - 1, int(max(q[1] for q in p)) + 1)
        for y in range(y0, y1 + 1):
            for x in range(x0, x1 + 1):
                v = ((x - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (y - p[0][1])) / det
                w = ((p[1][0] - p[0][0]) * (y - p[0][1]) - (x - p[0][0]) * (p[1][1] - p[0][1])) / det
                u = 1 - v - w
                if u < -1e-9 or v < -1e-9 or w < -1e-9:
                    continue
                z = u * p[0][2] + v * p[1][2] + w * p[2][2]
                if z > self.depth[y * self.w + x]:
                    normal = [u * normals[0][i] + v * normals[1][i] + w * normals[2][i] for i in range(3)]
                    self.dot(x, y, z, shade(normal))

    def write(self, path):
        rows = bytearray()
        for y in range(self.h // FINE):
            rows.append(0)
            for x in range(WIDTH):
                for c in range(3):
                    total = sum(self.color[3 * ((y * FINE + j) * self.w + x * FINE + i) + c]
                                for j in range(FINE) for i in range(FINE))
                    rows.append(total // (FINE * FINE) // 4 * 4 + 3)   # 6 bits a channel pack better
        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        with open(path, "wb") as out:
            out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, self.h // FINE, 8, 2, 0, 0, 0)) +
                      chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b""))


def shade(n):
    size = math.sqrt(sum(x * x for x in n)) or 1.0
    n = [x / size for x in n]
    light = math.sqrt(sum(x * x for x in LIGHT))
    direct = max(0.0, sum(a * b for a, b in zip(n, (LIGHT[0] / light, LIGHT[1] / light * -1, LIGHT[2] / light))))
    shine = max(0.0, n[2] * 0.8 + direct * 0.3 - 0.05) ** 24 * 0.25
    return [max(0, min(255, int(c * (0.34 + 0.16 * n[1] + 0.58 * direct) + 255 * shine))) for c in CLAY]


def main(contours, mesh, picture):
    lines, terrain = read_lines(contours)
    vertices, triangles, place = read_mesh(mesh)
    view = View(terrain)
    offset, scale = place["offset"], place["scale"]
    lines = [[view.turned([(p[i] - offset[i]) / scale[i] for i in range(3)]) for p in line] for line in lines]
    vertices = [view.turned(p) for p in vertices]
    canvas = Canvas(view.height, *view.pixels(vertices))
    far, near = min(p[2] for line in lines for p in line), max(p[2] for line in lines for p in line)
    for line in lines:
        for a, b in zip(line, line[1:]):
            fade = 0.72 * (1 - ((a[2] + b[2]) / 2 - far) / (near - far))
            canvas.line(canvas.place(a, WIDTH // 4), canvas.place(b, WIDTH // 4),
                        [int(c + (255 - c) * fade) for c in INK], view.thick)
    placed = [canvas.place(p, 3 * WIDTH // 4) for p in vertices]
    for corners, normals in zip(triangles, corner_normals(vertices, triangles)):
        canvas.triangle([placed[k] for k in corners], normals)
    for line in lines if terrain and len(lines) < FEW else []:
        for a, b in zip(line, line[1:]):
            canvas.line(canvas.place(a, 3 * WIDTH // 4, LIFT), canvas.place(b, 3 * WIDTH // 4, LIFT), EDGE, 0.4)
    canvas.write(picture)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
