# maps-forms.sh - the same isolines in every text format of maps, made by hand; sourced.
#
#     relief metres | map_as geojson >map.geojson
#
# Between the two stands a line an isoline: its height and its points, H X,Y X,Y ...; with
# a single point it is a spot height, for forms that have points by themselves.
# Coordinates have few decimals, so that every format says the same numbers.

# A hill with two tops, a pit, and slopes that the frame cuts: closed lines and open ones,
# two of a level next to one another.  UNIT: metres or degrees.
relief() {
    awk -v unit="$1" '
    function decimals(text) { sub(/\.?0+$/, "", text); return text }
    function point(x, y) {
        if (unit == "degrees")
            return " " decimals(sprintf("%.7f", 7.1 + x / 72000)) "," decimals(sprintf("%.7f", 50.2 + y / 111000))
        return " " decimals(sprintf("%.3f", 431000 + x)) "," decimals(sprintf("%.3f", 5561000 + y))
    }
    function closed(h, x, y, r, n,    k, t, text, first) {
        for (k = 0; k < n; k++) {
            t = 6.283185307179586 * k / n
            text = text point(x + r * (1 + 0.1 * sin(3 * t + h)) * cos(t), y + r * (1 + 0.1 * cos(2 * t)) * sin(t))
            if (k == 0)
                first = text
        }
        print h text first
    }
    function across(h, y,    k, text) {
        for (k = 0; k <= 20; k++)
            text = text point(100 * k, y + 30 * sin(k / 3 + h))
        print h text
    }
    BEGIN {
        across(100, 150)
        across(90, 50)
        across(100, 1880)
        across(90, 1960)
        for (h = 110; h <= 140; h += 10)
            closed(h, 1000, 1000, 600 - 10 * (h - 100), 24 + h / 10)
        closed(150, 900, 1000, 90, 12)
        closed(150, 1140, 1000, 80, 11)
        closed(100, 300, 1700, 100, 9)
    }'
}

# Spot heights in that relief, one of them on a vertex.
summits() {
    awk -v unit="$1" 'BEGIN {
        if (unit == "degrees")
            print "154.5 7.1125,50.208\n96 7.1000001,50.2\n140.25 7.115,50.2095\n151.5 7.1158,50.209"
        else
            print "154.5 431900,5561000\n96 431000.5,5561000.125\n140.25 432000,5562000\n151.5 432140,5562000"
    }'
}

