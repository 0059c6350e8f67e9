# phantom.awk - a small DICOM-RT structure set in each of its text forms:
#     awk -v form=dcmdump -f phantom.awk > phantom.dcmdump.txt    as dcmdump +L writes it
#     awk -v form=json    -f phantom.awk > phantom.json           DICOM JSON
#     awk -v form=xml     -f phantom.awk > phantom.xml            native DICOM model
#
# Five regions of interest, each with something that structure sets do:
#   1 Vessel    a trunk that parts in two: Cassini ovals, |w^2 - 1| = s^2 in the
#               complex plane, which fall apart where s goes below 1
#   2 Hollow    an ellipsoid with a cavity, drawn in the outline's direction in every
#               second slice, for the direction says nothing
#   3 Tube      a hole drawn as a keyhole: round the outline, in along a channel, round
#               the hole, out again; in every second slice the sides are 0.03 mm apart
#   4 Cord      four slices are missing in the middle
#   5 Empty     a name and a colour, and no contours

BEGIN {
    pi = atan2(0, -1)
    depth = 0
    begin_file()
    element("0008", "0005", "CS", "SpecificCharacterSet", "ISO_IR 192")
    element("0008", "0016", "UI", "SOPClassUID", "1.2.840.10008.5.1.4.1.1.481.3")
    element("0008", "0060", "CS", "Modality", "RTSTRUCT")
    element("3006", "0002", "SH", "StructureSetLabel", "Phantom")
    rois = split("Vessel Hollow Tube Cord Empty", name, " ")
    split("220\\40\\40 240\\200\\80 60\\160\\220 250\\250\\120 128\\128\\128", color, " ")
    split("ORGAN ORGAN ORGAN AVOIDANCE CONTROL", type, " ")
    put_names()
    put_contours()
    put_observations()
    end_file()
}

# ---- shapes: points go to x[0..n), y[0..n) ------------------------------------------

function step(t, a, b) { t = (t - a) / (b - a); t = t < 0 ? 0 : t > 1 ? 1 : t; return t * t * (3 - 2 * t) }
function point(px, py) { x[n] = px; y[n++] = py }

# One or both ovals of c sqrt(1 + s^2 e^it), turned by TURN about (CX, CY).
function vessel(k,    u, s, c, turn, cx, cy, branch, i, steps) {
    u = k / 16
    s = 2.25 - 1.55 * step(u, 0.1, 0.75)
    c = 3 + 9 * step(u, 0.15, 1)
    turn = 0.7 * u
    cx = -40 + 9 * u
    cy = 6 * u * u
    steps = s > 1 ? 28 : 14
    for (branch = 0; branch < (s > 1 ? 1 : 2); branch++) {
        n = 0
        for (i = 0; i < steps; i++)
            oval_point(cx, cy, c, s, (s > 1 ? 4 : 2) * pi * i / steps, turn + branch * pi)
        put_contour(-30 + 3 * k)
    }
}

# The root of 1 + s^2 e^it that goes on smoothly where t passes 2 pi.
function oval_point(cx, cy, c, s, t, turn,    re, im, r, a) {
    re = 1 + s * s * cos(t)
    im = s * s * sin(t)
    r = c * sqrt(sqrt(re * re + im * im))
    a = atan2(im, re) / 2
    if (s > 1 && t > pi && t <= 3 * pi)
        a += pi
    point(cx + r * cos(a + turn), cy + r * sin(a + turn))
}

function ellipse(cx, cy, rx, ry, steps, from, direction,    i) {
    for (i = 0; i < steps; i++)
        point(cx + rx * cos(from + direction * 2 * pi * i / steps), cy + ry * sin(from + direction * 2 * pi * i / steps))
}

function hollow(k,    f, h) {
    f = sqrt(1 - (k - 5) * (k - 5) / 31)
    n = 0
    ellipse(32, 0, 18 * f, 14 * f, 20, 0, 1)
    put_contour(-24 + 3 * k)
    if (k < 3 || k > 7)
        return
    h = sqrt(1 - (k - 5) * (k - 5) / 6)
    n = 0
    ellipse(33, 1, 9 * h, 7 * h, 12, 0.3, k % 2 ? -1 : 1)
    put_contour(-24 + 3 * k)
}

# The way in lies AHEAD of the way out, measured along the outline.
function tube(k,    phi, ahead) {
    phi = pi / 4 + 0.35 * k
    ahead = k % 2 ? 0.03 : 0
    n = 0
    ellipse(0, -45, 12, 12, 18, phi, 1)
    point(12 * cos(phi) + ahead * sin(phi), -45 + 12 * sin(phi) - ahead * cos(phi))
    point(6 * cos(phi) + ahead * sin(phi), -45 + 6 * sin(phi) - ahead * cos(phi))
    ellipse(0, -45, 6, 6, 12, phi - pi / 6, -1)
    put_contour(-15 + 3 * k)
}

function cord(k) {
    n = 0
    ellipse(0.4 * k, 40, 8, 6 - 0.1 * k, 12, 0.1, 1)
    put_contour(-20 + 3 * k)
}

function put_shapes(roi,    k) {
    for (k = 0; roi == 1 && k <= 16; k++) vessel(k)
    for (k = 0; roi == 2 && k <= 10; k++) hollow(k)
    for (k = 0; roi == 3 && k <= 6; k++) tube(k)
    for (k = 0; roi == 4 && k <= 11; k++) if (k < 4 || k > 7) cord(k)
}

# ---- the structure set --------------------------------------------------------------

