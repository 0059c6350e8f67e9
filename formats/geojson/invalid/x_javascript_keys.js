var lines = { type: "FeatureCollection", features: [ ] };