# Isolines on standard input as a map of that FORM.  UNIT: of what coordinates are.
map_as() { # FORM UNIT
    awk -v form="$1" -v unit="$2" '
    function split_points(text,    k, part) { # x[1..n], y[1..n]
        n = split(text, part, " ")
        for (k = 1; k <= n; k++) {
            split(part[k], pair, ",")
            x[k] = pair[1]
            y[k] = pair[2]
        }
    }
    # All points: BEFORE x BETWEEN y BEHIND, with JOINER between two of them.
    function points(before, between, behind, joiner,    k, text) {
        for (k = 1; k <= n; k++)
            text = text (k > 1 ? joiner : "") before x[k] between y[k] behind
        return text
    }
    function comma(number) { sub(/\./, ",", number); return number }
    function is_closed() { return n > 2 && x[1] == x[n] && y[1] == y[n] }
    function feature(height, z) {
        return "{\"type\":\"Feature\",\"properties\":{" height "},\"geometry\":{\"type\":" \
            (n > 1 ? "\"LineString\",\"coordinates\":[" points("[", ",", z "]", ",") "]" : \
                     "\"Point\",\"coordinates\":" points("[", ",", z "]", ",")) "}}"
    }
    function group(code, value) { return code "\n" value "\n" }
    function polyline(h,    k, text) {
        text = group(0, "POLYLINE") group(8, "CONTOURS") group(66, 1) group(70, 8) group(10, "0.0") group(20, "0.0") group(30, "0.0")
        for (k = 1; k <= n; k++)
            text = text group(0, "VERTEX") group(8, "CONTOURS") group(10, x[k]) group(20, y[k]) group(30, h ".0") group(70, 32)
        return text group(0, "SEQEND")
    }
    function rows(h, separator, decimal,    k) {
        for (k = 1; k <= n; k++)
            print NR separator (decimal ? comma(x[k]) : x[k]) separator (decimal ? comma(y[k]) : y[k]) separator h
    }
    BEGIN {
        xy = unit == "degrees" ? "lon lat" : "x y"
        if (form == "geojson" || form == "geojson-z")
            printf "{\"type\":\"FeatureCollection\",\"features\":["
        else if (form == "gmt-ogr")
            print "# @VGMT1.0 @GLINESTRING\n# @Nid|elev\n# @Tinteger|double\n# FEATURE_DATA"
        else if (form == "csv-wkt")
            print "WKT,id,elev"
        else if (form == "csv-xyz") {
            sub(/ /, ",", xy)
            print "id," xy ",z"
        } else if (form == "csv-comma") {
            sub(/ /, ";", xy)
            print "id;" xy ";z"
        } else if (form ~ /^dxf/)
            printf "%s", group(0, "SECTION") group(2, "ENTITIES")
        else if (form ~ /^kml/)
            print "<kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document>"
        else if (form ~ /^gpx/)
            print "<gpx version=\"1.1\" creator=\"hand\" xmlns=\"http://www.topografix.com/GPX/1/1\">"
    }
    {
        h = $1
        sub(/^[^ ]* /, "")
        split_points($0)
    }
    form == "loft" && n == 1 {
        spots = spots points("spot ", " ", " " h "\n", "")
        next
    }
    form == "loft" {
        if (!(h in lines))
            height[++n_heights] = h
        n -= is_closed() ? 1 : 0
        lines[h] = lines[h] (n < split($0, pair, " ") ? "ring\n" : "line\n") points("", " ", "\n", "")
    }
    form == "geojson" { printf "%s\n%s", (NR > 1 ? "," : ""), feature("\"id\":" NR ",\"elev\":" h, "") }
    form == "geojson-z" { printf "%s\n%s", (NR > 1 ? "," : ""), feature("", "," h) }
    form == "geojsonseq" { print feature("\"id\":" NR ",\"elev\":" h, "") }
    form == "geojsonseq-rs" { printf "\036%s\n", feature("\"id\":" NR ",\"elev\":" h, "") }
    form == "gmt" { printf "> -Z%s\n%s", h, points("", " ", "\n", "") }
    form == "gmt-z" { printf ">\n%s", points("", "\t", "\t" h "\n", "") }
    form == "gmt-ogr" { printf ">\n# @D%d|%s\n%s", NR, h, points("", " ", "\n", "") }
    form == "csv-wkt" { print "\"" (n > 1 ? "LINESTRING (" : "POINT (") points("", " ", "", ",") ")\"," NR "," h }
    form == "csv-xyz" { rows(h, ",", 0) }
    form == "csv-comma" { rows(h, ";", 1) }
    form == "bln" { printf "%d,1,\"%s\"\n%s", n, h, points("", ",", "\n", "") }
    form == "bln-z" { printf "%d,1\n%s", n, points("", ",", "," h "\n", "") }
    form ~ /^dxf/ && n == 1 {
        printf "%s%s", group(0, "POINT") group(8, "SUMMITS"), points("10\n", "\n20\n", "\n30\n" h "\n", "")
        next
    }
    form == "dxf" {
        printf "%s%s", group(0, "LWPOLYLINE") group(8, "CONTOURS") group(90, n) group(70, 0) group(38, h ".0"),
            points("10\n", "\n20\n", "\n", "")
    }
    form == "dxf-polyline" { printf "%s", polyline(h) }
    form == "kml" {
        print "<Placemark><name>line " NR "</name><ExtendedData><Data name=\"elev\"><value>" h "</value></Data></ExtendedData>"
        element = n > 1 ? "LineString" : "Point"
        print "<" element "><coordinates>" points("", ",", "", " ") "</coordinates></" element "></Placemark>"
    }
    form == "kml-z" {
        element = n > 1 ? "LineString" : "Point"
        print "<Placemark><" element "><coordinates>\n" points("", ",", "," h, "\n") "</coordinates></" element "></Placemark>"
    }
    form ~ /^gpx/ && n == 1 {
        print "<wpt lat=\"" y[1] "\" lon=\"" x[1] "\"><ele>" h "</ele></wpt>"
        next
    }
    form == "gpx" {
        print "<trk><name>" h " m</name><trkseg>"
        for (k = 1; k <= n; k++)
            print "<trkpt lat=\"" y[k] "\" lon=\"" x[k] "\"/>"
        print "</trkseg></trk>"
    }
    form == "gpx-z" {
        print "<rte>"
        for (k = 1; k <= n; k++)
            print "<rtept lat=\"" y[k] "\" lon=\"" x[k] "\"><ele>" h "</ele></rtept>"
        print "</rte>"
    }
    END {
        if (form == "loft") {
            printf "isoloft 1\nunit %s\nstack \"\"\nkind terrain\n%s", unit == "degrees" ? "deg" : "m", spots
            for (; n_heights > 0; n_heights--) {
                least = 1
                for (k = 2; k <= n_heights; k++)
                    if (height[k] + 0 < height[least] + 0)
                        least = k
                printf "slice %s\n%s", height[least], lines[height[least]]
                height[least] = height[n_heights]
            }
            print "end"
        } else if (form == "geojson" || form == "geojson-z")
            print "\n]}"
        else if (form ~ /^dxf/)
            printf "%s", group(0, "ENDSEC") group(0, "EOF")
        else if (form ~ /^kml/)
            print "</Document></kml>"
        else if (form ~ /^gpx/)
            print "</gpx>"
    }'
}

# FORM, the reader that takes it, and in what coordinates can be.
map_forms="
geojson       geojson    metres degrees
geojson-z     geojson    metres degrees
geojsonseq    geojsonseq metres degrees
geojsonseq-rs geojsonseq metres degrees
gmt           gmt        metres degrees
gmt-z         gmt        metres degrees
gmt-ogr       gmt        metres degrees
csv-wkt       csv        metres degrees
csv-xyz       csv        metres degrees
csv-comma     csv        metres degrees
bln           bln        metres degrees
bln-z         bln        metres degrees
dxf           dxf        metres degrees
dxf-polyline  dxf        metres degrees
kml           kml        degrees
kml-z         kml        degrees
gpx           gpx        degrees
gpx-z         gpx        degrees"

# Does this isoloft read the format NAME?
is_read() { "$ISOLOFT" --formats | grep -q "^-f $1 "; }
