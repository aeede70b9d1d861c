//! Unreal's units and frame to the world's and back: the only place that knows them.
//!
//! Unreal: centimetres, degrees, left-handed, x forward, y right, z up. A rotator turns first about x (roll, right side down),
//! then about y (pitch, nose up), then about z (yaw, clockwise seen from above). The world: metres, radians, right-handed,
//! x forward, y left, z up. The one is the other mirrored in the plane y = 0, so each conversion undoes the other.

use nalgebra::UnitQuaternion;
use simworld_core::environment::Sun;
use simworld_core::geometry::{Point2, Point3};
use simworld_core::ops;

/// Centimetres in a metre.
const CENTIMETRES: f64 = 100.0;

/// Extinction that a fog density of 1 stands for, 1/m: density 4 leaves a visibility of 1 km, 100 one of 39 m.
const EXTINCTION: f64 = 0.001;
/// Koschmieder: contrast falls to 5 % over visibility times extinction.
const KOSCHMIEDER: f64 = 3.912;
/// Visibility in clear air, m.
const CLEAR: f64 = 20_000.0;

/// Illuminance that a sun intensity of 1 stands for, lux: 100 is a clear noon.
const LUX: f64 = 1000.0;

/// A location in cm, in the world.
pub(super) fn point_in_world([x, y, z]: [f64; 3]) -> Point3 {
    Point3::new(x / CENTIMETRES, -y / CENTIMETRES, z / CENTIMETRES)
}

/// A point of the world, in cm.
pub(super) fn location_of(point: &Point3) -> [f64; 3] {
    [point.x * CENTIMETRES, -point.y * CENTIMETRES, point.z * CENTIMETRES]
}

/// A point of the plane in cm, in the world.
pub(super) fn planar_in_world(x: f64, y: f64) -> Point2 {
    Point2::new(x / CENTIMETRES, -y / CENTIMETRES)
}

/// Pitch, yaw and roll in degrees, as a rotation of the world.
pub(super) fn rotation_in_world([pitch, yaw, roll]: [f64; 3]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_euler_angles(roll.to_radians(), -pitch.to_radians(), -yaw.to_radians())
}

/// A rotation of the world, as pitch in [-90, 90], yaw and roll in [-180, 180], degrees.
pub(super) fn rotator_of(rotation: &UnitQuaternion<f64>) -> [f64; 3] {
    let (roll, pitch, yaw) = rotation.euler_angles();
    [-pitch.to_degrees(), -yaw.to_degrees(), roll.to_degrees()]
}

/// A turn to the right in degrees, as a turn to the left in radians.
pub(super) fn turn_in_world(degrees: f64) -> f64 {
    -degrees.to_radians()
}

/// A speed in cm/s or a length in cm, in m/s or m.
pub(super) fn metres(centimetres: f64) -> f64 {
    centimetres / CENTIMETRES
}

/// A length in m, in cm.
pub(super) fn centimetres(metres: f64) -> f64 {
    metres * CENTIMETRES
}

/// A field of view in degrees, in radians.
pub(super) fn angle_in_world(degrees: f64) -> f64 {
    degrees.to_radians()
}

/// An angle in radians, in degrees.
pub(super) fn degrees_of(angle: f64) -> f64 {
    angle.to_degrees()
}

/// The sun whose light travels along pitch and yaw in degrees: a pitch of -26 comes from 26° above the horizon.
pub(super) fn sun_in_world(sun: Sun, pitch: f64, yaw: f64) -> Sun {
    // The light of yaw 0 travels east, so the sun stands in the west; yaw turns clockwise, as azimuths do.
    let azimuth = ops::wrap_angle((yaw - 90.0).to_radians());
    Sun { azimuth, elevation: -pitch.to_radians(), ..sun }
}

/// Pitch and yaw in degrees along which the sun's light travels.
pub(super) fn sun_direction_of(sun: &Sun) -> [f64; 2] {
    let yaw = ops::wrap_angle(sun.azimuth + std::f64::consts::FRAC_PI_2);
    [-sun.elevation.to_degrees(), yaw.to_degrees()]
}

/// A sun intensity from 0 to 100, in lux.
pub(super) fn illuminance_of(intensity: f64) -> f64 {
    intensity * LUX
}

/// An illuminance in lux, as a sun intensity.
pub(super) fn intensity_of(illuminance: f64) -> f64 {
    illuminance / LUX
}

