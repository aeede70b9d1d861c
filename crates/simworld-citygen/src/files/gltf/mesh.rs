//! Triangles: prisms, plates and ribbons, in metres, z up, about the middle of the city.

use std::borrow::Cow;

use earcut::Earcut;
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::id::RoadId;
use simworld_core::net::{RoadNetwork, polyline};

use crate::terrain::Ground;

/// Triangles of one material, counter-clockwise seen from outside.
#[derive(Clone, Debug, Default)]
pub(super) struct Mesh {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) indices: Vec<u32>,
}

/// What heights are measured from.
#[derive(Clone, Copy, Debug)]
pub(super) enum Base {
    /// The ground below each point.
    Ground,
    /// A height above the ground level of the world, m: that of a floor, or of a junction.
    Level(f64),
    /// The carriageway of a bridge beside each point.
    Deck(RoadId),
}

/// Adds shapes to meshes; keeps what the triangulation needs between shapes.
pub(super) struct Builder<'a> {
    origin: Point2,
    network: &'a RoadNetwork,
    ground: &'a Ground<'a>,
    base: Base,
    earcut: Earcut<f64>,
    corners: Vec<[f64; 2]>,
    triangles: Vec<u32>,
}

impl Mesh {
    fn quad(&mut self, a: u32, b: u32, c: u32, d: u32) {
        self.indices.extend([a, b, c, a, c, d]);
    }
}

impl<'a> Builder<'a> {
    pub(super) fn at(origin: Point2, network: &'a RoadNetwork, ground: &'a Ground<'a>) -> Self {
        let (corners, triangles) = (Vec::new(), Vec::new());
        Self { origin, network, ground, base: Base::Ground, earcut: Earcut::new(), corners, triangles }
    }

    /// Measures the heights of what comes from there.
    pub(super) fn stand_on(&mut self, base: Base) {
        self.base = base;
    }

    /// What lies beside the lanes of a road, or on them, stands on this.
    pub(super) fn stand_on_road(&mut self, road: RoadId) {
        let is_deck = self.network.roads[road.index()].level > 0;
        self.base = if is_deck { Base::Deck(road) } else { Base::Ground };
    }

    /// The ground of the city.
    pub(super) const fn ground(&self) -> &'a Ground<'a> {
        self.ground
    }

    fn vertex(&self, mesh: &mut Mesh, point: Point2, z: f64) -> u32 {
        let base = match self.base {
            Base::Ground => self.ground.height(point),
            Base::Level(height) => height,
            Base::Deck(road) => {
                let line = &self.network.roads[road.index()].centerline;
                let station = polyline::closest(line, &point).map_or(0.0, |near| near.station);
                self.network.height(road, station)
            }
        };
        let local = point - self.origin;
        mesh.positions.push([local.x as f32, local.y as f32, (z + base) as f32]);
        (mesh.positions.len() - 1) as u32
    }

