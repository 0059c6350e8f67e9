# rt-dump.sh - structure sets as the text of dcmdump +L, made by hand; sourced.
#
#     dump_begin; roi 1 Lung '255\0\0' ORGAN; square 0 10; square 3 10; dump_end >set.txt

dump_begin() {
    : >rt.names
    : >rt.contours
    : >rt.types
    roi_open=
}

item='(fffe,e000) na (Item with undefined length #=4)         # u/l, 1 Item'
item_end='(fffe,e00d) na (ItemDelimitationItem)                   #   0, 0 ItemDelimitationItem'
sequence_end='(fffe,e0dd) na (SequenceDelimitationItem)               #   0, 0 SequenceDelimitationItem'

roi_close() {
    [ -z "$roi_open" ] || printf '%s\n(3006,0084) IS [%s]  #   2, 1 ReferencedROINumber\n%s\n' "$sequence_end" "$roi_open" "$item_end" >>rt.contours
    roi_open=
}

# The ROI alone, without an item for its contours.
roi_named() { # NUMBER NAME [TYPE]
    roi_close
    printf '%s\n(3006,0022) IS [%s]  #   2, 1 ROINumber\n(3006,0026) LO [%s]  #   2, 1 ROIName\n(3006,0036) CS [MANUAL]  #   6, 1 ROIGenerationAlgorithm\n%s\n' \
        "$item" "$1" "$2" "$item_end" >>rt.names
    [ -z "${3-}" ] || printf '%s\n(3006,0084) IS [%s]  #   2, 1 ReferencedROINumber\n(3006,00a4) CS [%s]  #   2, 1 RTROIInterpretedType\n%s\n' \
        "$item" "$1" "$3" "$item_end" >>rt.types
}

roi() { # NUMBER NAME [COLOUR [TYPE]]
    roi_named "$1" "$2" "${4-}"
    printf '%s\n' "$item" >>rt.contours
    [ -z "${3-}" ] || printf '(3006,002a) IS [%s]  #   2, 3 ROIDisplayColor\n' "$3" >>rt.contours
    printf '(3006,0040) SQ (Sequence with undefined length #=1)     # u/l, 1 ContourSequence\n' >>rt.contours
    roi_open=$1
}

contour() { # X\Y\Z\... [TYPE]
    printf '%s\n' "$1" | awk -v kind="${2-CLOSED_PLANAR}" -v item="$item" -v end="$item_end" -F'\\' '{
        print item "\n(3006,0042) CS [" kind "]  #   2, 1 ContourGeometricType"
        print "(3006,0046) IS [" int(NF / 3) "]  #   2, 1 NumberOfContourPoints"
        print "(3006,0050) DS [" $0 "]  #   2, " NF " ContourData\n" end }' >>rt.contours
}

square() { # Z SIDE [X [Y]]: its corner at X, Y; axial
    contour "$(awk -v z="$1" -v s="$2" -v x="${3-0}" -v y="${4-0}" 'BEGIN {
        print x "\\" y "\\" z "\\" x + s "\\" y "\\" z "\\" x + s "\\" y + s "\\" z "\\" x "\\" y + s "\\" z }')"
}

dump_end() {
    roi_close
    printf '# Dicom-Data-Set\n# Used TransferSyntax: Little Endian Explicit\n(0008,0005) CS [ISO_IR 192]  #  10, 1 SpecificCharacterSet\n(0008,0060) CS [RTSTRUCT]  #   8, 1 Modality\n'
    printf '(3006,0020) SQ (Sequence with undefined length #=1)     # u/l, 1 StructureSetROISequence\n'
    cat rt.names
    printf '%s\n(3006,0039) SQ (Sequence with undefined length #=1)     # u/l, 1 ROIContourSequence\n' "$sequence_end"
    cat rt.contours
    printf '%s\n(3006,0080) SQ (Sequence with undefined length #=1)     # u/l, 1 RTROIObservationsSequence\n' "$sequence_end"
    cat rt.types
    printf '%s\n' "$sequence_end"
}
