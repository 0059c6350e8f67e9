#!/bin/sh
# jacksboro.sh [FOLDER] - a real landscape, the Jacksboro fault in Tennessee, from isolines to a solid to print.
#
# The elevation model is sample data of matplotlib, in the public domain: 403 x 344 heights, in whole metres,
# 3 seconds of arc apart.  GDAL draws isolines of it, every 20 m, and isoloft makes the ground of them again.
# FOLDER, or the one at hand, gets jacksboro.asc (the model), jacksboro.geojson (isolines), jacksboro.ply (the
# surface, in metres of UTM) and jacksboro.stl (a solid, 15 cm long, heights three times as high).
#
# ISOLOFT is the program to run, if not isoloft; DEM the model, if not where Debian has it.
# Exits 77 when a package is missing.

set -eu
folder=${1-.}
isoloft=${ISOLOFT-isoloft}
dem=${DEM-/usr/share/matplotlib/mpl-data/sample_data/jacksboro_fault_dem.npz}
python=/usr/bin/python3 # the one that has Debian's packages

missing=
[ -r "$dem" ] || missing="$missing python-matplotlib-data"
command -v gdal_contour >/dev/null || missing="$missing gdal-bin"
"$python" -c 'import numpy' 2>/dev/null || missing="$missing python3-numpy"
if [ -n "$missing" ]; then
    echo "jacksboro.sh: Debian packages are missing; as root: apt install --no-install-recommends$missing" >&2
    exit 77
fi
command -v "$isoloft" >/dev/null || { echo "jacksboro.sh: no program '$isoloft'; ISOLOFT may name it" >&2; exit 1; }

mkdir -p "$folder"
to=$folder/jacksboro

# The model as an ASCII grid; its rows run from north to south.
"$python" - "$dem" >"$to.asc" <<'END'
import sys
import numpy
dem = numpy.load(sys.argv[1])
rows, columns = dem["elevation"].shape
print("ncols", columns, "\nnrows", rows)
print("xllcorner", dem["xmin"], "\nyllcorner", min(dem["ymin"], dem["ymax"]), "\ncellsize", dem["dx"])
numpy.savetxt(sys.stdout, dem["elevation"], "%d")
END

rm -f "$to.geojson" # which gdal_contour would not replace
gdal_contour -q -a elev -i 20 -f GeoJSON "$to.asc" "$to.geojson"
"$isoloft" "$to.geojson" -o "$to.ply"
"$isoloft" "$to.geojson" --solid --fit 150mm --z-scale 3 -o "$to.stl"
