#!/usr/bin/env python3
"""make-samples.py - write the shapefiles of valid/ and invalid/ beside this script.

What `isoloft read` makes of them (.loft, .error) is not written here, but looked at
and kept by hand."""

import os
import struct

here = os.path.dirname(os.path.abspath(__file__))

NULL, POINT, LINE, POLYGON, MULTIPOINT = 0, 1, 3, 5, 8
Z, M, MULTIPATCH = 10, 20, 31
OUTER = [(0, 0), (400, 0), (400, 400), (0, 400), (0, 0)]
INNER = [(100, 100), (100, 300), (300, 300), (300, 100), (100, 100)]
MIDDLE = [(50, 50), (50, 350), (350, 350), (350, 50), (50, 50)]
HOLE = INNER


def box(points):
    xs, ys = zip(*points) if points else ((0,), (0,))
    return struct.pack('<4d', min(xs), min(ys), max(xs), max(ys))


def doubles(values):
    return struct.pack(f'<{len(values)}d', *values)


def null():
    return struct.pack('<i', NULL)


def point(x, y, z=None):
    return struct.pack('<i2d', POINT, x, y) if z is None else struct.pack('<i4d', POINT + Z, x, y, z, 0)


def multipoint(points, z=()):
    kind = MULTIPOINT + Z if z else MULTIPOINT
    heights = doubles([min(z), max(z), *z]) if z else b''
    return struct.pack('<i', kind) + box(points) + struct.pack('<i', len(points)) + b''.join(doubles(p) for p in points) + heights


def parts(kind, *lists, z=None, m=None, starts=None, n_parts=None, n_points=None):
    """A polyline or polygon; z, m: one number for all points."""
    points = [p for part in lists for p in part]
    at, table = 0, []
    for part in lists:
        table.append(at)
        at += len(part)
    table = table if starts is None else starts
    out = struct.pack('<i', kind) + box(points)
    out += struct.pack('<2I', len(table) if n_parts is None else n_parts, len(points) if n_points is None else n_points)
    out += struct.pack(f'<{len(table)}I', *table) + b''.join(doubles(p) for p in points)
    for v in (z, m):
        if v is not None:
            out += doubles([v, v] + [v] * len(points))
    return out


def line(*lists, **k):
    return parts(LINE, *lists, **k)


