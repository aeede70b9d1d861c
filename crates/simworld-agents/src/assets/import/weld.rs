//! Points that lie together become one site: files give a point once for each normal and colour it has.

use std::collections::BTreeMap;

use simworld_core::geometry::Point3;

/// The sites of points.
pub(super) struct Sites {
    /// Where each point stands.
    pub(super) of: Vec<u32>,
    /// Where they are.
    pub(super) points: Vec<Point3>,
}

/// Points that lie within a distance of a site stand on it; the first point of a site says where it is.
pub(super) fn weld(points: &[Point3], within: f64) -> Sites {
    let exact = same(points);
    // Nearer than that, numbers of the file's own precision are the same or not.
    if within < 1e-30 {
        return exact;
    }
    let Some(low) = exact.points.iter().copied().reduce(|a, b| a.inf(&b)) else { return exact };
    let cell = |point: &Point3| -> [i64; 3] {
        let place = (point - low) / within;
        // Far below the ends of the range, so that neighbours can be counted.
        [place.x, place.y, place.z].map(|number| number.min(1e15) as i64)
    };
    let mut cells: BTreeMap<[i64; 3], Vec<u32>> = BTreeMap::new();
    let mut sites = Vec::new();
    let merged: Vec<u32> = exact
        .points
        .iter()
        .map(|point| {
            let [x, y, z] = cell(point);
            let near = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [x + dx, y + dy])).find_map(|[x, y]| {
                let column = cells.range([x, y, z - 1]..=[x, y, z + 1]).flat_map(|(_, sites)| sites);
                column.copied().find(|site| nalgebra::distance(&sites[*site as usize], point) <= within)
            });
            near.unwrap_or_else(|| {
                let site = sites.len() as u32;
                sites.push(*point);
                cells.entry([x, y, z]).or_default().push(site);
                site
            })
        })
        .collect();
    Sites { of: exact.of.iter().map(|site| merged[*site as usize]).collect(), points: sites }
}

/// Points at exactly the same place, numbered in the order of their first.
fn same(points: &[Point3]) -> Sites {
    // Adding zero makes -0 and 0 one place.
    let key = |point: usize| points[point].coords.map(|number| number + 0.0);
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_unstable_by(|a, b| {
        let (left, right) = (key(*a as usize), key(*b as usize));
        let by_axis = |axis: usize| left[axis].total_cmp(&right[axis]);
        by_axis(0).then(by_axis(1)).then(by_axis(2)).then(a.cmp(b))
    });
    let mut first = vec![0; points.len()];
    for run in order.chunk_by(|a, b| key(*a as usize) == key(*b as usize)) {
        for point in run {
            first[*point as usize] = run[0];
        }
    }
    let mut number = vec![0; points.len()];
    let mut sites = Vec::new();
    let of = first
        .iter()
        .enumerate()
        .map(|(point, first)| {
            if *first as usize == point {
                number[point] = sites.len() as u32;
                sites.push(points[point]);
            }
            number[*first as usize]
        })
        .collect();
    Sites { of, points: sites }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_together_is_one_site() {
        let at = |x, y| Point3::new(x, y, 0.0);
        let points = [
            at(0.0, 0.0),
            at(1.0, 0.0),
            at(-0.0, 0.0),
            at(1.0 + 1e-6, 0.0),
            at(1.0 - 1e-6, 1e-6),
            at(1.1, 0.0),
        ];
        let sites = weld(&points, 1e-5);
        assert_eq!(sites.of, [0, 1, 0, 1, 1, 2]);
        assert_eq!(sites.points, [points[0], points[1], points[5]]);
    }
}
