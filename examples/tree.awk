# tree.awk - slices of a vessel tree, as a native stream:
#     awk -f tree.awk > tree.loft
#
# A trunk divides twice.  One branch ends half way up, and one runs so far sideways
# that its outlines do not overlap from slice to slice.
#
# A branch goes from one place to another along a smooth step, which is steepest
# half way, and so does its radius.  A plane cuts a round tube that leans by the slope
# s in an ellipse, longer by sqrt(1 + s^2) the way it leans.  Where two such ellipses
# overlap they are one outline: seen from a point in both, the farther one, rounded.

BEGIN {
    pi = atan2(0, -1)
    print "isoloft 1\nunit mm\nstack \"tree\""
    for (z = 0; z <= 66; z += 3)
        slice(z)
    print "end"
}

function slice(z) {
    n = 0
    tube(z,  0, 18, -20,  0, -20,  0, 4.2, 3.6) # the trunk
    tube(z, 18, 33, -20,  0, -31,  3, 3.6, 2.8) # divides,
    tube(z, 33, 54, -31,  3, -17, 11, 2.8, 1.6) # and again: this one ends
    tube(z, 33, 69, -31,  3, -44,  4, 2.8, 1.8)
    tube(z, 18, 30, -20,  0,  -9, -6, 3.6, 1.5)
    tube(z, 30, 48,  -9, -6,  48, -9, 1.5, 0.9) # sideways
    tube(z, 48, 69,  48, -9,  45, -2, 0.9, 1.2)
    print "slice " z
    for (i = 0; i < n; i++)
        if (n > i + 1 && meet(i, i + 1)) {
            outline(i, i + 1)
            i++
        } else
            outline(i, i)
}

# How far along from z0 to z1, and how steep there.
function step(u) { return u * u * (3 - 2 * u) }
function slope(u) { return 6 * u * (1 - u) }

# Ellipse n: centre, half axes, the direction of the longer one.
function tube(z, z0, z1, x0, y0, x1, y1, r0, r1,    u, dx, dy, lean) {
    if (z < z0 || z >= z1)
        return
    u = (z - z0) / (z1 - z0)
    dx = (x1 - x0) * slope(u) / (z1 - z0)
    dy = (y1 - y0) * slope(u) / (z1 - z0)
    lean = sqrt(dx * dx + dy * dy)
    cx[n] = x0 + (x1 - x0) * step(u)
    cy[n] = y0 + (y1 - y0) * step(u)
    narrow[n] = r0 + (r1 - r0) * step(u)
    long[n] = narrow[n] * sqrt(1 + lean * lean)
    ux[n] = lean > 0 ? dx / lean : 1
    uy[n] = lean > 0 ? dy / lean : 0
    n++
}

# How far from (x, y) outline k lies in direction (dx, dy); 0 when the point is not inside.
function reach(k, x, y, dx, dy,    p, q, a, b, c, d) {
    p = ((x - cx[k]) * ux[k] + (y - cy[k]) * uy[k]) / long[k]
    q = ((y - cy[k]) * ux[k] - (x - cx[k]) * uy[k]) / narrow[k]
    a = (dx * ux[k] + dy * uy[k]) / long[k]
    b = (dy * ux[k] - dx * uy[k]) / narrow[k]
    c = p * p + q * q - 1
    if (c >= 0)
        return 0
    d = p * a + q * b
    return (sqrt(d * d - (a * a + b * b) * c) - d) / (a * a + b * b)
}

# Do ellipses j and k overlap?  Then (mx, my) is half way between where each ends on the line
# through both centres.
function meet(j, k,    x, y, d, s) {
    x = cx[k] - cx[j]
    y = cy[k] - cy[j]
    d = sqrt(x * x + y * y)
    if (d == 0)
        d = x = 1
    s = (reach(j, cx[j], cy[j], x / d, y / d) + sqrt((cx[k] - cx[j]) ^ 2 + (cy[k] - cy[j]) ^ 2) - reach(k, cx[k], cy[k], -x / d, -y / d)) / 2
    mx = cx[j] + s * x / d
    my = cy[j] + s * y / d
    return reach(j, mx, my, 1, 0) > 0.3 && reach(k, mx, my, 1, 0) > 0.3
}

# Counter-clockwise around one ellipse, or around two that meet.
function outline(j, k,    i, points, x, y, t, f, g) {
    points = j == k ? 36 : 60
    print "ring"
    for (i = 0; i < points; i++) {
        t = 2 * pi * i / points
        if (j == k) {
            x = long[j] * cos(t)
            y = narrow[j] * sin(t)
            printf "%.3f %.3f\n", cx[j] + x * ux[j] - y * uy[j], cy[j] + x * uy[j] + y * ux[j]
        } else {
            f = reach(j, mx, my, cos(t), sin(t))
            g = reach(k, mx, my, cos(t), sin(t))
            f = exp(log(f ^ 10 + g ^ 10) / 10)
            printf "%.3f %.3f\n", mx + f * cos(t), my + f * sin(t)
        }
    }
}
