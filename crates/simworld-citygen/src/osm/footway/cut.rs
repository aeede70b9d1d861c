//! Lines cut where they are closed.

use simworld_core::geometry::Point2;

use crate::simplify::simplified;

/// Pieces in which a line is tested, m; those of long straight stretches are longer, so that they are no more than `MOST`.
const STEP: f64 = 2.0;
const MOST: f64 = 1000.0;
/// Where a line is cut is found by so many halvings of a piece: a centimetre.
const HALVINGS: u32 = 8;
/// How far the points that were added for the test may lie from the line without them, m.
const TOLERANCE: f64 = 0.02;

/// An open part of a line.
#[derive(Debug, PartialEq)]
pub(super) struct Run {
    pub(super) path: Vec<Point2>,
    /// Whether it was cut off at its beginning and at its end.
    pub(super) cut: [bool; 2],
}

/// The places of a line, so near to each other as it is tested.
pub(super) fn places(line: &[Point2]) -> Vec<Point2> {
    let mut places: Vec<Point2> = line.first().copied().into_iter().collect();
    for pair in line.windows(2) {
        let piece = pair[1] - pair[0];
        let count = (piece.norm() / STEP).ceil().clamp(1.0, MOST) as u32;
        // The end itself, to the bit.
        places.extend((1..count).map(|index| pair[0] + piece * (f64::from(index) / f64::from(count))));
        places.push(pair[1]);
    }
    places
}

/// The parts of a line that are open, by a test of straight pieces.
pub(super) fn open_runs(line: &[Point2], is_open: impl Fn(Point2, Point2) -> bool) -> Vec<Run> {
    // From an open piece into the closed one beside it, as far as that is open.
    let reach = |from: Point2, to: Point2| {
        let (mut open, mut closed) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = (open + closed) * 0.5;
            *(if is_open(from, from + (to - from) * middle) { &mut open } else { &mut closed }) = middle;
        }
        from + (to - from) * open
    };
    let places = places(line);
    let (mut runs, mut run): (Vec<Run>, Option<Run>) = (Vec::new(), None);
    for (index, pair) in places.windows(2).enumerate() {
        let (from, to) = (pair[0], pair[1]);
        if !is_open(from, to) {
            if let Some(mut ended) = run.take() {
                ended.path.push(reach(from, to));
                ended.cut[1] = true;
                runs.push(ended);
            }
        } else if let Some(run) = &mut run {
            run.path.push(to);
        } else if index == 0 {
            run = Some(Run { path: vec![from, to], cut: [false; 2] });
        } else {
            run = Some(Run { path: vec![reach(from, places[index - 1]), from, to], cut: [true, false] });
        }
    }
    runs.extend(run);
    for run in &mut runs {
        run.path.dedup();
        run.path = simplified(&run.path, TOLERANCE);
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[(f64, f64)]) -> Vec<Point2> {
        points.iter().map(|(x, y)| Point2::new(*x, *y)).collect()
    }

    /// Closed between two values of x.
    fn closed(from: f64, to: f64) -> impl Fn(Point2, Point2) -> bool {
        move |a, b| a.x.max(b.x) <= from || a.x.min(b.x) >= to
    }

    #[test]
    fn an_open_line_stays_as_it_is() {
        let bent = line(&[(0.0, 0.0), (31.0, 0.0), (31.0, 8.0)]);
        let runs = open_runs(&bent, |_, _| true);
        assert_eq!(runs, [Run { path: bent, cut: [false; 2] }]);
        assert!(open_runs(&line(&[(0.0, 0.0), (31.0, 0.0)]), |_, _| false).is_empty());
    }

    #[test]
    fn a_line_is_cut_where_it_is_closed() {
        let runs = open_runs(&line(&[(0.0, 0.0), (50.0, 0.0)]), closed(20.3, 27.9));
        let [before, after] = runs.as_slice() else { panic!("{runs:?}") };
        assert_eq!((before.cut, after.cut), ([false, true], [true, false]));
        assert_eq!((before.path[0].x, after.path[1].x), (0.0, 50.0));
        let (end, start) = (before.path[1].x, after.path[0].x);
        assert!((20.29..=20.3).contains(&end) && (27.9..=27.91).contains(&start), "{end} {start}");
        // What is narrower than a piece closes it all the same.
        let runs = open_runs(&line(&[(0.0, 0.0), (50.0, 0.0)]), closed(20.5, 20.6));
        assert_eq!(runs.len(), 2, "{runs:?}");
    }
}