    /// The line with points so near that it bends with a deck.
    fn bent<'l>(&self, line: &'l [Point2]) -> Cow<'l, [Point2]> {
        /// Greatest distance of two points on a deck, m.
        const NEAR: f64 = 2.0;
        if !matches!(self.base, Base::Deck(_)) || line.is_empty() {
            return Cow::Borrowed(line);
        }
        let mut bent = vec![line[0]];
        for pair in line.windows(2) {
            let count = ((pair[1] - pair[0]).norm() / NEAR).ceil().max(1.0);
            bent.extend(
                (1..=count as u32).map(|part| pair[0] + (pair[1] - pair[0]) * (f64::from(part) / count)),
            );
        }
        Cow::Owned(bent)
    }

    /// A level polygon that looks up, counter-clockwise or not, perhaps with a hole.
    pub(super) fn plate(&mut self, mesh: &mut Mesh, outline: &[Point2], holes: &[Vec<Point2>], z: f64) {
        self.corners.clear();
        // About the origin, where the triangulation keeps the most digits.
        let corners = outline.iter().chain(holes.iter().flatten());
        self.corners.extend(corners.map(|point| [point.x - self.origin.x, point.y - self.origin.y]));
        let mut start = outline.len() as u32;
        let mut starts = Vec::with_capacity(holes.len());
        for hole in holes {
            starts.push(start);
            start += hole.len() as u32;
        }
        self.earcut.earcut_slice(&self.corners, &starts, &mut self.triangles);
        let first = mesh.positions.len() as u32;
        for point in outline.iter().chain(holes.iter().flatten()) {
            self.vertex(mesh, *point, z);
        }
        for triangle in self.triangles.chunks_exact(3) {
            let [a, b, c] = [triangle[0], triangle[1], triangle[2]];
            let corner = |index: u32| Point2::from(self.corners[index as usize]);
            let up = (corner(b) - corner(a)).perp(&(corner(c) - corner(a))) > 0.0;
            let (b, c) = if up { (b, c) } else { (c, b) };
            mesh.indices.extend([first + a, first + b, first + c]);
        }
    }

    /// The upright faces round a counter-clockwise polygon, looking outwards, from one height to another; round a
    /// clockwise one, as that of a courtyard, they look inwards.
    pub(super) fn walls(&mut self, mesh: &mut Mesh, outline: &[Point2], low: f64, high: f64) {
        let first = mesh.positions.len() as u32;
        for point in outline {
            self.vertex(mesh, *point, low);
            self.vertex(mesh, *point, high);
        }
        let count = outline.len() as u32;
        for index in 0..count {
            let (a, b) = (first + 2 * index, first + 2 * ((index + 1) % count));
            mesh.quad(a, b, b + 1, a + 1);
        }
    }

    /// Walls and a lid.
    pub(super) fn prism(&mut self, mesh: &mut Mesh, outline: &[Point2], low: f64, high: f64) {
        self.walls(mesh, outline, low, high);
        self.plate(mesh, outline, &[], high);
    }

    /// A single face, counter-clockwise seen from outside.
    pub(super) fn face(&mut self, mesh: &mut Mesh, corners: &[(Point2, f64)]) {
        let first = mesh.positions.len() as u32;
        for (point, z) in corners {
            self.vertex(mesh, *point, *z);
        }
        for index in 2..corners.len() as u32 {
            mesh.indices.extend([first, first + index - 1, first + index]);
        }
    }

    /// An upright prism on a regular polygon about a point.
    pub(super) fn column(&mut self, mesh: &mut Mesh, at: Point2, radius: f64, heights: (f64, f64)) {
        self.prism(mesh, &hexagon(at, radius), heights.0, heights.1);
    }

    /// Two pyramids base to base: the crown of a tree.
    pub(super) fn crown(&mut self, mesh: &mut Mesh, at: Point2, radius: f64, (low, high): (f64, f64)) {
        let waist = low + (high - low) * 0.4;
        let first = mesh.positions.len() as u32;
        for corner in hexagon(at, radius) {
            self.vertex(mesh, corner, waist);
        }
        let (top, bottom) = (self.vertex(mesh, at, high), self.vertex(mesh, at, low));
        for index in 0..6 {
            let (a, b) = (first + index, first + (index + 1) % 6);
            mesh.indices.extend([a, b, top, b, a, bottom]);
        }
    }

    /// A level band along a line, so far to its left and so far to its right, m.
    pub(super) fn ribbon(&mut self, mesh: &mut Mesh, line: &[Point2], (left, right): (f64, f64), z: f64) {
        if line.len() < 2 {
            return;
        }
        let line = &*self.bent(line);
        let (left, mut right) = (polyline::offset(line, left), polyline::offset(line, -right));
        if left.len() != right.len() {
            // In a bend too tight for it an edge has fewer points than the line.
            right.extend(left.into_iter().rev());
            return self.plate(mesh, &right, &[], z);
        }
        let first = mesh.positions.len() as u32;
        for (left, right) in left.iter().zip(&right) {
            self.vertex(mesh, *right, z);
            self.vertex(mesh, *left, z);
        }
        for index in 0..left.len() as u32 - 1 {
            let at = first + 2 * index;
            mesh.quad(at, at + 2, at + 3, at + 1);
        }
    }

    /// A band that stands out of the ground: a level top with both of its edges.
    pub(super) fn kerb(&mut self, mesh: &mut Mesh, line: &[Point2], width: f64, (low, high): (f64, f64)) {
        if line.len() < 2 {
            return;
        }
        let line = &*self.bent(line);
        let half = width * 0.5;
        self.ribbon(mesh, line, (half, half), high);
        for (side, looks_left) in [(half, true), (-half, false)] {
            let first = mesh.positions.len() as u32;
            let edge = polyline::offset(line, side);
            for point in &edge {
                self.vertex(mesh, *point, low);
                self.vertex(mesh, *point, high);
            }
            for index in 0..edge.len() as u32 - 1 {
                let (a, b) = (first + 2 * index, first + 2 * index + 2);
                if looks_left { mesh.quad(b, a, a + 1, b + 1) } else { mesh.quad(a, b, b + 1, a + 1) }
            }
        }
    }

    /// A rectangle across a line: a stripe of paint.
    pub(super) fn stripe(&mut self, mesh: &mut Mesh, from: Point2, to: Point2, width: f64, z: f64) {
        self.ribbon(mesh, &[from, to], (width * 0.5, width * 0.5), z);
    }
}

