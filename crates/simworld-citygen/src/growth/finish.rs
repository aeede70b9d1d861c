//! What is done once the streets stand: loose ends are attached, and dead ends of which there are too many are taken away.

use super::Growth;
use super::fitted::Start;
use super::proposal::Proposal;
use simworld_core::net::RoadClass;

impl Growth<'_> {
    /// Road-end attachment: a dead end that looks at something not too far away is joined to it, while there are more dead
    /// ends than the style has.
    pub(super) fn attach_loose_ends(&mut self) {
        /// A road turns by up to this to meet another, radians.
        const TURNS: [f64; 7] = [0.0, 0.3, -0.3, 0.6, -0.6, 0.9, -0.9];
        let (mut dead, junctions) = self.count_ends();
        for node in 0..self.fabric.node_count() as u32 {
            if dead as f64 <= self.config.dead_ends * junctions as f64 {
                return;
            }
            if self.fabric.degree(node) != 1 {
                continue;
            }
            let back = self.fabric.ways(node)[0];
            for turn in TURNS {
                let (sin, cos) = simworld_core::ops::sin_cos(turn);
                let ahead = -back;
                let along =
                    nalgebra::Vector2::new(ahead.x * cos - ahead.y * sin, ahead.x * sin + ahead.y * cos);
                let length = self.config.length * 1.3;
                let proposal = Proposal {
                    from: Start::Node(node),
                    along,
                    length,
                    class: RoadClass::Local,
                    emptiness: 0.0,
                };
                let fitted = self.fitter.fit(&self.fabric, &proposal, &self.measures);
                if let Some(fitted) = fitted.filter(|fitted| !fitted.is_open()) {
                    let before = self.fabric.segments().len();
                    self.fabric.build(&fitted, 4);
                    self.standing += self.fabric.segments().len() - before;
                    dead -= 1;
                    break;
                }
            }
        }
    }

    /// Takes away dead ends, the youngest first, until no more are left than the style has.
    pub(super) fn prune(&mut self) {
        let (mut dead, mut junctions) = self.count_ends();
        for node in (1..self.fabric.node_count() as u32).rev() {
            if dead as f64 <= self.config.dead_ends * junctions as f64 {
                return;
            }
            if self.fabric.degree(node) != 1 {
                continue;
            }
            let street = self.fabric.streets(node)[0];
            let other = self.fabric.other_end(street, node);
            match self.fabric.degree(other) {
                // Both ends would be gone: the last street stays.
                1 => continue,
                2 => {} // the next piece becomes the dead end
                3 => {
                    // Two streets are left where three met: no junction any more.
                    dead -= 1;
                    junctions -= 2;
                }
                _ => {
                    dead -= 1;
                    junctions -= 1;
                }
            }
            self.fabric.remove_dead_end(node);
            self.standing -= 1;
        }
    }

    /// Dead ends, and junctions with them.
    fn count_ends(&self) -> (usize, usize) {
        let degrees = (0..self.fabric.node_count() as u32).map(|node| self.fabric.degree(node));
        degrees
            .filter(|degree| !matches!(degree, 0 | 2))
            .fold((0, 0), |(dead, junctions), degree| (dead + usize::from(degree == 1), junctions + 1))
    }
}
