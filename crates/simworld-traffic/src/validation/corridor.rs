//! A corridor without ends, in which people are measured.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::ops;
use simworld_core::seed::Seed;

use super::streets::mean;
use crate::crowd::{AnticipationVelocity, Crowd, Person, Walls, Wish};

/// A step, s.
pub(super) const DT: f64 = 0.1;
/// Length of the corridor, m.
pub const LENGTH: f64 = 20.0;
/// Its width, m.
pub const WIDTH: f64 = 4.0;

/// A corridor whose ends are joined: who leaves at one comes in at the other.
pub struct Corridor {
    /// Who walks there.
    pub people: Vec<Person>,
    /// Where each would like to go, and how fast.
    pub wishes: Vec<Wish>,
    walls: Walls,
    /// What moves them.
    pub crowd: Crowd,
    /// Those beyond the ends, as they are seen from within.
    pub seams: Vec<Person>,
}

impl Corridor {
    /// People at a density per m²; half of them the other way if `opposed`.
    pub fn new(density: f64, opposed: bool, seed: u64) -> Self {
        let mut rng = Seed(seed).stream("corridor").rng();
        let count = (density * LENGTH * WIDTH).round() as usize;
        let rows = count.div_ceil((count as f64 * LENGTH / WIDTH).sqrt().ceil() as usize);
        let columns = count.div_ceil(rows) as f64;
        let (mut people, mut wishes) = (Vec::new(), Vec::new());
        for index in 0..count {
            let (column, row) = ((index / rows) as f64, index % rows);
            let back = opposed && rng.unit() < 0.5;
            let direction = if back { -Vector2::x() } else { Vector2::x() };
            let y = 0.2 + (WIDTH - 0.4) * (row as f64 + 0.5) / rows as f64 + rng.uniform(-0.01, 0.01);
            let x = LENGTH * (column + 0.5 * (row % 2) as f64) / columns;
            people.push(Person::standing(Point2::new(x % LENGTH, y), direction));
            wishes.push(Wish { direction, speed: rng.normal_clamped(1.34, 0.26, 0.5, 2.2) });
        }
        let wall = |y: f64| (Point2::new(-5.0, y), Point2::new(LENGTH + 5.0, y));
        let walls = Walls::new(vec![wall(0.0), wall(WIDTH)]);
        Self { people, wishes, walls, crowd: Crowd::default(), seams: Vec::new() }
    }

    /// One step of a tenth of a second.
    pub fn step(&mut self, model: &AnticipationVelocity) {
        self.seams.clear();
        for person in &self.people {
            let ahead = if person.position.x < LENGTH * 0.5 { LENGTH } else { -LENGTH };
            let position = person.position + Vector2::x() * ahead;
            if (-3.0..LENGTH + 3.0).contains(&position.x) {
                self.seams.push(Person { position, ..*person });
            }
        }
        self.crowd.step(model, &mut self.people, &self.wishes, &self.seams, &self.walls, DT);
        for person in &mut self.people {
            person.position.x = person.position.x.rem_euclid(LENGTH);
        }
    }

    /// Mean speed along the wishes, m/s, over two minutes after the first.
    pub fn mean_speed(&mut self, model: &AnticipationVelocity) -> f64 {
        (0..600).for_each(|_| self.step(model));
        mean((0..1200).map(|_| {
            self.step(model);
            let along =
                |(person, wish): (&Person, &Wish)| person.direction.dot(&wish.direction) * person.speed;
            mean(self.people.iter().zip(&self.wishes).map(along))
        }))
    }

    /// How far the streams have parted into lanes, in [0, 1]: the order parameter of Rex and Löwen (2007), over files as wide
    /// as a body with some room.
    pub fn order(&self) -> f64 {
        let mut files = [(0.0, 0.0); 8];
        for (person, wish) in self.people.iter().zip(&self.wishes) {
            let (sum, count) = &mut files[((person.position.y / 0.5) as usize).min(7)];
            *sum += wish.direction.x;
            *count += 1.0;
        }
        let squares = files.iter().filter(|(_, count)| *count > 0.0).map(|(sum, count)| sum * sum / count);
        squares.sum::<f64>() / self.people.len() as f64
    }
}

/// Speed at a density per m² (Weidmann 1993), m/s.
pub fn weidmann(density: f64) -> f64 {
    1.34 * (1.0 - ops::exp(-1.913 * (1.0 / density - 1.0 / 5.4)))
}
