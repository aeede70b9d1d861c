//! A sidewalk as a frame of reference: stations along its middle, offsets away from its road.

use simworld_core::geometry::{Point2, Vector2, heading};
use simworld_core::net::{Side, Sidewalk};
use simworld_core::ops;

/// One sidewalk; it is set anew for the next, so that nothing is allocated for each.
#[derive(Clone, Debug, Default)]
pub(super) struct Walk {
    pieces: Vec<Piece>,
    pub(super) length: f64,
    /// Half its width, m.
    pub(super) half: f64,
}

#[derive(Clone, Copy, Debug)]
struct Piece {
    start: Point2,
    station: f64,
    length: f64,
    along: Vector2,
    /// Away from the road.
    out: Vector2,
    /// Towards the road, radians; known once something stands there, as along few pieces of a bend.
    facing: Option<f64>,
}

impl Walk {
    pub(super) fn set(&mut self, sidewalk: &Sidewalk) {
        self.pieces.clear();
        self.length = 0.0;
        self.half = sidewalk.width * 0.5;
        let sign = if sidewalk.side == Side::Left { 1.0 } else { -1.0 };
        for pair in sidewalk.path.windows(2) {
            let step = pair[1] - pair[0];
            let length = step.norm();
            if length < 1e-6 {
                continue;
            }
            let along = step / length;
            let out = Vector2::new(-along.y, along.x) * sign;
            let (start, station) = (pair[0], self.length);
            self.pieces.push(Piece { start, station, length, along, out, facing: None });
            self.length += length;
        }
    }

    /// The piece at a station; `None` without a path.
    fn piece(&self, station: f64) -> Option<usize> {
        let next = self.pieces.partition_point(|piece| piece.station <= station).saturating_sub(1);
        (next < self.pieces.len()).then_some(next)
    }

    /// The place at a station, so far away from the road beyond the middle; `None` without a path.
    pub(super) fn place(&self, station: f64, offset: f64) -> Option<Point2> {
        self.piece(station).map(|piece| self.pieces[piece].place(station, offset))
    }

    /// The same, and the direction towards the road.
    pub(super) fn at(&mut self, station: f64, offset: f64) -> Option<(Point2, f64)> {
        let index = self.piece(station)?;
        let piece = &mut self.pieces[index];
        let facing = *piece.facing.get_or_insert_with(|| heading(&-piece.out));
        Some((piece.place(station, offset), facing))
    }

    /// The station nearest to a point.
    pub(super) fn station_of(&self, point: Point2) -> f64 {
        let mut best = (f64::INFINITY, 0.0);
        for piece in &self.pieces {
            let station = (point - piece.start).dot(&piece.along).clamp(0.0, piece.length);
            let distance = (point - piece.start - piece.along * station).norm_squared();
            if distance < best.0 {
                best = (distance, piece.station + station);
            }
        }
        best.1
    }

    /// Whether the path bends between two stations, so that a long thing would not stand straight.
    pub(super) fn bends(&self, from: f64, to: f64) -> bool {
        let piece = |station: f64| self.pieces.partition_point(|piece| piece.station <= station);
        piece(from) != piece(to)
    }
}

impl Piece {
    /// The place at a station of its walk, so far away from the road.
    fn place(&self, station: f64, offset: f64) -> Point2 {
        self.start + self.along * (station - self.station) + self.out * offset
    }
}

/// The direction of somebody who looks along a sidewalk, its road on the left, who before looked towards the road.
pub(super) fn turned(facing: f64, by: f64) -> f64 {
    ops::wrap_angle(facing + by)
}
