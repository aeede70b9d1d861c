use proptest::prelude::*;
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::pose_facing;
use simworld_core::ops;
use simworld_core::seed::{Seed, StreamRng};

use super::*;
use crate::mesh::{Drawn, MeshId};
use crate::resident::Card;
use crate::sieve::{Grain, Sieve};

const MIN_PIXELS: f64 = 0.7;
const LEVELS: [Detail; 3] = [Detail::Far, Detail::Middle, Detail::Near];

fn manner(is_cast: bool, in_color: bool, finest: bool) -> Manner {
    Manner { min_pixels: MIN_PIXELS, finest, is_cast, in_color, widest: 0.0 }
}

/// A view from a place, of a focal length; every fifth of them parallel.
fn view(number: usize, eye: Point3, yaw: f64, focal: f64) -> View {
    let intrinsics = Intrinsics { width: 128, height: 96, fx: focal, fy: focal * 0.9, cx: 60.0, cy: 50.0 };
    let camera = Camera::looking_along(&pose_facing(eye, yaw), intrinsics);
    let view = View::new(&camera, 0.05, 800.0, 4096).expect("a sound camera");
    if number % 5 == 4 { view.projected(Projection::Parallel) } else { view }
}

/// Eyes about a place, some of them beside one another and some far off.
fn views(rng: &mut StreamRng, count: usize, middle: Point3) -> Vec<View> {
    let one = |number: usize| {
        let spread = ops::pow(10.0, rng.uniform(0.0, 3.0));
        let aside = Vector3::new(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), 0.0) * spread;
        let eye = middle + aside + Vector3::z() * rng.uniform(0.5, 40.0);
        let focal =
            if number % 5 == 4 { rng.uniform(0.5, 30.0) } else { ops::pow(10.0, rng.uniform(1.5, 3.0)) };
        view(number, eye, rng.uniform(-3.0, 3.0), focal)
    };
    (0..count).map(one).collect()
}

fn balls(rng: &mut StreamRng, views: &[View]) -> Vec<Ball> {
    let one = |number: usize| {
        let away = Vector3::new(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(-0.2, 0.2));
        let center = views[number % views.len()].eye + away * ops::pow(10.0, rng.uniform(-0.5, 3.2));
        // Some are of the very size from which on balls are large.
        let radius = if number.is_multiple_of(7) {
            Detail::LARGE * rng.uniform(0.999, 1.001)
        } else {
            rng.uniform(0.4, 14.0)
        };
        Ball { center, radius }
    };
    (0..120).map(one).collect()
}

/// The levels at which a sieve lets a ball through.
fn sifted(sieve: &Sieve, ball: &Ball) -> u8 {
    let grain = Grain::of(ball);
    let mut card = Card::of(Drawn::Own(MeshId::Cuboid));
    LEVELS.into_iter().fold(0, |levels, detail| {
        card.details = detail.bit();
        if sieve.sift(&card, &grain).is_some() { levels | detail.bit() } else { levels }
    })
}

/// The level at which rays meet a ball, or its shadow, as rays.wgsl reckons in floats whose origin is elsewhere.
fn met(view: &View, ball: &Ball, origin: &Vector3, [shades, finest]: [bool; 2]) -> u8 {
    let float = |place: &Point3| (place.coords - origin).map(|coordinate| coordinate as f32);
    let (away, radius) = (float(&ball.center) - float(&view.eye), ball.radius as f32);
    let distance = away.norm();
    let focal = view.intrinsics.fx.max(view.intrinsics.fy) as f32;
    let is_parallel = view.projection == Projection::Parallel;
    let apart = if is_parallel { 1.0 } else { distance.max(radius).max(1e-9) };
    let pixels = 2.0 * radius * focal / apart;
    let is_shown = distance - radius <= view.far as f32 && pixels >= MIN_PIXELS as f32;
    if !is_shown && !shades {
        return 0;
    }
    let size = pixels * if radius > 8.5 { 0.3 } else { 1.0 };
    let of_size = [(28.0, Detail::Far), (80.0, Detail::Middle), (f32::INFINITY, Detail::Near)];
    let level = of_size.into_iter().find(|(below, _)| size < *below).map_or(Detail::Near, |(_, level)| level);
    if finest { Detail::Near.bit() } else { level.bit() }
}

