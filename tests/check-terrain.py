"""What check-terrain asks of a surface and of the contour TIN beside the neutral scorer's figures.

    check-terrain.py SCORE MODEL INTERVAL LINES SURFACE SURFACE-GRID TIN TIN-GRID

SCORE holds score_terrain.py; LINES is a native stream, SURFACE and TIN are binary PLY, and the
grids what the scorer made of them.  One line of numbers on standard output:

    RMSE in intervals of the surface and of the TIN, over the cells that both cover
    cells that the TIN covers and the surface does not
    vertices of LINES that are not on the surface; vertices of LINES; of the surface
    median of the triangles' smallest angles in plan, degrees, and the share below 5 degrees, of
    the surface and then of the TIN
"""
import sys

import numpy
from osgeo import gdal

TYPES = {"double": "<f8", "float": "<f4", "int": "<i4", "uint": "<u4", "uchar": "u1"}


def read_ply(path):
    """Vertices and triangles.  All lists are triples, one a face."""
    data = open(path, "rb").read()
    head, body = data.split(b"end_header\n", 1)
    elements = []
    for word in (line.split() for line in head.decode().splitlines()):
        if word[:1] == ["element"]:
            elements.append((word[1], int(word[2]), []))
        elif word[:2] == ["property", "list"]:
            elements[-1][2].extend([("n", TYPES[word[2]]), ("triple", TYPES[word[3]], 3)])
        elif word[:1] == ["property"]:
            elements[-1][2].append((word[2], TYPES[word[1]]))
    found, at = {}, 0
    for name, n, fields in elements:
        kind = numpy.dtype(fields)
        found[name] = numpy.frombuffer(body, kind, n, at)
        at += n * kind.itemsize
    v = found["vertex"]
    return numpy.column_stack([v["x"], v["y"], v["z"]]), found["face"]["triple"]


def read_lines(path):
    """Vertices of a native stream, with the heights of their slices."""
    z, points = 0.0, []
    for word in (line.split() for line in open(path)):
        if word[:1] == ["slice"]:
            z = float(word[1])
        elif len(word) == 2 and word[0][0] in "-.0123456789":
            points.append((float(word[0]), float(word[1]), z))
    return points


def angles(xyz, triangles, shrink):
    """Median of the smallest angles in plan, and the share of those below 5 degrees."""
    p = (xyz[:, :2] * (shrink, 1))[triangles]
    sides = numpy.sort(numpy.hypot(*(p - numpy.roll(p, 1, axis=1)).transpose(2, 0, 1)), axis=1)
    with numpy.errstate(invalid="ignore", divide="ignore"):
        cosine = (sides[:, 1] ** 2 + sides[:, 2] ** 2 - sides[:, 0] ** 2) / (2 * sides[:, 1] * sides[:, 2])
    least = numpy.degrees(numpy.arccos(numpy.clip(numpy.nan_to_num(cosine, nan=1), -1, 1)))
    return numpy.median(least), (least < 5).mean()


def main():
    score, model, interval, lines, surface, surface_grid, tin, tin_grid = sys.argv[1:]
    sys.path.insert(0, score)
    import score_terrain

    truth, place = score_terrain.load_dem(model)
    a, b = (score_terrain.load_dem(f)[0] for f in (surface_grid, tin_grid))
    inside = score_terrain.erode(numpy.isfinite(truth), 3) & numpy.isfinite(b)
    both = inside & numpy.isfinite(a)
    for z in (a, b):
        print("%.5f" % (numpy.sqrt(((z - truth)[both] ** 2).mean()) / float(interval)), end=" ")
    xyz, triangles = read_ply(surface)
    points, vertices = read_lines(lines), set(map(tuple, xyz))
    lost = sum(p not in vertices for p in points)
    print((inside & ~both).sum(), lost, len(points), len(xyz), end=" ")
    where = gdal.Open(model).GetSpatialRef()
    middle = place[3] + place[5] * truth.shape[0] / 2
    shrink = numpy.cos(numpy.radians(middle)) if where and where.IsGeographic() else 1
    for mesh in ((xyz, triangles), read_ply(tin)):
        print("%.2f %.4f" % angles(*mesh, shrink), end=" ")
    print()


main()
