//! The last look: whatever the wheels are about to roll into is braked for, whether it is on the path or beside it.
//!
//! Lanes, gaps and the room behind others are seen to long before. This is for who swings out, cuts a corner or is not where its path
//! is, and for whoever comes from where nobody looked.

use simworld_core::action::Action;
use simworld_core::geometry::{Obb, Vector2, Vector3};

use super::Driving;
use super::around::{Seen, meets, rolled};
use super::watch::Own;

/// Braking that the last look counts on, m/s², and the time until it bites, s.
const BRAKES: f64 = 4.0;
const BITES: f64 = 0.25;
/// Room before and beside the body, m: who stands so near already may be driven away from.
const ROOM: f64 = 0.15;
const BESIDE: f64 = 0.05;
/// The way to where one would stand is looked at in so many places, no farther apart than that, m.
const PLACES: f64 = 0.5;
/// Others are taken to go on as they do for so long at most, s.
const FORESIGHT: f64 = 1.0;
/// Slower than this one is taken to come on all the same, m/s.
const CREEPS: f64 = 0.5;

impl Driving {
    /// Brakes in place of the pedal that was chosen if the way with these wheels is not free for as far as one needs to stand.
    pub(super) fn last_look(&mut self, own: &Own<'_>, around: &[Seen], actions: &mut [Action; 2]) {
        let Action::Steer { angle } = actions[1] else { return };
        // Wheels take their time to turn: until then one goes as they stand.
        self.is_held =
            rolls_into(own, around, angle) || own.wheels().is_some_and(|now| rolls_into(own, around, now));
        if self.is_held {
            actions[0] = Action::Brake { level: 1.0 };
        }
    }
}

/// Whether one touches anybody or anything that one does not touch yet before one stands, with the front wheels at an angle, radians.
/// What comes from behind keeps off by itself, and what is left behind is not met.
fn rolls_into(own: &Own<'_>, around: &[Seen], angle: f64) -> bool {
    let speed = own.speed.max(0.0);
    let distance = speed * speed / (2.0 * BRAKES) + speed * BITES + ROOM;
    let reach = own.half_length + distance + 3.0;
    let (count, pace) = ((distance / PLACES).ceil().max(1.0), own.speed.max(CREEPS));
    around.iter().any(|other| {
        let way = other.at - own.at;
        let near = way.norm() < reach + other.half_length + other.speed() * FORESIGHT;
        let ahead = way.dot(&own.ahead) > -own.half_length;
        near && ahead && !meets(&own.solid, &other.solid, BESIDE) && {
            (1..=count as u32).any(|place| {
                let rolled_so_far = distance * f64::from(place) / count;
                let later = other.velocity * (rolled_so_far / pace).min(FORESIGHT);
                meets(&rolled(own, rolled_so_far, angle), &moved(&other.solid, later), BESIDE)
            })
        }
    })
}

fn moved(solid: &Obb, by: Vector2) -> Obb {
    let mut solid = *solid;
    solid.pose.translation.vector += Vector3::new(by.x, by.y, 0.0);
    solid
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::{Point3, Twist, pose_facing};
    use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};

    use super::super::around::look;
    use super::*;

    /// Whether a car in the origin that looks east, at a speed, m/s, is held by a lamp there that moves.
    fn is_held(speed: f64, angle: f64, (x, y): (f64, f64), velocity: Vector2) -> bool {
        let mut world = World::new();
        let mut put = |kind, (x, y), shape, velocity: Vector2| {
            let pose = pose_facing(Point3::new(x, y, 0.0), 0.0);
            let id = world.spawn(EntityDesc::new(kind, pose, shape)).expect("a sound entity");
            let twist = Twist { linear: Vector3::new(velocity.x, velocity.y, 0.0), ..Twist::ZERO };
            world.set_motion(id, pose, twist).expect("it is there");
            id
        };
        let sedan = Shape::cuboid(4.5, 1.8, 1.5);
        let car = put(EntityKind::Car, (0.0, 0.0), sedan, Vector2::new(speed, 0.0));
        put(EntityKind::StreetLamp, (x, y), Shape::cuboid(0.3, 0.3, 2.0), velocity);
        let (car, ids) = (world.entity(car).expect("it is there"), [car]);
        let own = Own::new(&car, &ids);
        rolls_into(&own, &look(&world, &own, 50.0, 50.0), angle)
    }

    #[test]
    fn what_is_beside_is_met_by_who_swings_into_it() {
        // A lamp before the left corner, beside the straight way.
        let lamp = (4.0, 1.4);
        assert!(!is_held(4.0, 0.0, lamp, Vector2::zeros()));
        assert!(is_held(4.0, 0.4, lamp, Vector2::zeros()));
        assert!(!is_held(4.0, -0.4, lamp, Vector2::zeros()));
        assert!(!is_held(0.5, 0.4, lamp, Vector2::zeros()), "slowly one comes nearer");
    }

    #[test]
    fn who_comes_from_the_side_is_met_where_it_will_be() {
        let beside = (5.0, -4.0);
        assert!(!is_held(5.0, 0.0, beside, Vector2::zeros()));
        assert!(is_held(5.0, 0.0, beside, Vector2::new(0.0, 5.0)));
        assert!(!is_held(5.0, 0.0, beside, Vector2::new(0.0, -5.0)));
    }

    #[test]
    fn who_stands_is_not_held_by_what_is_behind_it() {
        for place in [(-2.5, 0.0), (-2.0, 1.1), (3.0, 1.2)] {
            assert!(!is_held(0.0, 0.0, place, Vector2::zeros()), "{place:?}");
        }
        assert!(is_held(0.0, 0.0, (2.5, 0.0), Vector2::zeros()));
    }
}
