//! The time-space diagram of a street: a line a vehicle, and the reds across which none should lead.

use simworld_core::net::Aspect;

use super::Street;
use super::axes::Axes;
use super::sheet::{Anchor, FAINT, Frame, Sheet};
use crate::Traffic;

/// Width and height of the sheet, mm.
const SHEET: (f64, f64) = (297.0, 210.0);
/// Places are kept so often, s.
const EVERY: f64 = 0.5;

/// A piece of the way of one vehicle along the street.
type Line = Vec<(f64, f64)>;

/// What a street saw over some time.
#[derive(Clone, Debug)]
pub struct Trajectories {
    street: Street,
    /// Time of the first look, s.
    from: f64,
    until: f64,
    next: f64,
    /// Of each vehicle, the line that is being drawn.
    open: Vec<Line>,
    lines: Vec<Line>,
    /// Of each signal of the street: when it was not green.
    reds: Vec<Vec<(f64, f64)>>,
}

impl Trajectories {
    /// Nothing yet, of a street.
    pub fn new(street: Street) -> Self {
        let reds = vec![Vec::new(); street.signals.len()];
        Self { street, from: f64::NAN, until: 0.0, next: 0.0, open: Vec::new(), lines: Vec::new(), reds }
    }

    /// The street.
    pub fn street(&self) -> &Street {
        &self.street
    }

    /// Looks at the traffic after a step.
    pub fn look(&mut self, traffic: &Traffic) {
        let now = traffic.seconds();
        if self.from.is_nan() {
            (self.from, self.next) = (now, now);
        }
        if now + 1e-6 < self.next {
            return;
        }
        self.next += EVERY;
        self.until = now;
        for ((_, group), reds) in self.street.signals.iter().zip(&mut self.reds) {
            if traffic.signals().get(group.index()).is_none_or(|aspect| *aspect != Aspect::Red) {
                continue;
            }
            match reds.last_mut().filter(|red| now - red.1 < 1.5 * EVERY) {
                Some(red) => red.1 = now,
                None => reds.push((now, now)),
            }
        }
        for (id, track, s, _) in traffic.stations() {
            let index = id as usize;
            if self.open.len() <= index {
                self.open.resize_with(index + 1, Line::new);
            }
            let open = &mut self.open[index];
            let place = self.street.station(track, s);
            let goes_on = |place: f64| {
                open.last().is_none_or(|last| now - last.0 < 1.5 * EVERY && place >= last.1 - 3.0)
            };
            match place.filter(|place| goes_on(*place)) {
                Some(place) => open.push((now, place)),
                None if open.is_empty() => {}
                None => {
                    self.lines.push(std::mem::take(open));
                    self.open[index].extend(place.map(|place| (now, place)));
                }
            }
        }
    }
}

/// The diagram as an SVG text: time to the right, the way along the street upwards, reds as bars, vehicles by their speed.
pub fn time_space_diagram(seen: &Trajectories, title: &str) -> String {
    let street = &seen.street;
    let name = street.name.as_deref().unwrap_or("a street");
    let subtitle = format!(
        "{name}, {:.0} m, {} signals, one direction; each line is a vehicle, bars are red",
        street.length(),
        street.signals.len()
    );
    let mut sheet = Sheet::new(SHEET, title, &subtitle);
    let frame = Frame { x: 32.0, y: 32.0, width: 250.0, height: 158.0 };
    let axes = Axes::new(frame, (0.0, seen.until - seen.from), (0.0, street.length()));
    axes.draw(&mut sheet, "time, s", "way along the street, m");
    sheet.begin_clip("diagram", frame);
    for line in seen.lines.iter().chain(&seen.open) {
        draw_line(&mut sheet, &axes, seen.from, line);
    }
    for ((station, _), reds) in street.signals.iter().zip(&seen.reds) {
        for (begin, end) in reds {
            let points =
                [axes.place(begin - seen.from, *station), axes.place(end + EVERY - seen.from, *station)];
            sheet.line(points, "#b3261e", 1.1);
        }
    }
    sheet.end_group();
    sheet.label(
        (frame.right(), frame.y - 2.0),
        3.0,
        Anchor::End,
        FAINT,
        "dark: moving, red: slower than 2 m/s",
    );
    sheet.finish()
}

/// Draws a vehicle, in pieces by whether it crawls.
fn draw_line(sheet: &mut Sheet, axes: &Axes, from: f64, line: &Line) {
    let crawls = |pair: &[(f64, f64)]| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0).max(1e-6) < 2.0;
    let pairs: Vec<bool> = line.windows(2).map(crawls).collect();
    let mut begin = 0;
    for end in 1..=pairs.len() {
        if end < pairs.len() && pairs[end] == pairs[begin] {
            continue;
        }
        let points = line[begin..=end].iter().map(|(time, place)| axes.place(time - from, *place));
        let (ink, width) = if pairs[begin] { ("#c8553d", 0.4) } else { ("#2f4858", 0.28) };
        sheet.line(points, ink, width);
        begin = end;
    }
}