proptest! {
    /// Few eyes and many, near and far: whatever level a view by triangles draws, or its shadow map, is demanded.
    #[test]
    fn what_triangles_show_is_demanded(seed in any::<u64>(), few in any::<bool>(), finest in any::<bool>(), far_off in any::<bool>()) {
        let mut rng = Seed(seed).stream("tests/demand").rng();
        let middle = if far_off { Point3::new(4.0e6, -7.0e6, 0.0) } else { Point3::origin() };
        let views = views(&mut rng, if few { 3 } else { 40 }, middle);
        let sun = Vector3::new(0.4, -0.3, 0.6).normalize();
        let shadows: Vec<Option<ShadowView>> =
            views.iter().take(5).map(|view| ShadowView::new(view, &sun, 120.0, 2048)).collect();
        let mut demand = Demand::default();
        demand.gather(&views, &shadows, &manner(false, true, finest));
        let of_views = views.iter().map(|view| Sieve::of_view(view, MIN_PIXELS, finest, [None; 2]));
        let of_maps = shadows.iter().flatten().map(|shadow| Sieve::of_shadow(shadow, finest));
        let sieves: Vec<Sieve> = of_views.chain(of_maps).collect();
        for ball in balls(&mut rng, &views) {
            let needed = sieves.iter().fold(0, |levels, sieve| levels | sifted(sieve, &ball));
            let levels = demand.levels(&ball);
            prop_assert_eq!(needed & !levels, 0, "needed {:03b}, demanded {:03b}: {:?}", needed, levels, ball);
        }
    }

    /// The same of what rays meet, with their light and without.
    #[test]
    fn what_rays_meet_is_demanded(seed in any::<u64>(), few in any::<bool>(), shades in any::<bool>(), finest in any::<bool>(), far_off in any::<bool>()) {
        let mut rng = Seed(seed).stream("tests/demand").rng();
        let middle = if far_off { Point3::new(4.0e6, -7.0e6, 0.0) } else { Point3::origin() };
        let views = views(&mut rng, if few { 3 } else { 40 }, middle);
        let mut demand = Demand::default();
        demand.gather(&views, &[], &manner(true, shades, finest));
        let origin = middle.coords * rng.uniform(0.0, 1.0) + Vector3::new(900.0, -70.0, 3.0);
        for ball in balls(&mut rng, &views) {
            let needed = views.iter().fold(0, |levels, view| levels | met(view, &ball, &origin, [shades, finest]));
            let levels = demand.levels(&ball);
            prop_assert_eq!(needed & !levels, 0, "needed {:03b}, demanded {:03b}: {:?}", needed, levels, ball);
        }
    }
}

/// A thousand eyes on a square kilometre or four: of most bodies the farthest level is all there is to see, and of those beside a single picture nothing.
#[test]
fn little_else_is_demanded() {
    let mut rng = Seed(9).stream("tests/demand").rng();
    let place = |rng: &mut StreamRng, high: f64| {
        Point3::new(rng.uniform(-1000.0, 1000.0), rng.uniform(-1000.0, 1000.0), high)
    };
    let many: Vec<View> =
        (0..1000).map(|_| view(0, place(&mut rng, 1.6), rng.uniform(-3.0, 3.0), 90.0)).collect();
    let (mut crowd, mut one) = (Demand::default(), Demand::default());
    crowd.gather(&many, &[], &manner(true, true, false));
    one.gather(&many[..1], &[], &manner(false, true, false));
    let bodies: Vec<Ball> = (0..4000).map(|_| Ball { center: place(&mut rng, 0.9), radius: 2.0 }).collect();
    let count = |demand: &Demand| -> u32 { bodies.iter().map(|ball| demand.levels(ball).count_ones()).sum() };
    let beside = bodies.iter().filter(|ball| one.levels(ball) == 0).count();
    assert!((4000..4800).contains(&count(&crowd)), "{} levels of 4000 bodies", count(&crowd));
    assert!(count(&one) < 1500 && beside > 2500, "{} levels, {beside} beside the picture", count(&one));
}

/// Nobody demands anything where nobody looks, and all of what stands beside the eye.
#[test]
fn who_is_near_is_dressed_finely() {
    let ball = |x: f64| Ball { center: Point3::new(x, 0.0, 0.0), radius: 1.0 };
    let mut demand = Demand::default();
    assert_eq!(demand.levels(&ball(3.0)), 0);
    demand.gather(&[view(0, Point3::origin(), 0.0, 100.0)], &[], &manner(false, false, false));
    let levels = [1.5, 5.0, 30.0, -30.0, 900.0].map(|x| demand.levels(&ball(x)));
    let [near, middle, far] = [Detail::Near, Detail::Middle, Detail::Far].map(Detail::bit);
    assert_eq!(levels, [near, middle, far, 0, 0]);
}
