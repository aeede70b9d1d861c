//! What comes back of a beam.

use simworld_core::environment::Weather;
use simworld_core::ops;
use simworld_core::scene::{EntityKind, EntityRef, Scene};

/// Contrast falls to this share over the meteorological visibility: ln of 0.02, negated (Koschmieder 1924).
const KOSCHMIEDER: f64 = 3.912;
/// A surface that reflects this share is just seen at the greatest range, as data sheets say it.
pub(in crate::sensor) const DARK: f64 = 0.1;

/// How much of a beam is lost a metre, 1/m: fog by visibility, and rain by 1.076 R^0.67 dB/km at R mm/h (Carbonneau and Wisely 1998, as in
/// ITU-R P.1814).
pub(super) fn extinction(weather: &Weather) -> f64 {
    let decibel = std::f64::consts::LN_10 / 10.0;
    let rain = 1.076 * ops::pow(weather.rain.max(0.0), 0.67) * 1e-3 * decibel;
    KOSCHMIEDER / weather.visibility + rain
}

/// The intensity of an echo: the reflectance of the surface times the cosine of the angle at which it is met, less what the air takes on
/// both ways. Scanners make up for the square of the range, so it is left out.
pub(super) fn intensity(reflectance: f64, cosine: f64, range: f64, extinction: f64) -> f64 {
    reflectance * cosine * ops::exp(-2.0 * extinction * range)
}

/// Whether an echo of that intensity is strong enough: no weaker than that of a surface that reflects a tenth, met straight, at the greatest
/// range, through clear air.
pub(super) fn is_heard(intensity: f64, range: f64, greatest: f64) -> bool {
    intensity / (range * range) >= DARK / (greatest * greatest)
}

/// The reflectance of an entity: of its material, or what is common for its kind.
pub(super) fn reflectance(scene: &dyn Scene, entity: &EntityRef<'_>) -> f64 {
    let by_kind = match entity.kind {
        EntityKind::Road | EntityKind::Crosswalk => 0.1,
        EntityKind::Sidewalk | EntityKind::Building => 0.3,
        EntityKind::Ground => 0.2,
        EntityKind::Tree | EntityKind::Shrub => 0.18,
        EntityKind::Sign => 0.8,
        kind if kind.is_vehicle() => 0.55,
        _ => 0.35,
    };
    entity.material(scene).map_or(by_kind, simworld_core::asset::Material::reflectance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_air_takes_what_visibility_says() {
        let fog = Weather { visibility: 100.0, rain: 0.0, ..Weather::default() };
        // Over the visibility, one way, 2 % are left.
        let left = intensity(1.0, 1.0, 50.0, extinction(&fog));
        assert!((left - 0.02).abs() < 1e-4, "{left}");
        let rain = Weather { rain: 10.0, ..fog };
        let more = extinction(&rain) - extinction(&fog);
        // 10 mm/h take 5.03 dB/km.
        assert!((more * 1e3 * 10.0 / std::f64::consts::LN_10 - 5.033).abs() < 0.01, "{more}");
        assert!(is_heard(0.1, 99.9, 100.0) && !is_heard(0.1, 100.1, 100.0) && is_heard(0.02, 40.0, 100.0));
    }
}