function put_names(    r) {
    begin_sequence("3006", "0020", "StructureSetROISequence")
    for (r = 1; r <= rois; r++) {
        begin_item()
        element("3006", "0022", "IS", "ROINumber", r)
        element("3006", "0024", "UI", "ReferencedFrameOfReferenceUID", "2.25.271828182845904523536")
        element("3006", "0026", "LO", "ROIName", name[r])
        element("3006", "0036", "CS", "ROIGenerationAlgorithm", "AUTOMATIC")
        end_item()
    }
    end_sequence()
}

function put_contours(    r) {
    begin_sequence("3006", "0039", "ROIContourSequence")
    for (r = 1; r <= rois; r++) {
        begin_item()
        element("3006", "002a", "IS", "ROIDisplayColor", color[r])
        if (name[r] != "Empty") {
            begin_sequence("3006", "0040", "ContourSequence")
            put_shapes(r)
            end_sequence()
        }
        element("3006", "0084", "IS", "ReferencedROINumber", r)
        end_item()
    }
    end_sequence()
}

function put_contour(z,    i, value) {
    for (i = 0; i < n; i++)
        value = value (i ? "\\" : "") number(x[i]) "\\" number(y[i]) "\\" number(z)
    begin_item()
    element("3006", "0042", "CS", "ContourGeometricType", "CLOSED_PLANAR")
    element("3006", "0046", "IS", "NumberOfContourPoints", n)
    element("3006", "0050", "DS", "ContourData", value)
    end_item()
}

# Two decimals, and no minus before zero.
function number(v,    text) {
    text = sprintf("%.2f", v)
    return text == "-0.00" ? "0.00" : text
}

function put_observations(    r) {
    begin_sequence("3006", "0080", "RTROIObservationsSequence")
    for (r = 1; r <= rois; r++) {
        begin_item()
        element("3006", "0082", "IS", "ObservationNumber", r)
        element("3006", "0084", "IS", "ReferencedROINumber", r)
        element("3006", "00a4", "CS", "RTROIInterpretedType", type[r])
        end_item()
    }
    end_sequence()
}

# ---- the forms ------------------------------------------------------------------------

function begin_file() {
    if (form == "dcmdump")
        print "# Dicom-Data-Set\n# Used TransferSyntax: Little Endian Explicit"
    else if (form == "json")
        printf "{"
    else if (form == "xml")
        print "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<NativeDicomModel xml:space=\"preserve\">"
    else {
        print "phantom.awk: give -v form=dcmdump, json or xml" > "/dev/stderr"
        exit 2
    }
}

function end_file() {
    if (form == "json") print "\n}"
    if (form == "xml") print "</NativeDicomModel>"
}

function indent(    i, blanks) {
    for (i = 0; i < depth; i++)
        blanks = blanks "  "
    return blanks
}

# dcmdump's lines: values stand in 40 columns, bytes are even.
function dump_line(group, tag, vr, shown, bytes, values, keyword) {
    printf "%s(%s,%s) %s %-40s # %3s,%2d %s\n", indent(), group, tag, vr, shown, bytes, values, keyword
}

# JSON's commas: one before all but the first of an object or list.
function json_next() {
    printf "%s\n%s", (filled[depth] ? "," : ""), indent()
    filled[depth] = 1
}

function element(group, tag, vr, keyword, value,    values, i, v, quote) {
    values = split(value, v, "\\")
    if (form == "dcmdump") {
        dump_line(group, tag, vr, "[" value "]", length(value) + length(value) % 2, values, keyword)
    } else if (form == "json") {
        json_next()
        quote = vr == "DS" || vr == "IS" ? "" : "\""
        printf "\"%s%s\":{\"vr\":\"%s\",\"Value\":[", group, toupper(tag), vr
        for (i = 1; i <= values; i++)
            printf "%s%s%s%s", (i > 1 ? "," : ""), quote, v[i], quote
        printf "]}"
    } else {
        printf "<DicomAttribute tag=\"%s%s\" vr=\"%s\" keyword=\"%s\">", group, toupper(tag), vr, keyword
        for (i = 1; i <= values; i++)
            printf "%s<Value number=\"%d\">%s</Value>", (values > 3 && i % 3 == 1 ? "\n" : ""), i, v[i]
        print "</DicomAttribute>"
    }
}

function begin_sequence(group, tag, keyword) {
    if (form == "dcmdump")
        dump_line(group, tag, "SQ", "(Sequence with undefined length)", "u/l", 1, keyword)
    else if (form == "json") {
        json_next()
        printf "\"%s%s\":{\"vr\":\"SQ\",\"Value\":[", group, toupper(tag)
    } else
        printf "<DicomAttribute tag=\"%s%s\" vr=\"SQ\" keyword=\"%s\">\n", group, toupper(tag), keyword
    filled[++depth] = 0
}

function end_sequence() {
    depth--
    if (form == "dcmdump")
        dump_line("fffe", "e0dd", "na", "(SequenceDelimitationItem)", 0, 0, "SequenceDelimitationItem")
    else
        printf "%s", (form == "json" ? "]}" : "</DicomAttribute>\n")
}

function begin_item() {
    if (form == "dcmdump")
        dump_line("fffe", "e000", "na", "(Item with undefined length)", "u/l", 1, "Item")
    else if (form == "json") {
        json_next()
        printf "{"
    } else
        printf "<Item number=\"%d\">\n", ++filled[depth]
    filled[++depth] = 0
}

function end_item() {
    depth--
    if (form == "dcmdump")
        dump_line("fffe", "e00d", "na", "(ItemDelimitationItem)", 0, 0, "ItemDelimitationItem")
    else
        printf "%s", (form == "json" ? "}" : "</Item>\n")
}
