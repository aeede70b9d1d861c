//! Halls full of people, to measure how fast a crowd is worked out.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::seed::Seed;

use crate::crowd::{AnticipationVelocity, Crowd, Person, Walls, Wish};

/// People.
pub const PEOPLE: usize = 10_000;

/// Ten thousand people at one per m², who walk to and fro in ten halls of 100 by 10 m, half of them each way.
pub struct Halls {
    people: Vec<Person>,
    wishes: Vec<Wish>,
    walls: Walls,
    crowd: Crowd,
}

impl Halls {
    /// Everybody stands at their place.
    pub fn new(seed: u64) -> Self {
        let mut rng = Seed(seed).stream("halls").rng();
        let place = |index: usize| Point2::new((index % 100) as f64 + 0.5, (index / 100) as f64 + 0.5);
        let people: Vec<Person> =
            (0..PEOPLE).map(|index| Person::standing(place(index), Vector2::x())).collect();
        let mut wish = |_| {
            let direction = if rng.unit() < 0.5 { Vector2::x() } else { -Vector2::x() };
            Wish { direction, speed: rng.normal_clamped(1.34, 0.26, 0.5, 2.2) }
        };
        let wishes = people.iter().map(&mut wish).collect();
        let at = Point2::new;
        let mut walls: Vec<(Point2, Point2)> =
            (0..=10).map(|hall| f64::from(hall) * 10.0).map(|y| (at(0.0, y), at(100.0, y))).collect();
        walls.extend([0.0, 100.0].map(|x| (at(x, 0.0), at(x, 100.0))));
        Self { people, wishes, walls: Walls::new(walls), crowd: Crowd::default() }
    }

    /// One step of `dt` s; who comes to an end of the hall turns round.
    pub fn step(&mut self, dt: f64) {
        for (person, wish) in self.people.iter().zip(&mut self.wishes) {
            if (person.position.x - 50.0) * wish.direction.x > 48.0 {
                wish.direction = -wish.direction;
            }
        }
        let model = AnticipationVelocity::default();
        self.crowd.step(&model, &mut self.people, &self.wishes, &[], &self.walls, dt);
    }
}
