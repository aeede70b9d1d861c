//! Names of places and streets, set so that none covers another. Sizes in millimetres on paper.

mod chains;

use std::fmt;

use chains::Chain;
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::scene::Place;

use super::page::{Frame, Page, escaped, path_data};
use super::style::{INK, PAPER, place_color, road_style};
use crate::City;
use crate::building::Building;

/// Mean width of a letter over its size.
const LETTER: f64 = 0.53;
/// Within so many sizes along a line its pieces turn by no more than an angle with this cosine, or letters would fall over one
/// another on the inner side.
const BEND_REACH: f64 = 2.0;
const BEND_COSINE: f64 = 0.9;
/// Most labels a sheet bears.
const MOST_STREETS: usize = 140;
const MOST_PLACES: usize = 36;
/// Size of the names of places.
const PLACE_LETTERING: f64 = 2.7;
/// Places worth a name on the map, the most sought first.
const NAMED: [Place; 5] =
    [Place::Hospital, Place::Museum, Place::School, Place::RestArea, Place::ChargingStation];

/// Width of a text on paper.
pub(super) fn width_of(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * size * LETTER
}

/// The rectangles that labels take so far.
#[derive(Default)]
struct Room {
    taken: Vec<Frame>,
}

impl Room {
    /// Takes all the frames, or none if one is taken or beyond the map.
    fn take(&mut self, page: &Page, frames: &[Frame]) -> bool {
        let is_free = |frame: &Frame| {
            page.map.contains((frame.x, frame.y), 2.0)
                && page.map.contains((frame.right(), frame.bottom()), 2.0)
                && !self.taken.iter().any(|other| {
                    frame.x < other.right()
                        && other.x < frame.right()
                        && frame.y < other.bottom()
                        && other.y < frame.bottom()
                })
        };
        let free = frames.iter().all(is_free);
        if free {
            self.taken.extend_from_slice(frames);
        }
        free
    }
}

pub(super) fn draw(f: &mut fmt::Formatter<'_>, page: &Page, city: &City) -> fmt::Result {
    let mut room = Room::default();
    // The north arrow has its corner.
    let map = page.map;
    room.taken.push(Frame { x: map.right() - 24.0, y: map.y, width: 24.0, height: 28.0 });
    writeln!(
        f,
        r#"<g id="labels" fill="{INK}" stroke="{PAPER}" stroke-width="0.7" stroke-linejoin="round" paint-order="stroke">"#
    )?;
    places(f, page, city, &mut room)?;
    streets(f, page, city, &mut room)?;
    writeln!(f, "</g>")
}

