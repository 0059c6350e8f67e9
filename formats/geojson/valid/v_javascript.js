var contours = { "type": "FeatureCollection", "features": [
{ "type": "Feature", "properties": { "elev": 10 },
  "geometry": { "type": "LineString", "coordinates": [[0, 0], [900, 0], [900, 900], [0, 0]] } },
{ "type": "Feature", "properties": { "elev": 20 },
  "geometry": { "type": "LineString", "coordinates": [[300, 100], [800, 100], [800, 600], [300, 100]] } }
] };
