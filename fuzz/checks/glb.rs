//! Models of strangers: any bytes are a surface within limits or an error, and what is a surface an asset or an error.

use simworld_agents::assets::{GlbLimits, ImportConfig, Moment, Thing, import_glb, read_glb, read_glb_at};

pub(crate) fn check(data: &[u8]) {
    let limits =
        GlbLimits { triangles: 400, vertices: 1200, nodes: 100, pixels: 1 << 12, ..GlbLimits::default() };
    if let Ok(posed) = read_glb_at(data, &limits, Some(Moment { animation: 0, seconds: 1.0 })) {
        assert!(posed.points.iter().all(|point| point.iter().all(|number| number.is_finite())));
    }
    let Ok(surface) = read_glb(data, &limits) else { return };
    assert!(!surface.triangles.is_empty() && surface.triangles.len() <= 400);
    assert!(surface.points.iter().all(|point| point.iter().all(|number| number.is_finite())));
    assert!(surface.places.iter().flatten().all(|part| part.is_finite()));
    assert!(surface.images.iter().all(|image| image.is_whole() && image.pixels.len() <= 3 << 12));
    let config = ImportConfig { limits, voxels: 16, hulls: 4, tangled: 1.0, ..ImportConfig::default() };
    let thing = Thing { name: "thing".into(), words: "crate".into(), ..Thing::default() };
    if let Ok(imported) = import_glb(data, &thing, &config) {
        imported.asset.validate().expect("what is imported is an asset");
    }
}
