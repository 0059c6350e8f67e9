# island.awk - isolines of an island with a crater and a second peak, and of the sea floor around it:
#     awk -v form=geojson -f island.awk > island.geojson
#     awk -v form=gmt     -f island.awk > island.gmt
#
# In GeoJSON the peaks and pits are there as points, spot heights; a GMT file of lines has none.
#
# The ground is a sum of bumps over a grid in longitude and latitude.  Where a level
# passes through a cell of the grid it cuts two of its sides (marching squares); a
# side that is cut is called by its place, and each piece runs from side to side with
# the higher ground on its right, so that `next_side` leads along a whole line.

BEGIN {
    columns = 80; rows = 70; interval = 20
    west = -9.62; south = 53.04; step = 0.0011
    for (j = 0; j <= rows; j++)
        for (i = 0; i <= columns; i++)
            h[i, j] = ground(i / columns, j / rows)
    if (form == "gmt") print "# @VGMT1.0 @GLINESTRING @Je4326\n# @Nelev\n# @Tdouble\n# FEATURE_DATA"
    else print "{\"type\":\"FeatureCollection\",\"name\":\"island\",\"features\":["
    for (level = -120; level <= 240; level += interval)
        lines(level)
    if (form != "gmt") { spots(); print "\n]}" }
}

function bump(x, y, cx, cy, w) { return exp(-((x - cx) ^ 2 + (y - cy) ^ 2) / (w * w)) }

# Metres above the sea; no grid point lies exactly on a level.
function ground(x, y) {
    return 0.123 - 90 + 320 * bump(x, y, 0.45, 0.5, 0.24) - 190 * bump(x, y, 0.44, 0.52, 0.09) \
        + 220 * bump(x, y, 0.78, 0.72, 0.1) + 60 * bump(x, y, 0.95, 0.1, 0.3) - 40 * bump(x, y, 0.1, 0.9, 0.2)
}

function lines(level,    i, j, side, start, n) {
    delete next_side; delete entered
    for (j = 0; j < rows; j++)
        for (i = 0; i < columns; i++)
            cell(i, j, level)
    n = 0
    for (j = 0; j <= rows; j++) for (i = 0; i <= columns; i++) { # in an order that any awk has
        order[n++] = i " " j " x"; order[n++] = i " " j " y"
    }
    for (k = 0; k < n; k++) if (order[k] in next_side && !(order[k] in entered)) line(order[k], level)
    for (k = 0; k < n; k++) if (order[k] in next_side) line(order[k], level)
}

# Corners from the south-west on, counter-clockwise; a bit each for those above the level.
function cell(i, j, level,    a, b, c, d, s, e, n, w, saddle) {
    a = h[i, j] > level; b = h[i + 1, j] > level; c = h[i + 1, j + 1] > level; d = h[i, j + 1] > level
    s = i " " j " x"; n = i " " (j + 1) " x"; w = i " " j " y"; e = (i + 1) " " j " y"
    k = a + 2 * b + 4 * c + 8 * d
    saddle = h[i, j] + h[i + 1, j] + h[i + 1, j + 1] + h[i, j + 1] > 4 * level
    if (k == 1 || (k == 5 && !saddle)) piece(w, s)
    if (k == 2 || (k == 10 && !saddle)) piece(s, e)
    if (k == 4 || (k == 5 && !saddle)) piece(e, n)
    if (k == 8 || (k == 10 && !saddle)) piece(n, w)
    if (k == 14 || (k == 10 && saddle)) piece(s, w)
    if (k == 13 || (k == 5 && saddle)) piece(e, s)
    if (k == 11 || (k == 10 && saddle)) piece(n, e)
    if (k == 7 || (k == 5 && saddle)) piece(w, n)
    if (k == 3) piece(w, e)
    if (k == 6) piece(s, n)
    if (k == 12) piece(e, w)
    if (k == 9) piece(n, s)
}

# Seen along it, the ground is higher on the right, as gdal_contour has it.
function piece(from, to) { next_side[to] = from; entered[from] = 1 }

# The line from SIDE on, to its end or to where it began.
function line(side, level,    first, text, separator) {
    first = side
    separator = form == "gmt" ? "\n" : ","
    for (text = ""; ; side = to) {
        text = text (text == "" ? "" : separator) place(side, level)
        if (!(side in next_side)) break
        to = next_side[side]
        delete next_side[side]
        if (to == first) { text = text separator place(to, level); break }
    }
    if (form == "gmt") print ">\n# @D" level "\n" text
    else feature(level, "LineString", "[" text "]")
}

function feature(height, type, coordinates) {
    printf "%s{\"type\":\"Feature\",\"properties\":{\"elev\":%s},\"geometry\":{\"type\":\"%s\",\"coordinates\":%s}}",
        comma, height, type, coordinates
    comma = ",\n"
}

# A point at every corner of the grid that is higher, or lower, than all around it.
function spots(    i, j, x, y, higher, lower) {
    for (j = 1; j < rows; j++)
        for (i = 1; i < columns; i++) {
            higher = lower = 0
            for (y = j - 1; y <= j + 1; y++)
                for (x = i - 1; x <= i + 1; x++) {
                    higher += h[x, y] > h[i, j]
                    lower += h[x, y] < h[i, j]
                }
            if (!higher || !lower) feature(sprintf("%.1f", h[i, j]), "Point", point(i, j))
        }
}

# Where the level cuts a side.
function place(side, level,    part, x, y, t, p, q) {
    split(side, part, " ")
    x = part[1]; y = part[2]
    p = h[x, y]; q = part[3] == "x" ? h[x + 1, y] : h[x, y + 1]
    t = (level - p) / (q - p)
    if (part[3] == "x") x += t
    else y += t
    return point(x, y)
}

function point(x, y) {
    return sprintf(form == "gmt" ? "%.6f %.6f" : "[%.6f,%.6f]", west + step * x, south + 0.6 * step * y)
}
