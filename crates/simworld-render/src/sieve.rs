//! Who may be on a picture, and how finely, in whole numbers: the host and shaders/sift.wgsl reckon the same rule, and not a bit of the outcome depends on
//! which of them did.
//!
//! Places are told in steps of 1/64 m, and far away in steps of a 32 thousandth of the distance. What is compared with pixels are products of two
//! floats of twelve bits each, which are exact however a device rounds. What lies beside the picture is kept where it is near its edge: nothing
//! that could be seen falls through.

use bytemuck::{Pod, Zeroable};
use simworld_core::geometry::{Point3, Vector3};

use crate::batch::Projection;
use crate::look::Detail;
use crate::mesh::Drawn;
use crate::resident::{Ball, Card};
use crate::shadow::ShadowView;
use crate::view::View;

/// Steps in a metre.
const STEPS: f64 = 64.0;
/// Places are within so many steps of the origin, so that differences are whole numbers of 32 bits: 16 777 km.
const FARTHEST: f64 = (1 << 30) as f64;
/// Differences have so many bits when they are multiplied.
const BITS: u32 = 15;
/// Normals have a length of so many bits.
const NORMAL: u32 = 14;
/// What rounding may take from the distance to a side, in steps of the difference: of the places of ball and eye, of the normal and its product, of the side.
const SLACK: u32 = 10;
/// More than any ball needs to have all pixels that are asked for.
const ENOUGH: f32 = (1_u64 << 60) as f32;
/// A shadow texel says less than a pixel: there is a silhouette and nothing else, and its edge is spread over two texels.
pub(crate) const SHADOW_SHARE: f64 = 0.33;

/// Pixels below which a speck stands for a mesh, see [`Drawn::speck`].
pub(crate) const SPECKS: [f64; 7] = [15.0, 16.0, 22.0, 44.0, 55.0, 60.0, 220.0];
/// Where their thresholds begin among those of a sieve.
const FIRST_SPECK: usize = 5;
/// The threshold of what nothing stands for: always reached.
pub(crate) const NO_SPECK: u32 = 15;
/// Nobody's slot.
const NOBODY: u32 = u32::MAX;

const PARALLEL: u32 = 1;
const CASTERS: u32 = 2;

/// Buckets of distance, each a quarter of an octave; as in shaders/sift.wgsl.
pub(crate) const BUCKETS: u32 = 64;

/// A ball in whole steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Grain {
    pub center: [i32; 3],
    /// Rounded up.
    pub radius: u32,
    /// The radius in twelve bits, rounded up.
    pub size: f32,
}

/// What a view lets through; the twin of `Sieve` in shaders/sift.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Sieve {
    /// From where it looks, steps.
    eye: [i32; 3],
    flags: u32,
    /// Inward normals of its sides in the world, and how far inside of each the eye is, steps.
    sides: [[i32; 4]; 5],
    /// By threshold of pixels, how many radii away a ball has that many.
    reach: [[f32; 4]; 4],
    /// Steps to what is too far away.
    far: u32,
    hidden: u32,
    only: u32,
    /// How many instances the device looks at.
    pub count: u32,
}

impl Grain {
    pub(crate) fn of(ball: &Ball) -> Self {
        let size = rounded_up(ball.radius * STEPS);
        Self { center: steps(&ball.center), radius: size.ceil().min(FARTHEST as f32) as u32, size }
    }
}

impl Sieve {
    /// That of a view; `hidden` is left out, and everybody but `only`, by their slots.
    pub(crate) fn of_view(
        view: &View,
        min_pixels: f64,
        finest: bool,
        [hidden, only]: [Option<u32>; 2],
    ) -> Self {
        let world = |normal: &Vector3| view.optical_from_world.transpose() * normal;
        let [left, right, top, bottom] = view.sides().map(|(normal, inside)| (world(&normal), inside));
        let near = (view.forward(), -view.near);
        let focal = view.intrinsics.fx.max(view.intrinsics.fy);
        let flags = if view.projection == Projection::Parallel { PARALLEL } else { 0 };
        let mut sieve = Self::new(&view.eye, flags, [left, right, top, bottom, near], focal, finest);
        sieve.set_reach(0, min_pixels, focal);
        sieve.far = (view.far * STEPS).ceil().min(FARTHEST) as u32;
        (sieve.hidden, sieve.only) = (hidden.unwrap_or(NOBODY), only.unwrap_or(NOBODY));
        sieve
    }

