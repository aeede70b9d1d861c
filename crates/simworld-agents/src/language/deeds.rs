//! Orders to a plan: faces, photos, crossings, and whom one goes to.

use super::clause::{Pace, Reference};
use super::compass::Compass;
use super::draft::{AT_POINT, Draft, FOLLOWING, speed_of};
use super::lexicon::{class, is_animate};
use super::resolve::Purpose;
use simworld_core::action::{Action, ActionKind};
use simworld_core::geometry::{Point3, heading};
use simworld_core::id::EntityId;
use simworld_core::seam::{Goal, PlanError, PlanStep};

impl Draft<'_> {
    pub(super) fn face(&mut self, what: &Reference) -> Result<(), PlanError> {
        self.can(ActionKind::Rotate)?;
        let to = self.goal(what)?;
        let way = self.place_of(to) - self.view.from;
        if way.norm() > 1e-6 {
            self.view.heading = heading(&way);
        }
        if !matches!(self.last_step(), Some(PlanStep::Face { to: last }) if *last == to) {
            self.push(PlanStep::Face { to });
        }
        Ok(())
    }

    /// Towards a place so far away that the direction stays the same wherever one stands.
    pub(super) fn face_compass(&mut self, compass: Compass) -> Result<(), PlanError> {
        const FAR: f64 = 1000.0;
        self.can(ActionKind::Rotate)?;
        self.view.heading = compass.heading();
        let to = Goal::Point(self.on_level(self.view.from + compass.step() * FAR));
        self.push(PlanStep::Face { to });
        Ok(())
    }

    pub(super) fn photo(&mut self, of: Option<&Reference>, times: u32) -> Result<(), PlanError> {
        if let Some(of) = of {
            self.face(of)?;
        }
        if times == 1 {
            return self.act(Action::TakePhoto);
        }
        self.can(ActionKind::TakePhoto)?;
        self.push(PlanStep::Repeat { times, steps: vec![PlanStep::Act(Action::TakePhoto)] });
        Ok(())
    }

    pub(super) fn follow(&mut self, whom: &Reference, pace: Pace) -> Result<(), PlanError> {
        let target = self.find(whom, Purpose::Any)?;
        if !target.kind.is_mobile() {
            let near =
                format!("a {} stays where it is: follow people, animals, robots or vehicles", target.kind);
            return Err(PlanError::NotFound { wanted: format!("{:?} to follow", whom.text), near });
        }
        // Who sits in a car follows in it.
        if self.posture != super::draft::Posture::Aboard {
            self.get_up()?;
        }
        self.beside = None;
        self.push(PlanStep::Follow { whom: target.id, gap: FOLLOWING, speed: speed_of(pace) });
        Ok(())
    }

    pub(super) fn go_to_somebody(&mut self, to: &Reference, verb: &str) -> Result<EntityId, PlanError> {
        let somebody = self.find(to, Purpose::Any)?;
        if !is_animate(somebody.kind) {
            let near = format!("a {} does not answer: {}", somebody.kind, self.view.surroundings());
            return Err(PlanError::NotFound { wanted: format!("{:?} to {verb}", to.text), near });
        }
        self.go_beside(&somebody)?;
        Ok(somebody.id)
    }

    /// To the other side of the nearest crossing, along its longer side.
    pub(super) fn cross(&mut self) -> Result<(), PlanError> {
        let wanted = Reference {
            indefinite: true,
            text: "crossing".to_owned(),
            ..Reference::nearest(class("crossing"))
        };
        let crossing = self.view.find(&wanted, Purpose::Any)?;
        let half = crossing.info.shape.size() * 0.5;
        let along = if half.x >= half.y {
            Point3::new(half.x + AT_POINT, 0.0, 0.0)
        } else {
            Point3::new(0.0, half.y + AT_POINT, 0.0)
        };
        let ends = [crossing.pose * along, crossing.pose * Point3::from(-along.coords)];
        let distance = |end: &Point3| (end.xy() - self.view.from).norm();
        let far = if distance(&ends[0]) >= distance(&ends[1]) { ends[0] } else { ends[1] };
        self.navigate(Goal::Point(far), AT_POINT, None)
    }
}
