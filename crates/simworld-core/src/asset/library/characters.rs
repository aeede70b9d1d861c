//! People, animals and robots.
//!
//! Heights and masses of adults are European means (NCD Risk Factor Collaboration 2016, rounded), those of children at eight
//! years by the growth reference of the WHO; robots as sold.

use super::super::Material;
use super::super::row::{Row, boxed, row};
use crate::scene::{EntityKind, Shape};

use EntityKind::{Dog, Person, Robot};
use Material::{Flesh, Metal, Plastic};

#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    row("woman", Person, Shape::Capsule { radius: 0.25, height: 1.65 }, 65.0, Flesh, [0.28, 0.05, 0.04], &["female", "lady", "adult"]),
    row("man", Person, Shape::Capsule { radius: 0.25, height: 1.78 }, 80.0, Flesh, [0.02, 0.05, 0.18], &["male", "adult", "gentleman"]),
    row("child", Person, Shape::Capsule { radius: 0.18, height: 1.3 }, 28.0, Flesh, [0.7, 0.5, 0.05], &["kid", "young", "small"]),
    row("girl", Person, Shape::Capsule { radius: 0.18, height: 1.3 }, 28.0, Flesh, [0.55, 0.3, 0.28], &["child", "kid", "young"]),
    row("boy", Person, Shape::Capsule { radius: 0.18, height: 1.32 }, 29.0, Flesh, [0.05, 0.13, 0.45], &["child", "kid", "young"]),
    row("teenager", Person, Shape::Capsule { radius: 0.25, height: 1.65 }, 55.0, Flesh, [0.06, 0.25, 0.08], &["youth", "young", "pupil", "student"]),
    row("elderly_person", Person, Shape::Capsule { radius: 0.25, height: 1.65 }, 68.0, Flesh, [0.27, 0.23, 0.19], &["old", "senior", "pensioner"]),
    row("police_officer", Person, Shape::Capsule { radius: 0.25, height: 1.78 }, 80.0, Flesh, [0.02, 0.05, 0.18], &["policeman", "policewoman", "cop", "emergency"]),
    row("firefighter", Person, Shape::Capsule { radius: 0.25, height: 1.8 }, 85.0, Flesh, [0.75, 0.25, 0.03], &["fireman", "emergency"]),
    row("paramedic", Person, Shape::Capsule { radius: 0.25, height: 1.75 }, 75.0, Flesh, [0.5, 0.04, 0.03], &["ambulance", "emergency", "medic"]),
    row("nurse", Person, Shape::Capsule { radius: 0.25, height: 1.68 }, 65.0, Flesh, [0.8, 0.8, 0.79], &["medical", "hospital"]),
    row("doctor", Person, Shape::Capsule { radius: 0.25, height: 1.75 }, 75.0, Flesh, [0.8, 0.8, 0.79], &["medical", "hospital", "physician"]),
    row("construction_worker", Person, Shape::Capsule { radius: 0.25, height: 1.78 }, 82.0, Flesh, [0.75, 0.25, 0.03], &["builder", "hard", "hat", "labourer"]),
    row("courier", Person, Shape::Capsule { radius: 0.25, height: 1.75 }, 72.0, Flesh, [0.5, 0.33, 0.06], &["delivery", "postman", "messenger"]),
    row("waiter", Person, Shape::Capsule { radius: 0.25, height: 1.75 }, 70.0, Flesh, [0.03, 0.03, 0.035], &["server", "restaurant"]),
    row("chef", Person, Shape::Capsule { radius: 0.25, height: 1.75 }, 80.0, Flesh, [0.8, 0.8, 0.79], &["cook", "kitchen"]),
    row("jogger", Person, Shape::Capsule { radius: 0.25, height: 1.72 }, 66.0, Flesh, [0.3, 0.45, 0.6], &["runner", "sport"]),
    row("cyclist", Person, Shape::Capsule { radius: 0.25, height: 1.75 }, 72.0, Flesh, [0.06, 0.25, 0.08], &["rider", "bike"]),
    row("business_person", Person, Shape::Capsule { radius: 0.25, height: 1.76 }, 76.0, Flesh, [0.12, 0.12, 0.13], &["suit", "office", "manager"]),
    row("tourist", Person, Shape::Capsule { radius: 0.25, height: 1.72 }, 74.0, Flesh, [0.7, 0.63, 0.48], &["visitor", "sightseer", "camera"]),
    row("street_musician", Person, Shape::Capsule { radius: 0.25, height: 1.74 }, 72.0, Flesh, [0.03, 0.11, 0.05], &["busker", "artist"]),
    row("farmer", Person, Shape::Capsule { radius: 0.25, height: 1.76 }, 80.0, Flesh, [0.2, 0.12, 0.07], &["agricultural", "rural"]),
    row("soldier", Person, Shape::Capsule { radius: 0.25, height: 1.79 }, 82.0, Flesh, [0.03, 0.11, 0.05], &["military", "army"]),
    row("student", Person, Shape::Capsule { radius: 0.25, height: 1.72 }, 66.0, Flesh, [0.3, 0.3, 0.3], &["pupil", "school", "backpack"]),
    row("dog", Dog, boxed(0.8, 0.3, 0.6), 28.0, Flesh, [0.2, 0.12, 0.07], &["animal", "pet", "hound", "labrador"]),
    row("small_dog", Dog, boxed(0.45, 0.2, 0.3), 7.0, Flesh, [0.7, 0.63, 0.48], &["animal", "pet", "puppy", "terrier"]),
    row("large_dog", Dog, boxed(1.0, 0.35, 0.75), 50.0, Flesh, [0.03, 0.03, 0.035], &["animal", "pet", "great", "dane", "mastiff"]),
    row("guide_dog", Dog, boxed(0.8, 0.3, 0.6), 30.0, Flesh, [0.7, 0.63, 0.48], &["animal", "assistance", "harness"]),
    row("humanoid_robot", Robot, boxed(0.35, 0.55, 1.7), 70.0, Plastic, [0.55, 0.56, 0.58], &["android", "two", "legs"]),
    row("security_robot", Robot, boxed(0.9, 0.7, 1.5), 135.0, Plastic, [0.8, 0.8, 0.79], &["patrol", "guard"]),
    row("cleaning_robot", Robot, boxed(1.1, 0.75, 1.0), 220.0, Plastic, [0.05, 0.13, 0.45], &["sweeper", "floor"]),
    row("inspection_robot", Robot, boxed(1.0, 0.7, 0.5), 60.0, Metal, [0.7, 0.5, 0.05], &["tracked", "crawler"]),
    row("wheeled_robot", Robot, boxed(0.5, 0.5, 0.4), 25.0, Plastic, [0.3, 0.3, 0.3], &["rover", "research"]),
];
