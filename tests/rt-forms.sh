# rt-forms.sh - one structure set in all of its forms, made by hand; sourced.
#
#     small_set | set_as json >set.json

forms="dcmdump json xml"

# `roi NUMBER NAME` and `contour X\Y\Z\...` on standard input, a line each.
set_as() { # FORM
    awk -v form="$1" '
    BEGIN {
        item["dcmdump"] = "(fffe,e000) na (Item with undefined length #=1)  # u/l, 1 Item\n"
        item_end["dcmdump"] = "(fffe,e00d) na (ItemDelimitationItem)  # 0, 0 ItemDelimitationItem\n"
        item["json"] = "{"
        item_end["json"] = "}"
        item["xml"] = "<Item number=\"1\">\n"
        item_end["xml"] = "</Item>\n"
    }
    function quoted(value,    k, n, part, text) { # the values of one element
        n = split(value, part, "\\")
        for (k = 1; k <= n; k++)
            text = text (form == "xml" ? "<Value number=\"" k "\">" part[k] "</Value>\n" : (k > 1 ? "," : "") "\"" part[k] "\"")
        return text
    }
    function element(tag, vr, value,    part) {
        if (form == "dcmdump")
            return "(" substr(tag, 1, 4) "," substr(tag, 5) ") " vr " [" value "]  # 2, " split(value, part, "\\") " Name\n"
        if (form == "json")
            return "\"" toupper(tag) "\":{\"vr\":\"" vr "\",\"Value\":[" quoted(value) "]}"
        return "<DicomAttribute tag=\"" toupper(tag) "\" vr=\"" vr "\">" quoted(value) "</DicomAttribute>\n"
    }
    function sequence(tag, items) {
        if (form == "dcmdump")
            return "(" substr(tag, 1, 4) "," substr(tag, 5) ") SQ (Sequence with undefined length #=1)  # u/l, 1 Name\n" items \
                "(fffe,e0dd) na (SequenceDelimitationItem)  # 0, 0 SequenceDelimitationItem\n"
        if (form == "json")
            return "\"" toupper(tag) "\":{\"vr\":\"SQ\",\"Value\":[" items "]}"
        return "<DicomAttribute tag=\"" toupper(tag) "\" vr=\"SQ\">\n" items "</DicomAttribute>\n"
    }
    function joined(a, b) { return a (a != "" && form == "json" ? "," : "") b }
    function in_item(elements) { return item[form] elements item_end[form] }
    function finish() {
        if (number != "")
            rings = joined(rings, in_item(joined(sequence("30060040", contours), element("30060084", "IS", number))))
        contours = ""
    }
    /^roi / {
        finish()
        number = $2
        sub(/^roi [^ ]* /, "")
        names = joined(names, in_item(joined(element("30060022", "IS", number), element("30060026", "LO", $0))))
        types = joined(types, in_item(joined(element("30060084", "IS", number), element("300600a4", "CS", "ORGAN"))))
    }
    /^contour / {
        sub(/^contour /, "")
        contours = joined(contours, in_item(joined(element("30060042", "CS", "CLOSED_PLANAR"), element("30060050", "DS", $0))))
    }
    END {
        finish()
        all = joined(joined(element("00080060", "CS", "RTSTRUCT"), sequence("30060020", names)),
            joined(sequence("30060039", rings), sequence("30060080", types)))
        if (form == "dcmdump")
            printf "# Dicom-Data-Set\n# Used TransferSyntax: Little Endian Explicit\n%s", all
        else if (form == "json")
            printf "{%s}\n", all
        else
            printf "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<NativeDicomModel>\n%s</NativeDicomModel>\n", all
    }'
}

# A keyhole, a gap, and a slice that stands alone.
small_set() {
    awk 'function ring(z, points,    n, p, k, text) {
            n = split(points, p, " ")
            for (k = 1; k < n; k += 2) text = text (k > 1 ? "\\" : "") p[k] "\\" p[k + 1] "\\" z
            print "contour " text
        }
        BEGIN {
            print "roi 1 keyhole"
            for (z = 0; z < 6; z += 3) ring(z, "0 0 3 0 3 3 3 6 6 6 6 3 3.03 3 3.03 0 9 0 9 9 0 9")
            print "roi 2 gap"
            for (z = 0; z < 6; z += 3) ring(z, "20 0 29 0 25 9")
            for (z = 30; z < 36; z += 3) ring(z, "20 0 29 0 25 9")
            print "roi 3 alone"
            ring(3, "40 0 49 0 45 9")
        }'
}