    /// That of a shadow map: what throws shadows into it, as finely as its texels show, the same for every eye.
    pub(crate) fn of_shadow(shadow: &ShadowView, finest: bool) -> Self {
        let focal = SHADOW_SHARE / shadow.texel;
        Self::new(&shadow.center, PARALLEL | CASTERS, shadow.sides(), focal, finest)
    }

    fn new(eye: &Point3, flags: u32, sides: [(Vector3, f64); 5], focal: f64, finest: bool) -> Self {
        let sides = sides.map(|(normal, inside)| {
            let [x, y, z] = (normal * f64::from(1 << NORMAL)).map(|part| part.round() as i32).into();
            [x, y, z, (inside * STEPS).ceil().clamp(-FARTHEST, FARTHEST) as i32]
        });
        let (far, count) = (i32::MAX as u32, 0);
        let reach = [[ENOUGH; 4]; 4];
        let mut sieve =
            Self { eye: steps(eye), flags, sides, reach, far, hidden: NOBODY, only: NOBODY, count };
        if !finest {
            let levels = Detail::thresholds().into_iter().flatten();
            for (index, pixels) in (1..).zip(levels.chain(SPECKS)) {
                sieve.set_reach(index, pixels, focal);
            }
        }
        sieve
    }

    /// Balls have `pixels` across that are so many of their radii away, or are of so many steps where rays are parallel.
    fn set_reach(&mut self, threshold: usize, pixels: f64, focal: f64) {
        let unit = if self.flags & PARALLEL == 0 { 1.0 } else { STEPS };
        let reach = 2.0 * focal / (unit * pixels.max(1e-12));
        self.reach[threshold / 4][threshold % 4] = rounded_up(reach).clamp(ENOUGH.recip(), ENOUGH);
    }

    /// What of an instance is drawn, and its bucket of distance; `None` if it is not there at the level of detail at hand, or cannot be seen.
    pub(crate) fn sift(&self, card: &Card, grain: &Grain) -> Option<(Drawn, u32)> {
        let may_be = if self.flags & CASTERS == 0 {
            card.slot != self.hidden && (self.only == NOBODY || self.only == card.slot)
        } else {
            card.casts
        };
        if !may_be {
            return None;
        }
        let distance = self.distance(grain)?;
        let apart = if self.flags & PARALLEL == 0 { (distance as f32).max(grain.size) } else { 1.0 };
        let has = |threshold: usize| grain.size * self.reach[threshold / 4][threshold % 4] >= apart;
        let first = 1 + 2 * usize::from(grain.size > (Detail::LARGE * STEPS) as f32);
        let detail = match (has(first), has(first + 1)) {
            (false, _) => Detail::Far,
            (true, false) => Detail::Middle,
            (true, true) => Detail::Near,
        };
        if !has(0) || card.details & detail.bit() == 0 {
            return None;
        }
        let mesh = match card.mesh.speck() {
            Some((few, speck)) if !has(threshold_of(few) as usize) => speck,
            _ => card.mesh,
        };
        Some((mesh, if mesh.pattern().is_flat() { 0 } else { bucket(distance) }))
    }

    /// How far away the middle of a ball is, steps; `None` if it is beside what is seen, or beyond.
    fn distance(&self, grain: &Grain) -> Option<u32> {
        let away: [i32; 3] = std::array::from_fn(|axis| grain.center[axis].wrapping_sub(self.eye[axis]));
        let most = away.iter().fold(grain.radius, |most, part| most.max(part.unsigned_abs()));
        let shift = (u32::BITS - most.leading_zeros()).saturating_sub(BITS);
        let [x, y, z] = away.map(|part| part >> shift);
        let reach = (grain.radius >> shift) + 1 + SLACK;
        let is_inside = |[a, b, c, inside]: &[i32; 4]| {
            ((a * x + b * y + c * z) >> NORMAL) + (inside >> shift) + reach as i32 >= 0
        };
        if !self.sides.iter().all(is_inside) {
            return None;
        }
        let square = |part: i32| part.unsigned_abs().pow(2);
        let distance = (square(x) + square(y) + square(z)).isqrt();
        (distance <= (self.far >> shift) + reach).then_some(distance << shift)
    }
}

