//! People as they were measured: speed over density, doors, streams that meet.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::seed::Seed;

use super::corridor::{Corridor, DT, weidmann};
use super::streets::mean;
use super::{Effort, Figure, Figures, ValidationError};
use crate::crowd::{AnticipationVelocity, Crowd, Person, Walls, Wish};

/// Figures, if all were found.
fn found(measure: &'static str, figures: Vec<Figure>) -> Figures {
    match figures.iter().find(|figure| figure.value.is_nan()) {
        Some(missing) => Err(ValidationError::Nothing { measure, reason: missing.name.clone() }),
        None => Ok(figures),
    }
}

pub(super) fn speed_over_density(effort: Effort) -> Figures {
    // Forty people are few: their own free speeds would show.
    let seeds = effort.pick(3, 24);
    let figure = |density: f64| {
        let found =
            mean((0..seeds).map(|seed| {
                Corridor::new(density, false, seed).mean_speed(&AnticipationVelocity::default())
            }));
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
    let model = AnticipationVelocity::default();
    let mut figures = Vec::new();
    for seed in 0..effort.pick(2, 12) {
        let mut corridor = Corridor::new(1.0, true, seed);
        let speed = corridor.mean_speed(&model);
        let order = mean((0..300).map(|_| {
            corridor.step(&model);
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