/// Six corners about a point, counter-clockwise.
fn hexagon(at: Point2, radius: f64) -> [Point2; 6] {
    let (half, height) = (0.5, 0.75_f64.sqrt());
    [(1.0, 0.0), (half, height), (-half, height), (-1.0, 0.0), (-half, -height), (half, -height)]
        .map(|(x, y)| at + Vector2::new(x, y) * radius)
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::*;
    use crate::terrain::{Terrain, TerrainConfig};

    /// What a builder on level ground makes.
    fn built(build: impl FnOnce(&mut Builder<'_>, &mut Mesh)) -> Mesh {
        let (network, land) = (RoadNetwork::default(), Terrain::new(&TerrainConfig::default(), Seed(0)));
        let ground = Ground::new(&network, &land);
        let mut mesh = Mesh::default();
        build(&mut Builder::at(Point2::origin(), &network, &ground), &mut mesh);
        mesh
    }

    fn volume(mesh: &Mesh) -> f64 {
        mesh.indices
            .chunks_exact(3)
            .map(|t| {
                let [a, b, c] = [t[0], t[1], t[2]].map(|i| mesh.positions[i as usize].map(f64::from));
                let cross = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
                (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]) / 6.0
            })
            .sum()
    }

    #[test]
    fn faces_look_outwards() {
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 3.0), (0.0, 3.0)].map(|(x, y)| Point2::new(x, y));
        // From the ground plane up, the open bottom adds nothing to the volume.
        let mesh = built(|builder, mesh| builder.prism(mesh, &square, 0.0, 4.0));
        assert!((volume(&mesh) - 24.0).abs() < 1e-4);
        let mesh = built(|builder, mesh| builder.crown(mesh, Point2::new(5.0, 5.0), 1.0, (2.0, 5.0)));
        let hexagon = 1.5 * 3f64.sqrt();
        assert!((volume(&mesh) - hexagon * 3.0 / 3.0).abs() < 1e-4);
    }

    #[test]
    fn a_kerb_closes_on_both_sides() {
        let line = [Point2::new(0.0, 0.0), Point2::new(10.0, 0.0)];
        let mesh = built(|builder, mesh| builder.kerb(mesh, &line, 2.0, (0.0, 0.5)));
        // All but the two ends, which are 1 m² each and reach 10 m from the origin at the far one.
        assert!((volume(&mesh) - (10.0 - 10.0 / 3.0)).abs() < 1e-4, "{}", volume(&mesh));
    }
}