/// The threshold of a speck that stands for a mesh below so many pixels.
pub(crate) fn threshold_of(few: f64) -> u32 {
    let known = SPECKS.iter().position(|pixels| pixels.to_bits() == few.to_bits());
    known.map_or(NO_SPECK, |index| (FIRST_SPECK + index) as u32)
}

/// What is nearer is drawn first, so that what it hides is not shaded: from half a metre on by quarters of an octave.
fn bucket(distance: u32) -> u32 {
    let distance = distance.max(STEPS as u32 / 2);
    let octave = distance.ilog2();
    ((octave - 5) * 4 + (distance >> (octave - 2) & 3)).min(BUCKETS - 1)
}

fn steps(place: &Point3) -> [i32; 3] {
    std::array::from_fn(|axis| (place[axis] * STEPS).round().clamp(-FARTHEST, FARTHEST) as i32)
}

/// The next float of twelve bits that is no less; not for negative ones.
fn rounded_up(number: f64) -> f32 {
    const DROPPED: u32 = (1 << 12) - 1;
    f32::from_bits(((number as f32).to_bits().saturating_add(DROPPED)) & !DROPPED)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use simworld_core::camera::{Camera, Intrinsics};
    use simworld_core::geometry::pose_facing;
    use simworld_core::ops;

    use super::*;
    use crate::mesh::MeshId;

    fn card(mesh: MeshId) -> Card {
        Card::of(Drawn::Own(mesh))
    }

    #[test]
    fn every_speck_has_a_threshold() {
        for (few, _) in MeshId::ALL.iter().filter_map(|mesh| mesh.speck()) {
            assert_ne!(threshold_of(few), NO_SPECK, "{few}");
        }
        assert!(FIRST_SPECK + SPECKS.len() <= NO_SPECK as usize);
    }

    #[test]
    fn buckets_grow_with_distance() {
        let of: Vec<u32> = [0, 32, 40, 48, 63, 64, 1 << 20, u32::MAX].map(bucket).into();
        assert_eq!(of, [0, 0, 1, 2, 3, 4, 60, 63]);
    }

    #[test]
    fn twelve_bits_are_no_less() {
        for number in [1e-20, 0.1, 1.0, 3.3, 4095.0, 4097.0, 1e9] {
            let up = rounded_up(number);
            assert!(
                f64::from(up) >= number * (1.0 - 1e-7) && f64::from(up) <= number * 1.0005,
                "{number} {up}"
            );
            assert_eq!(up.to_bits() & 0xfff, 0);
        }
    }

    proptest! {
        /// Anywhere on the Earth, near and far: what the exact test of a view lets through, the sieve does, and little else.
        #[test]
        fn nothing_that_is_seen_falls_through(
            eye in (-1.2e7..1.2e7f64, -1.2e7..1.2e7f64, -50.0..500.0f64),
            yaw in -3.0..3.0f64,
            balls in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64, 0.0..4.0f64, -1.0..3.0f64), 60),
        ) {
            let intrinsics = Intrinsics { width: 120, height: 90, fx: 70.0, fy: 75.0, cx: 55.0, cy: 40.0 };
            let pose = pose_facing(Point3::new(eye.0, eye.1, eye.2), yaw);
            let view = View::new(&Camera::looking_along(&pose, intrinsics), 0.05, 3000.0, 4096).expect("a sound camera");
            let sieve = Sieve::of_view(&view, 0.7, true, [None; 2]);
            for (x, y, z, far, large) in balls {
                let away = Vector3::new(x, y, z) * ops::pow(10.0, far);
                let ball = Ball { center: view.eye + away, radius: ops::pow(10.0, large) };
                // Places are rounded where they lie, thousands of kilometres out.
                let away = ball.center - view.eye;
                let passes = sieve.sift(&card(MeshId::Cuboid), &Grain::of(&ball)).is_some();
                prop_assert!(passes || !view.sees(&away, ball.radius, 0.7), "{away} {}", ball.radius);
                let more = ball.radius * 1.01 + 0.25 + away.norm() * 0.002;
                prop_assert!(!passes || view.sees(&away, more, 0.69), "{away} {}", ball.radius);
            }
        }
    }
}