/// A fog density from 0 to 100, as a visibility in m.
pub(super) fn visibility_of(density: f64) -> f64 {
    let extinction = density * EXTINCTION;
    if extinction <= KOSCHMIEDER / CLEAR { CLEAR } else { KOSCHMIEDER / extinction }
}

/// A visibility in m, as a fog density; clear air has none.
pub(super) fn density_of(visibility: f64) -> f64 {
    if visibility >= CLEAR { 0.0 } else { KOSCHMIEDER / visibility / EXTINCTION }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use simworld_core::geometry::Vector3;

    use super::*;

    proptest! {
        #[test]
        fn places_come_back(place in prop::array::uniform3(-1e7..1e7_f64)) {
            let back = location_of(&point_in_world(place));
            for (a, b) in place.iter().zip(back) { prop_assert!((a - b).abs() <= 1e-8 * a.abs().max(1.0)); }
        }

        #[test]
        fn rotations_come_back(rotator in prop::array::uniform3(-180.0..180.0_f64)) {
            let rotation = rotation_in_world(rotator);
            let back = rotation_in_world(rotator_of(&rotation));
            prop_assert!(rotation.angle_to(&back) < 1e-6, "{rotator:?}");
        }

        #[test]
        fn the_mirror_turns_no_rotation_inside_out(
            rotator in prop::array::uniform3(-180.0..180.0_f64),
            point in prop::array::uniform3(-10.0..10.0_f64),
        ) {
            // Turning in Unreal's frame by its own matrix, and turning here, meet in the same point.
            let [pitch, yaw, roll] = rotator.map(f64::to_radians);
            let ((sp, cp), (sy, cy), (sr, cr)) = (ops::sin_cos(pitch), ops::sin_cos(yaw), ops::sin_cos(roll));
            let axes = [
                [cp * cy, cp * sy, sp],
                [sr * sp * cy - cr * sy, sr * sp * sy + cr * cy, -sr * cp],
                [-(cr * sp * cy + sr * sy), cy * sr - cr * sp * sy, cr * cp],
            ];
            let turned: [f64; 3] =
                std::array::from_fn(|column| (0..3).map(|row| point[row] * axes[row][column]).sum());
            let here = rotation_in_world(rotator) * point_in_world(point).coords;
            prop_assert!((here - point_in_world(turned).coords).norm() < 1e-9);
        }

        #[test]
        fn the_sun_comes_back(pitch in -89.0..89.0_f64, yaw in -179.9..179.9_f64) {
            let [p, y] = sun_direction_of(&sun_in_world(Sun::default(), pitch, yaw));
            prop_assert!((p - pitch).abs() < 1e-9 && (y - yaw).abs() < 1e-9, "{p} {y}");
        }

        #[test]
        fn fog_comes_back(density in 0.2..100.0_f64, intensity in 0.0..100.0_f64) {
            prop_assert!((density_of(visibility_of(density)) - density).abs() < 1e-9);
            prop_assert!((intensity_of(illuminance_of(intensity)) - intensity).abs() < 1e-9);
        }
    }

    #[test]
    fn right_is_right_and_up_is_up() {
        let ahead = |rotator| rotation_in_world(rotator) * Vector3::x();
        assert!((ahead([0.0, 90.0, 0.0]) + Vector3::y()).norm() < 1e-12, "yaw 90 faces right");
        assert!((ahead([90.0, 0.0, 0.0]) - Vector3::z()).norm() < 1e-12, "pitch 90 faces up");
        let left_side = rotation_in_world([0.0, 0.0, 90.0]) * Vector3::y();
        assert!((left_side - Vector3::z()).norm() < 1e-12, "roll 90 has the left side up");
        assert_eq!(point_in_world([100.0, 200.0, 50.0]), Point3::new(1.0, -2.0, 0.5));
    }

    #[test]
    fn light_that_travels_east_comes_from_the_west() {
        let sun = sun_in_world(Sun::default(), -30.0, 0.0);
        let towards = sun.direction();
        assert!((towards - Vector3::new(-0.75_f64.sqrt(), 0.0, 0.5)).norm() < 1e-9, "{towards}");
        // Travelling to the right of east, that is south, it comes from the north.
        assert!(sun_in_world(Sun::default(), 0.0, 90.0).direction().y > 0.999);
        assert_eq!((visibility_of(0.0), density_of(CLEAR)), (CLEAR, 0.0));
    }
}
