//! People as they were measured: speed over density, doors, streams that meet.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::ops;
use simworld_core::seed::Seed;

use super::streets::mean;
use super::{Effort, Figure, Figures, ValidationError};
use crate::crowd::{AnticipationVelocity, Crowd, Person, Walls, Wish};

const DT: f64 = 0.1;
/// The corridor, m.
const LENGTH: f64 = 20.0;
const WIDTH: f64 = 4.0;

/// A corridor whose ends are joined: who leaves at one comes in at the other.
struct Corridor {
    people: Vec<Person>,
    wishes: Vec<Wish>,
    walls: Walls,
    crowd: Crowd,
    seams: Vec<Person>,
}

impl Corridor {
    /// People at a density per m²; half of them the other way if `opposed`.
    fn new(density: f64, opposed: bool, seed: u64) -> Self {
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

    fn step(&mut self) {
        self.seams.clear();
        for person in &self.people {
            let ahead = if person.position.x < LENGTH * 0.5 { LENGTH } else { -LENGTH };
            let position = person.position + Vector2::x() * ahead;
            if (-3.0..LENGTH + 3.0).contains(&position.x) {
                self.seams.push(Person { position, ..*person });
            }
        }
        let model = AnticipationVelocity::default();
        self.crowd.step(&model, &mut self.people, &self.wishes, &self.seams, &self.walls, DT);
        for person in &mut self.people {
            person.position.x = person.position.x.rem_euclid(LENGTH);
        }
    }

    /// Mean speed along the wishes, m/s, over two minutes after the first.
    fn mean_speed(&mut self) -> f64 {
        (0..600).for_each(|_| self.step());
        mean((0..1200).map(|_| {
            self.step();
            let along =
                |(person, wish): (&Person, &Wish)| person.direction.dot(&wish.direction) * person.speed;
            mean(self.people.iter().zip(&self.wishes).map(along))
        }))
    }

    /// How far the streams have parted into lanes, in [0, 1]: the order parameter of Rex and Löwen (2007), over files as wide
    /// as a body with some room.
    fn order(&self) -> f64 {
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

/// Figures, if all were found.
fn found(measure: &'static str, figures: Vec<Figure>) -> Figures {
    match figures.iter().find(|figure| figure.value.is_nan()) {
        Some(missing) => Err(ValidationError::Nothing { measure, reason: missing.name.clone() }),
        None => Ok(figures),
    }
}

/// Speed at a density per m² (Weidmann 1993), m/s.
fn weidmann(density: f64) -> f64 {
    1.34 * (1.0 - ops::exp(-1.913 * (1.0 / density - 1.0 / 5.4)))
}

pub(super) fn speed_over_density(effort: Effort) -> Figures {
    // Forty people are few: their own free speeds would show.
    let seeds = effort.pick(3, 24);
    let figure = |density: f64| {
        let found = mean((0..seeds).map(|seed| Corridor::new(density, false, seed).mean_speed()));
        let expected = weidmann(density);
        let band = (expected - 0.1, expected + 0.1);
        Figure::within(format!("walking speed at {density} per m²"), found, band, "m/s")
            .cited("1.34 (1 - exp(-1.913 (1/ρ - 1/5.4))), Weidmann 1993")
    };
    found("walking speed", [0.5, 1.0, 1.5, 2.0, 3.0, 4.0].map(figure).to_vec())
}

/// How many pass a door of a width a second and metre, from a room of 7 by 8 m full of people; NaN if it is blocked.
fn flow_through(width: f64, seed: u64) -> f64 {
    let model = AnticipationVelocity::default();
    let half = width * 0.5;
    let at = Point2::new;
    let walls = Walls::new(vec![
        (at(-10.0, -4.0), at(0.0, -4.0)),
        (at(-10.0, 4.0), at(0.0, 4.0)),
        (at(0.0, -4.0), at(0.0, -half)),
        (at(0.0, half), at(0.0, 4.0)),
        (at(0.0, -half), at(2.0, -half)),
        (at(0.0, half), at(2.0, half)),
    ]);
    let mut rng = Seed(seed).stream("room").rng();
    let (mut people, mut speeds) = (Vec::new(), Vec::new());
    for (row, column) in (0..14).flat_map(|row| (0..12).map(move |column| (row, column))) {
        let x = -1.0 - 0.6 * f64::from(column) + rng.uniform(-0.1, 0.1);
        let y = -3.5 + 0.54 * f64::from(row) + rng.uniform(-0.05, 0.05);
        people.push(Person::standing(at(x, y), Vector2::x()));
        speeds.push(rng.normal_clamped(1.34, 0.26, 0.5, 2.2));
    }
    let (mut crowd, mut wishes, mut passed) = (Crowd::default(), Vec::new(), Vec::new());
    let everybody = people.len();
    for step in 0..3000 {
        wishes.clear();
        wishes.extend(people.iter().zip(&speeds).map(|(person, speed)| {
            let inside = half - model.radius - 0.05;
            let target = if person.position.x > 0.0 {
                at(10.0, person.position.y)
            } else {
                at(0.3, person.position.y.clamp(-inside, inside))
            };
            let direction = (target - person.position).try_normalize(1e-9).unwrap_or_else(Vector2::x);
            Wish { direction, speed: *speed }
        }));
        crowd.step(&model, &mut people, &wishes, &[], &walls, DT);
        for index in (0..people.len()).rev() {
            if people[index].position.x > 2.5 {
                people.swap_remove(index);
                speeds.swap_remove(index);
                passed.push(f64::from(step) * DT);
            }
        }
    }
    if passed.len() < everybody {
        return f64::NAN;
    }
    // After the first have come and before the last thin out.
    let (first, last) = (everybody / 10, everybody * 7 / 10);
    (last - first) as f64 / (passed[last] - passed[first]) / width
}

pub(super) fn doors(effort: Effort) -> Figures {
    let seeds = effort.pick(1, 8);
    let figure = |width: f64| {
        let found = mean((0..seeds).map(|seed| flow_through(width, seed)));
        Figure::within(format!("flow through a door of {width} m"), found, (1.2, 1.9), "1/(m s)")
            .cited("1.2 to 1.9 in experiments at widths of 0.6 to 2.5 m, Seyfried et al. 2009 and others")
    };
    found("doors", [0.8, 1.2, 1.6, 2.5].map(figure).to_vec())
}

pub(super) fn streams(effort: Effort) -> Figures {
    let mut figures = Vec::new();
    for seed in 0..effort.pick(2, 12) {
        let mut corridor = Corridor::new(1.0, true, seed);
        let speed = corridor.mean_speed();
        let order = mean((0..300).map(|_| {
            corridor.step();
            corridor.order()
        }));
        figures.push(Figure::within(
            format!("order of lanes at 1 per m², seed {seed}"),
            order,
            (0.6, 1.0),
            "",
        ));
        let share = speed / weidmann(1.0);
        let name = format!("speed there, of that of one stream, seed {seed}");
        figures.push(Figure::within(name, share, (0.6, 1.2), ""));
    }
    found("streams that meet", figures)
}
