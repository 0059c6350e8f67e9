# vase.awk - slices of a vase on three twisted legs, as SVG or as a native stream:
#     awk -v form=svg  -f vase.awk > vase.svg
#     awk -v form=loft -f vase.awk > vase.loft
#
# Every outline is a level line of |w^3 - 1| = s^3 in the complex plane (a
# lemniscate with three foci), scaled to the radius r and turned with the height:
#     w(t) = r ((1 + s^3 e^it) / (1 + s^3))^(1/3)
# Below s = 1 it falls apart into three ovals, above it is one curve with three
# lobes; so the foot parts into legs, the legs join in the body, and the hollow
# of the body, which is of the same family, begins as three pits.

BEGIN {
    pi = atan2(0, -1)
    slices = 33
    height = 64
    if (form == "svg") {
        print "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"60mm\" height=\"60mm\" viewBox=\"-30 -30 60 60\">"
        print "<title>vase</title>"
    } else
        print "isoloft 1\nunit mm\nstack \"vase\""
    for (k = 0; k < slices; k++)
        slice(height * k / (slices - 1))
    print form == "svg" ? "</svg>" : "end"
}

# A smooth step from 0 at A to 1 at B, and a bump of width W around C.
function step(x, a, b) { x = (x - a) / (b - a); x = x < 0 ? 0 : x > 1 ? 1 : x; return x * x * (3 - 2 * x) }
function bump(x, c, w) { return exp(-(x - c) * (x - c) / (w * w)) }

function slice(z,    r, s, q) {
    r = 15 + 5 * bump(z, 0, 9) + 6.5 * bump(z, 43, 12) + 4 * bump(z, 66, 6)
    s = 0.80 + 0.62 * bump(z, 0, 6) + 0.9 * step(z, 20, 44)
    turn = 2 * pi / 3 * z / height
    if (form == "svg")
        printf "<g data-z=\"%g\">\n", z
    else
        printf "slice %g\n", z
    outline(r, s, 1)
    if (z > 31) {
        q = 0.72 + 0.80 * step(z, 30, 45)
        outline(r - 2.6, q, -1)
    }
    if (form == "svg")
        print "</g>"
}

# Counter-clockwise, or clockwise when WAY is -1: the hollow.  One ring of three
# lobes, or three rings.
function outline(r, s, way,    lobe, n, k) {
    n = 40
    for (lobe = 0; lobe < 3; lobe++) {
        if (s < 1 || lobe == 0)
            ring()
        for (k = 0; k < n; k++)
            if (way > 0)
                vertex(r, s, k / n, lobe)
            else
                vertex(r, s, (n - 1 - k) / n, s < 1 ? lobe : 2 - lobe)
        if (s < 1 || lobe == 2)
            close_ring()
    }
}

# u, from 0 to 1, runs once round in t, slower where the curve turns sharply.
function vertex(r, s, u, lobe,    t, c, re, im, rho, phi) {
    c = s * s * s
    t = 2 * pi * u - (s < 1.25 && s > 0.8 ? 0.55 : 0.3) * sin(2 * pi * u) * (-1)
    re = 1 + c * cos(t)
    im = c * sin(t)
    phi = atan2(im, re)
    if (s > 1 && phi < 0)
        phi += 2 * pi # unwrapped: one turn of t is a third of the way round
    rho = r * exp(log((re * re + im * im) / ((1 + c) * (1 + c))) / 6)
    phi = phi / 3 + 2 * pi * lobe / 3 + turn
    point(rho * cos(phi), rho * sin(phi))
}

# SVG's y points down.
function ring() { printf form == "svg" ? "<polygon points=\"" : "ring\n" }
function point(x, y) { printf form == "svg" ? "%.3f,%.3f " : "%.3f %.3f\n", x, form == "svg" ? -y : y }
function close_ring() { printf form == "svg" ? "\"/>\n" : "" }
