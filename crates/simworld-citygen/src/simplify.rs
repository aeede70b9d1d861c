//! Lines without the points that say nothing.

use simworld_core::geometry::Point2;
use simworld_core::net::polyline;

/// A line without the points that lie within a tolerance of what remains (Douglas and Peucker 1973); its ends stay.
pub(crate) fn simplified(line: &[Point2], tolerance: f64) -> Vec<Point2> {
    /// Points that are looked at together: the work on hostile lines grows with the square of it.
    const CHUNK: usize = 1000;
    let mut keeps = vec![false; line.len()];
    let Some(last) = line.len().checked_sub(1) else { return Vec::new() };
    let mut pending: Vec<(usize, usize)> =
        (0..last).step_by(CHUNK).map(|first| (first, (first + CHUNK).min(last))).collect();
    while let Some((first, last)) = pending.pop() {
        keeps[first] = true;
        keeps[last] = true;
        let chord = [line[first], line[last]];
        let away = |index: usize| polyline::closest(&chord, &line[index]).map_or(0.0, |near| near.distance);
        let farthest = (first + 1..last).map(|index| (away(index), index)).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, index)) = farthest.filter(|(distance, _)| *distance > tolerance) {
            pending.extend([(first, index), (index, last)]);
        }
    }
    line.iter().zip(keeps).filter(|(_, keeps)| *keeps).map(|(point, _)| *point).collect()
}
