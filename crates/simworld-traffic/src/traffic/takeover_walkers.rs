//! Walkers that somebody else takes over, guides or moves, and gives back.

use simworld_core::geometry::{Point2, Vector2};

use super::Traffic;
use crate::takeover::{Control, ControlError, Stroll, finite_in_plane};

impl Traffic {
    /// Guides a walker until it is [given back](Self::give_back_walker) or told otherwise: somebody else says how fast and on
    /// which side it walks and whether it crosses at red; the traffic keeps it on its walkway, off the others, and from
    /// stepping before a vehicle. Where it goes is said by [`send_walker`](Self::send_walker). It leaves its party.
    ///
    /// # Errors
    /// No walker of that number on its way, or a number out of range; nothing is changed then.
    pub fn guide_walker(&mut self, id: u32, stroll: Stroll) -> Result<(), ControlError> {
        self.state.pedestrians.guide(id, &stroll)
    }

    /// Lifts a walker off its way: it is a free body from now on that stands where [`place_walker`](Self::place_walker) puts
    /// it. Drivers and walkers mind it as they mind others.
    ///
    /// # Errors
    /// No walker of that number, or one that is free already.
    pub fn free_walker(&mut self, id: u32) -> Result<(), ControlError> {
        let height = self.walker_height(id);
        self.state.pedestrians.lift(id, height)
    }

    /// Says how high a free walker stands above the ground level of the world, m, from now on; at first it is as high as it was. Drivers
    /// below do not mind who is on a footbridge.
    ///
    /// # Errors
    /// It is not free, or the height is not finite; nothing is changed then.
    pub fn place_walker_at_height(&mut self, id: u32, height: f64) -> Result<(), ControlError> {
        finite_in_plane("height", Vector2::new(height, 0.0))?;
        self.state.pedestrians.place_at_height(id, height)
    }

    /// Puts a free walker somewhere, m in the world's frame, looking in a direction, at a velocity, m/s.
    ///
    /// # Errors
    /// It is not free, a number is not finite, or the direction has no length; nothing is changed then.
    pub fn place_walker(
        &mut self,
        id: u32,
        at: Point2,
        facing: Vector2,
        velocity: Vector2,
    ) -> Result<(), ControlError> {
        finite_in_plane("position", at.coords)?;
        finite_in_plane("facing", facing)?;
        finite_in_plane("velocity", velocity)?;
        let value = facing.norm();
        let too_short = ControlError::Range { field: "facing", value, allowed: "a direction of a length" };
        let facing = facing.try_normalize(1e-9).ok_or(too_short)?;
        self.state.pedestrians.place(id, at, facing, velocity)
    }

    /// Gives a walker back. A free body joins the walkway under it, and its journey, if it has one, goes on from there.
    ///
    /// # Errors
    /// Nobody else moves it, or why a free body cannot join; it stays as it is then.
    pub fn give_back_walker(&mut self, id: u32) -> Result<(), ControlError> {
        match self.state.pedestrians.control(id) {
            None => Err(ControlError::Nobody { what: "walker", id }),
            Some(Control::Own) => {
                let (wanted, mend) = ("under control", "it walks by itself already");
                Err(ControlError::NotSo { what: "walker", id, wanted, mend })
            }
            Some(Control::Guided(_)) => {
                self.state.pedestrians.restore(id);
                Ok(())
            }
            Some(Control::Free) => {
                let (ways, plazas) = (&self.ways, &self.plazas);
                let path = |from, to| super::walkers::path(ways, from, to);
                self.state.pedestrians.put_back((ways, plazas), id, path)
            }
        }
    }

    /// Who moves a walker; `None` if nobody has the number.
    pub fn walker_control(&self, id: u32) -> Option<Control<Stroll>> {
        self.state.pedestrians.control(id)
    }
}
