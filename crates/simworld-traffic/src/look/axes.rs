//! Axes: from values to millimetres, with ticks at round numbers.

use super::sheet::{Anchor, FAINT, Frame, INK, RULE, Sheet};

/// Two axes around a frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axes {
    pub(super) frame: Frame,
    x: (f64, f64),
    y: (f64, f64),
}

impl Axes {
    /// Axes over two ranges; an empty range is widened.
    pub(super) fn new(frame: Frame, x: (f64, f64), y: (f64, f64)) -> Self {
        let wide = |(low, high): (f64, f64)| (low, if high > low { high } else { low + 1.0 });
        Self { frame, x: wide(x), y: wide(y) }
    }

    pub(super) fn place(&self, x: f64, y: f64) -> (f64, f64) {
        let Frame { x: left, width, height, .. } = self.frame;
        let share = |value: f64, (low, high): (f64, f64)| (value - low) / (high - low);
        (left + width * share(x, self.x), self.frame.bottom() - height * share(y, self.y))
    }

    /// Draws the ground with its rules, the ticks and what the axes are.
    pub(super) fn draw(&self, sheet: &mut Sheet, across: &str, upwards: &str) {
        let Frame { x, y, width, height } = self.frame;
        sheet.rect(self.frame, "#fffdf8");
        for tick in ticks(self.x) {
            let (at, _) = self.place(tick, self.y.0);
            sheet.line([(at, y), (at, y + height)], RULE, 0.2);
            sheet.label((at, y + height + 4.6), 3.2, Anchor::Middle, FAINT, &number(tick));
        }
        for tick in ticks(self.y) {
            let (_, at) = self.place(self.x.0, tick);
            sheet.line([(x, at), (x + width, at)], RULE, 0.2);
            sheet.label((x - 1.8, at + 1.1), 3.2, Anchor::End, FAINT, &number(tick));
        }
        sheet.line([(x, y), (x, y + height), (x + width, y + height)], INK, 0.35);
        sheet.label((x + width * 0.5, y + height + 10.5), 3.6, Anchor::Middle, INK, across);
        sheet.label_upwards((x - 13.5, y + height * 0.5), 3.6, upwards);
    }
}

/// Round numbers in a range, about eight of them.
fn ticks((low, high): (f64, f64)) -> Vec<f64> {
    let rough = (high - low) / 7.0;
    let mut unit = 1e-6;
    while unit * 10.0 <= rough {
        unit *= 10.0;
    }
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|times| times * unit).find(|step| *step >= rough);
    let step = step.unwrap_or(rough.max(1e-9));
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    (first..=last).map(|index| index as f64 * step).collect()
}

/// A tick in words.
fn number(value: f64) -> String {
    if value.abs() >= 1.0 || value == 0.0 {
        format!("{}", (value * 10.0).round() / 10.0)
    } else {
        format!("{value:.2}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_in_range() {
        assert_eq!(ticks((0.0, 100.0)), [0.0, 20.0, 40.0, 60.0, 80.0, 100.0]);
        for high in [0.3, 7.0, 153.8, 2000.0, 3600.0] {
            let ticks = ticks((0.0, high));
            assert!((4..=9).contains(&ticks.len()), "{high}: {ticks:?}");
            assert!(ticks.iter().all(|tick| (0.0..=high * 1.001).contains(tick)));
        }
    }
}