def header(n_bytes, kind=LINE, version=1000, magic=9994):
    return struct.pack('>7i', magic, 0, 0, 0, 0, 0, n_bytes // 2) + struct.pack('<2i8d', version, kind, 0, 0, 400, 400, 0, 0, 0, 0)


def record(number, content, n=None):
    return struct.pack('>2I', number, (len(content) if n is None else n) // 2) + content


def shp(*contents, kind=LINE, **k):
    body = b''.join(record(i + 1, c) for i, c in enumerate(contents))
    return header(100 + len(body), kind, **k) + body


def shx(*contents, kind=LINE):
    at, out = 100, b''
    for c in contents:
        out += struct.pack('>2I', at // 2, len(c) // 2)
        at += 8 + len(c)
    return header(100 + len(out), kind) + out


def dbf(fields, rows, driver=0, deleted=(), **wrong):
    """fields: (name, type, width, decimals); rows: a text for each field."""
    width = 1 + sum(f[2] for f in fields)
    n_header = 32 + 32 * len(fields) + 1
    out = struct.pack('<4BI2H', 3, 124, 1, 1, wrong.get('n_rows', len(rows)), wrong.get('n_header', n_header), wrong.get('width', width))
    out += bytes(17) + bytes([driver]) + bytes(2)
    for name, kind, size, decimals in fields:
        out += name.ljust(11, b'\0') + kind + bytes(4) + bytes([size, decimals]) + bytes(14)
    out += b'\r'
    for i, row in enumerate(rows):
        out += b'*' if i in deleted else b' '
        for (name, kind, size, decimals), text in zip(fields, row):
            out += text.rjust(size) if kind in b'NF' else text.ljust(size)
    return out + b'\x1a'


def elev(*heights, **k):
    return dbf([(b'ELEV', b'N', 10, 2)], [[h] for h in heights], **k)


def write(name, **files):
    folder = 'valid' if name.lower().startswith('v') else 'invalid'
    for extension, data in files.items():
        with open(os.path.join(here, folder, f'{name}.{extension}'), 'wb') as f:
            f.write(data)


LOW, HIGH = line(OUTER), line(INNER)
TABLE = elev(b'100', b'110')
LOW_Z, HIGH_Z = line(OUTER, z=100, m=0).replace(struct.pack('<i', LINE), struct.pack('<i', LINE + Z), 1), \
    line(INNER, z=110, m=0).replace(struct.pack('<i', LINE), struct.pack('<i', LINE + Z), 1)


def valid():
    write('v_polyline', shp=shp(LOW, HIGH), shx=shx(LOW, HIGH), dbf=TABLE)
    write('v_no_index', shp=shp(LOW, HIGH), dbf=TABLE)
    write('v_polyline_z', shp=shp(LOW_Z, HIGH_Z, kind=LINE + Z))
    write('v_polyline_z_without_m', shp=shp(parts(LINE + Z, OUTER, z=100), parts(LINE + Z, INNER, z=110), kind=LINE + Z))
    write('v_polyline_m', shp=shp(parts(LINE + M, OUTER, m=7), parts(LINE + M, INNER, m=-1e39), kind=LINE + M), dbf=TABLE)
    write('v_z_no_data', shp=shp(parts(LINE + Z, OUTER, z=-1.7e308), parts(LINE + Z, INNER, z=-1e39), kind=LINE + Z), dbf=TABLE)
    write('v_open_line', shp=shp(line(OUTER[:4]), line(INNER[:3])), dbf=TABLE)
    write('v_parts', shp=shp(line(OUTER, [(10, 10), (10, 90)]), HIGH), dbf=TABLE)
    write('v_polygon', shp=shp(parts(POLYGON, OUTER, MIDDLE), parts(POLYGON, INNER), kind=POLYGON), dbf=TABLE)
    write('v_polygon_z', shp=shp(parts(POLYGON + Z, OUTER, z=100), parts(POLYGON + Z, INNER, z=110), kind=POLYGON + Z))
    write('v_polygon_m', shp=shp(parts(POLYGON + M, OUTER, m=1), parts(POLYGON + M, INNER, m=1), kind=POLYGON + M), dbf=TABLE)
    write('v_polygon_not_closed', shp=shp(parts(POLYGON, OUTER[:4]), parts(POLYGON, INNER[:4]), kind=POLYGON), dbf=TABLE)
    write('v_points', shp=shp(LOW, point(1, 2), point(1, 2, 3), multipoint([(5, 6), (7, 8)]), HIGH),
          dbf=elev(b'100', b'5', b'5', b'5', b'110'))
    write('v_points_z', shp=shp(LOW_Z, point(40, 200, 104), multipoint([(200, 200), (210, 200)], [118.5, 119]), point(5, 6), HIGH_Z,
                                kind=LINE + Z))
    write('v_points_z_0', shp=shp(LOW, point(40, 200, 0), multipoint([(200, 200), (210, 200)], [0, 0]), HIGH),
          dbf=elev(b'100', b'', b'', b'110'))
    write('v_multipatch', shp=shp(LOW, struct.pack('<i', MULTIPATCH), HIGH), dbf=elev(b'100', b'5', b'110'))
    write('v_null_shape', shp=shp(LOW, null(), HIGH), dbf=elev(b'100', b'5', b'110'))
    write('v_no_points', shp=shp(LOW, line(), HIGH), dbf=elev(b'100', b'5', b'110'))
    write('v_deleted_row', shp=shp(LOW, line(MIDDLE), HIGH), dbf=elev(b'100', b'105', b'110', deleted=[1]))
    # the record in the middle was once written anew, at the end, and the index leads there
    stale = shp(LOW, line(MIDDLE), HIGH)
    index = header(116) + struct.pack('>4I', 50, len(LOW) // 2, (100 + 2 * (8 + len(LOW))) // 2, len(HIGH) // 2)
    write('v_index_leaves_out', shp=stale, shx=index + bytes(8), dbf=TABLE)
    index = bytearray(shx(LOW, HIGH))
    index[104:108] = struct.pack('>I', 9)
    write('v_index_lengths', shp=shp(LOW, HIGH), shx=bytes(index), dbf=TABLE)
    write('v_bytes_behind_end', shp=shp(LOW, HIGH) + bytes(50), dbf=TABLE)
    write('v_prj', shp=shp(LOW, HIGH), dbf=TABLE, prj=b'PROJCS["made_up",GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",'
          b'SPHEROID["WGS_1984",6378137.0,298.257223563]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],'
          b'PROJECTION["Transverse_Mercator"],UNIT["Meter",1.0]]\r\n')
    hoehe = 'HÖHE'
    rows = [[b'100'], [b'110']]
    write('v_code_page', shp=shp(LOW, HIGH), cpg=b'1252\r\n', dbf=dbf([(hoehe.encode('cp1252'), b'N', 10, 2)], rows, driver=2))
    write('v_code_page_utf_8', shp=shp(LOW, HIGH), cpg=b'UTF-8', dbf=dbf([(hoehe.encode(), b'N', 10, 2)], rows, driver=2))
    write('v_language_driver', shp=shp(LOW, HIGH), dbf=dbf([(hoehe.encode('cp850'), b'N', 10, 2)], rows, driver=2))
    write('v_code_page_unknown', shp=shp(LOW, HIGH), cpg=b'EBCDIC', dbf=dbf([(hoehe.encode('cp850'), b'N', 10, 2)], rows, driver=2))
    write('v_text', shp=shp(LOW, HIGH), dbf=dbf([(b'elev', b'C', 10, 0)], [[b'100 m'], [b' 110 m']]))
    write('v_float', shp=shp(LOW, HIGH), dbf=dbf([(b'elev', b'F', 19, 11)], [[b'1.00000000000e+02'], [b'1.10000000000e+02']]))
    write('v_no_value', shp=shp(LOW, line(MIDDLE), line(MIDDLE), HIGH), dbf=elev(b'100', b'', b'**********', b'110'))
    write('v_other_fields', shp=shp(LOW, HIGH), dbf=dbf(
        [(b'DAY', b'D', 8, 0), (b'REF', b'C', 4, 0), (b'ELEV', b'N', 6, 1), (b'NEW', b'L', 1, 0)],
        [[b'20240131', b'a', b'100.0', b'T'], [b'00000000', b'', b'110.0', b'?']]))
    write('v_upper_case', SHP=shp(LOW, HIGH), SHX=shx(LOW, HIGH), DBF=TABLE)


def changed(data, at, new):
    return data[:at] + new + data[at + len(new):]


def invalid():
    good = shp(LOW, HIGH)
    write('x_magic', shp=shp(LOW, HIGH, magic=9995), dbf=TABLE)
    write('x_short_header', shp=good[:60], dbf=TABLE)
    write('x_cut_file', shp=good[:-2], dbf=TABLE)
    write('x_header_length', shp=changed(good, 24, struct.pack('>I', 49)), dbf=TABLE)
    write('x_version', shp=shp(LOW, HIGH, version=1001), dbf=TABLE)
    write('x_record_header', shp=changed(good, 24, struct.pack('>I', 52)), dbf=TABLE)
    write('x_record_length', shp=changed(good, 104, struct.pack('>I', 0x7fffffff)), dbf=TABLE)
    write('x_record_empty', shp=header(108) + record(1, b''), dbf=TABLE)
    write('x_shape_type', shp=shp(struct.pack('<i', 99), HIGH), dbf=TABLE)
    write('x_parts_many', shp=shp(line(OUTER, n_parts=0x80000000), HIGH), dbf=TABLE)
    write('x_points_many', shp=shp(line(OUTER, n_points=0xffffffff), HIGH), dbf=TABLE)
    write('x_parts_first', shp=shp(line(OUTER, starts=[1]), HIGH), dbf=TABLE)
    write('x_parts_order', shp=shp(line(OUTER, starts=[0, 3, 2]), HIGH), dbf=TABLE)
    write('x_parts_equal', shp=shp(line(OUTER, starts=[0, 2, 2]), HIGH), dbf=TABLE)
    write('x_parts_beyond', shp=shp(line(OUTER, starts=[0, 5]), HIGH), dbf=TABLE)
    write('x_no_parts', shp=shp(line(OUTER, starts=[]), HIGH), dbf=TABLE)
    write('x_z_missing', shp=shp(parts(LINE + Z, OUTER), kind=LINE + Z))
    write('x_point_short', shp=shp(struct.pack('<id', POINT, 1), HIGH), dbf=TABLE)
    write('x_not_finite', shp=shp(line([(0, 0), (float('nan'), 1)]), HIGH), dbf=TABLE)
    write('x_beyond_1e15', shp=shp(line([(0, 0), (1, -1e15)]), HIGH), dbf=TABLE)
    write('x_z_infinite', shp=shp(LOW_Z, parts(LINE + Z, INNER, z=float('inf')), kind=LINE + Z))
    write('x_no_heights', shp=good)
    write('x_counts', shp=good, dbf=elev(b'100', b'110', b'120'))
    write('x_upper_case', SHP=good, DBF=elev(b'100', b'110', b'120'))
    write('x_index_magic', shp=good, shx=TABLE, dbf=TABLE)
    write('x_index_cut', shp=good, shx=shx(LOW, HIGH)[:-4], dbf=TABLE)
    write('x_index_offset', shp=good, shx=header(116) + struct.pack('>4I', 50, 100, 0x7fffffff, 100), dbf=TABLE)
    write('x_index_into_header', shp=good, shx=header(116) + struct.pack('>4I', 50, 100, 12, 100), dbf=TABLE)
    write('x_table_short', shp=good, dbf=TABLE[:31])
    write('x_table_header', shp=good, dbf=elev(b'100', b'110', n_header=32))
    write('x_table_no_width', shp=good, dbf=elev(b'100', b'110', width=0))
    write('x_table_fields', shp=good, dbf=elev(b'100', b'110', width=10))
    write('x_table_cut', shp=good, dbf=TABLE[:-3])


if __name__ == '__main__':
    valid()
    invalid()
