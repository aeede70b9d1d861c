//! Surfaces made sound: what has no area is dropped, cracks are closed, and all triangles look to the same side.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use super::weld::weld;
use crate::assets::surface::Surface;

/// What was found on a surface, and what was done about it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Repair {
    /// Triangles without area, dropped.
    pub flat: usize,
    /// Triangles that were there twice, dropped once.
    pub doubled: usize,
    /// Triangles turned over, so that neighbours look to the same side and a closed surface outward.
    pub turned: usize,
    /// Edges of what is left.
    pub edges: usize,
    /// Edges of one triangle alone: the surface is open there.
    pub open: usize,
    /// Edges between more than two triangles, or between two that cannot look to the same side.
    pub tangled: usize,
}

impl Repair {
    /// Whether each edge lies between two triangles: the surface has an inside.
    pub fn is_closed(&self) -> bool {
        self.open == 0 && self.tangled == 0
    }
}

/// Makes a surface sound, with points that lie within a share of its diagonal taken for one. What is left may have no
/// triangle.
pub(super) fn repair(surface: &mut Surface, weld_share: f64) -> Repair {
    let mut report = Repair::default();
    let Some([low, high]) = surface.bounds() else { return report };
    let diagonal = (high - low).norm();
    let sites = weld(&surface.points, diagonal * weld_share);
    // Whatever stands on a site stands exactly there, so that no light shines through a crack.
    for (point, site) in surface.points.iter_mut().zip(&sites.of) {
        *point = sites.points[*site as usize];
    }
    let faces: Vec<[u32; 3]> =
        surface.triangles.iter().map(|triangle| triangle.map(|point| sites.of[point as usize])).collect();
    let least = diagonal * diagonal * 1e-14;
    let has_area = |index: usize| {
        let [a, b, c] = faces[index];
        a != b && b != c && c != a && surface.cross(surface.triangles[index]).norm() > least
    };
    let mut kept: Vec<bool> = (0..faces.len()).map(has_area).collect();
    report.flat = kept.iter().filter(|kept| !**kept).count();
    let sheets = drop_doubles(&faces, &mut kept, &mut report);
    let turned = orient(&faces, |face| kept[face] && !sheets[face], &mut report);
    for triangle in turned {
        let [a, b, c] = surface.triangles[triangle];
        surface.triangles[triangle] = [a, c, b];
        report.turned += 1;
    }
    surface.retain(|index| kept[index]);
    report
}

/// Drops what is there twice. Says which triangles are one side of a sheet with two sides: these have no part in what is
/// open or closed.
fn drop_doubles(faces: &[[u32; 3]], kept: &mut [bool], report: &mut Repair) -> Vec<bool> {
    let key = |face: u32| {
        let corners = faces[face as usize];
        let mut sorted = corners;
        sorted.sort_unstable();
        let least = corners.iter().position(|corner| *corner == sorted[0]).unwrap_or(0);
        // Which way round: from the least corner on, the second one is the lower of the other two, or not.
        (sorted, corners[(least + 1) % 3] == sorted[1])
    };
    let mut order: Vec<u32> = (0..faces.len() as u32).filter(|face| kept[*face as usize]).collect();
    order.sort_unstable_by_key(|face| (key(*face), *face));
    let mut sheets = vec![false; faces.len()];
    for same in order.chunk_by(|a, b| key(*a).0 == key(*b).0) {
        let is_sheet = key(same[0]).1 != key(same[same.len() - 1]).1;
        for (index, face) in same.iter().enumerate() {
            sheets[*face as usize] = is_sheet;
            if index > 0 && key(same[index - 1]) == key(*face) {
                kept[*face as usize] = false;
                report.doubled += 1;
            }
        }
    }
    sheets
}

/// A triangle at an edge, and whether it runs from the edge's lower site to the higher.
#[derive(Clone, Copy)]
struct Side {
    edge: (u32, u32),
    face: u32,
    upward: bool,
}

/// Counts the edges, and gives the triangles to be turned over so that neighbours look to the same side: in each piece
/// that hangs together the fewer ones.
fn orient(faces: &[[u32; 3]], counts: impl Fn(usize) -> bool, report: &mut Repair) -> Vec<usize> {
    let mut sides = Vec::with_capacity(faces.len() * 3);
    for (index, face) in faces.iter().enumerate().filter(|(index, _)| counts(*index)) {
        for corner in 0..3 {
            let (a, b) = (face[corner], face[(corner + 1) % 3]);
            sides.push(Side { edge: (a.min(b), a.max(b)), face: index as u32, upward: a < b });
        }
    }
    sides.sort_unstable_by_key(|side| (side.edge, side.face));
    // Neighbours over sound edges, and whether both run along the edge the same way, which neighbours must not.
    let mut neighbours = vec![[(u32::MAX, false); 3]; faces.len()];
    let mut link = |face: u32, to: u32, same: bool| {
        let free = neighbours[face as usize].iter_mut().find(|(neighbour, _)| *neighbour == u32::MAX);
        if let Some(free) = free {
            *free = (to, same);
        }
    };
    for at_edge in sides.chunk_by(|a, b| a.edge == b.edge) {
        report.edges += 1;
        match at_edge {
            [_] => report.open += 1,
            [a, b] => {
                link(a.face, b.face, a.upward == b.upward);
                link(b.face, a.face, a.upward == b.upward);
            }
            _ => report.tangled += 1,
        }
    }
    let mut turns: Vec<Option<bool>> = vec![None; faces.len()];
    let mut turned = Vec::new();
    for start in (0..faces.len()).filter(|face| counts(*face)) {
        if turns[start].is_some() {
            continue;
        }
        let piece = spread(start, &neighbours, &mut turns, report);
        let over = piece.iter().filter(|face| turns[**face] == Some(true)).count();
        let fewer = over * 2 <= piece.len();
        turned.extend(piece.into_iter().filter(|face| turns[*face] == Some(fewer)));
    }
    turned
}

/// Goes from a triangle to all that hang together with it, and decides which of them look to its side.
fn spread(
    start: usize,
    neighbours: &[[(u32, bool); 3]],
    turns: &mut [Option<bool>],
    report: &mut Repair,
) -> Vec<usize> {
    turns[start] = Some(false);
    let mut piece = vec![start];
    let mut open = VecDeque::from([start]);
    let mut conflicts = 0;
    while let Some(face) = open.pop_front() {
        let turn = turns[face] == Some(true);
        for (next, same) in neighbours[face].iter().filter(|(next, _)| *next != u32::MAX) {
            let wanted = turn ^ same;
            match turns[*next as usize] {
                None => {
                    turns[*next as usize] = Some(wanted);
                    piece.push(*next as usize);
                    open.push_back(*next as usize);
                }
                Some(other) => conflicts += usize::from(other != wanted),
            }
        }
    }
    // Each such edge was met from both sides.
    report.tangled += conflicts / 2;
    piece
}