fn places(f: &mut fmt::Formatter<'_>, page: &Page, city: &City, room: &mut Room) -> fmt::Result {
    writeln!(f, r#"<g id="place-names" font-size="{PLACE_LETTERING}" font-weight="500">"#)?;
    let mut drawn = 0;
    for wanted in NAMED {
        // No kind may fill the sheet.
        let mut of_kind = 0;
        for building in scattered(city, wanted) {
            let Some(name) = &building.name else { continue };
            if drawn == MOST_PLACES || of_kind == MOST_PLACES / 3 {
                break;
            }
            let (x, y) = page.place(&building.center);
            let width = width_of(name, PLACE_LETTERING) + 3.0;
            let frame = Frame { x: x - 1.5, y: y - 2.0, width: width + 1.5, height: 4.0 };
            if room.take(page, &[frame]) {
                let (color, name) = (place_color(wanted), escaped(name));
                writeln!(
                    f,
                    r#"<circle cx="{x:.2}" cy="{y:.2}" r="1.05" fill="{color}" stroke="{INK}" stroke-width="0.3"/><text x="{:.2}" y="{:.2}">{name}</text>"#,
                    x + 2.0,
                    y + 0.95
                )?;
                drawn += 1;
                of_kind += 1;
            }
        }
    }
    writeln!(f, "</g>")
}

/// The buildings of a use in an order that jumps about, so that the first few lie all over the city.
fn scattered(city: &City, place: Place) -> Vec<&Building> {
    let mut found: Vec<&Building> =
        city.buildings.iter().filter(|building| building.place == place).collect();
    // Multiples of the golden ratio, modulo one, spread evenly (Knuth, TAOCP 3, 6.4).
    let key = |index: usize| (index as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mut order: Vec<usize> = (0..found.len()).collect();
    order.sort_unstable_by_key(|index| key(*index));
    found = order.into_iter().map(|index| found[index]).collect();
    found
}

fn streets(f: &mut fmt::Formatter<'_>, page: &Page, city: &City, room: &mut Room) -> fmt::Result {
    writeln!(f, r#"<g id="street-names" letter-spacing="0.12" text-anchor="middle">"#)?;
    let mut drawn = 0;
    for chain in chains::of(city) {
        if drawn == MOST_STREETS {
            break;
        }
        let Some(name) = city.network.names.get(chain.name as usize) else { continue };
        let size = road_style(chain.class).lettering;
        let length = width_of(name, size) * 1.06;
        let Some(line) = stretch(page, &chain, length, size) else { continue };
        if room.take(page, &boxes_along(&line, size)) {
            let data = path_data(line.iter().copied());
            writeln!(
                f,
                r##"<path id="street-{drawn}" d="{data}" fill="none" stroke="none"/><text font-size="{size}" dy="{:.2}"><textPath xlink:href="#street-{drawn}" startOffset="50%">{}</textPath></text>"##,
                size * 0.35,
                escaped(name)
            )?;
            drawn += 1;
        }
    }
    writeln!(f, "</g>")
}

/// The middle of a chain, as long as a text of a size needs, from left to right; `None` if it is too short or too bent.
fn stretch(page: &Page, chain: &Chain, length: f64, size: f64) -> Option<Vec<(f64, f64)>> {
    let whole = chain.length * page.scale;
    if whole < length {
        return None;
    }
    let (from, to) = ((whole - length) * 0.5 / page.scale, (whole + length) * 0.5 / page.scale);
    let part = simworld_core::net::polyline::slice(&chain.line, from, to);
    if is_bent(&part, BEND_REACH * size / page.scale) {
        return None;
    }
    let mut line: Vec<(f64, f64)> = part.iter().map(|point| page.place(point)).collect();
    if line.last()?.0 < line.first()?.0 {
        line.reverse();
    }
    // Letters must not run past the end of their line.
    extend(&mut line, 2.0);
    Some(line)
}

/// Lengthens the first and the last piece of a line by so much.
fn extend(line: &mut [(f64, f64)], by: f64) {
    let further = |a: (f64, f64), b: (f64, f64)| {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let length = (dx * dx + dy * dy).sqrt().max(1e-9);
        (b.0 + dx / length * by, b.1 + dy / length * by)
    };
    if let [first, second, ..] = line {
        *first = further(*second, *first);
    }
    if let [.., before, last] = line {
        *last = further(*before, *last);
    }
}

/// Whether a line turns too much for letters somewhere within a reach, m: at one point, or little by little.
fn is_bent(line: &[Point2], reach: f64) -> bool {
    let pieces: Vec<Vector2> = line.windows(2).map(|ends| ends[1] - ends[0]).collect();
    let turns = |a: &Vector2, b: &Vector2| a.dot(b) < BEND_COSINE * a.norm() * b.norm();
    pieces.iter().enumerate().any(|(index, piece)| {
        let mut between = 0.0;
        pieces[index + 1..]
            .iter()
            .take_while(|next| {
                let is_within = between < reach;
                between += next.norm();
                is_within
            })
            .any(|next| turns(piece, next))
    })
}

/// Squares along a line of text, about as high as the letters.
fn boxes_along(line: &[(f64, f64)], size: f64) -> Vec<Frame> {
    let mut frames = Vec::new();
    for pair in line.windows(2) {
        let (dx, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        let steps = ((dx * dx + dy * dy).sqrt() / size).ceil().max(1.0) as usize;
        for step in 0..=steps {
            let share = step as f64 / steps as f64;
            let (x, y) = (pair[0].0 + dx * share, pair[0].1 + dy * share);
            frames.push(Frame {
                x: x - size * 0.6,
                y: y - size * 0.6,
                width: size * 1.2,
                height: size * 1.2,
            });
        }
    }
    frames
}

/// A dot with a label beside it.
pub(super) fn flag(
    f: &mut fmt::Formatter<'_>,
    page: &Page,
    point: &Point2,
    color: &str,
    label: &str,
) -> fmt::Result {
    let (x, y) = page.place(point);
    writeln!(
        f,
        r#"<circle cx="{x:.2}" cy="{y:.2}" r="1.5" fill="{color}" stroke="{PAPER}" stroke-width="0.4"/><text x="{:.2}" y="{:.2}" font-size="3.2" fill="{INK}" stroke="{PAPER}" stroke-width="0.8" paint-order="stroke">{}</text>"#,
        x + 2.2,
        y - 1.2,
        escaped(label)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter of a circle of a radius, m, in as many pieces.
    fn quarter(radius: f64, pieces: u32) -> Vec<Point2> {
        let angle = |piece: u32| std::f64::consts::FRAC_PI_2 * f64::from(piece) / f64::from(pieces);
        (0..=pieces)
            .map(|piece| {
                let (sine, cosine) = simworld_core::ops::sin_cos(angle(piece));
                Point2::new(radius * cosine, radius * sine)
            })
            .collect()
    }

    #[test]
    fn a_tight_bend_is_one_however_finely_it_is_drawn() {
        for pieces in [2, 3, 10, 100] {
            assert!(is_bent(&quarter(20.0, pieces), 20.0), "{pieces} pieces");
        }
        assert!(!is_bent(&quarter(100.0, 10), 20.0), "a wide one bears letters");
        assert!(!is_bent(&quarter(100.0, 100), 20.0));
        assert!(!is_bent(&[Point2::origin(), Point2::new(50.0, 0.0), Point2::new(90.0, 5.0)], 20.0));
    }
}
