//! What drivers are told: turns at junctions, the block, the kerb.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use simworld_core::action::{ActionKind, StepDirection};
use simworld_core::geometry::{Point2, Point3};
use simworld_core::id::LaneId;
use simworld_core::net::{Control, RoadNetwork, Turn, polyline};
use simworld_core::seam::{Goal, PlanError, PlanStep};

use super::clause::{Clause, Course, Lights, Pace, Reference, Spot};
use super::draft::{AT_POINT, Draft, Posture};
use super::lexer::Token;
use super::lexicon::longest_phrase;
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;
use crate::lanes::{OnLane, beside, lane, lane_at, middle, only_way, straight_on, way_that};

/// Roads at a place that people call a junction.
const JUNCTION: usize = 3;
/// How far ahead one pulls over where no place is said, m.
const PULL_OVER: f64 = 20.0;
/// Nobody counts more junctions, and no block has more corners.
const MOST_JUNCTIONS: usize = 64;
/// How near one comes to a place that is only on the way, m: there one does not stop.
const ON_THE_WAY: f64 = 10.0;

impl Parser<'_> {
    /// "Go left at the next crossing": one turns there, and takes no step.
    pub(super) fn side_at_junction(&mut self) -> Option<Clause> {
        let start = self.at;
        let left = self.eat_any(&["left", "to the left"]);
        let turn = if left { Turn::Left } else { Turn::Right };
        if (left || self.eat_any(&["right", "to the right"]))
            && let Some((nth, lights)) = self.junction()
        {
            return Some(Clause::TurnAt { turn, nth, lights });
        }
        self.at = start;
        None
    }

    /// "At the next light": the place in the row, and which junctions count.
    pub(super) fn junction(&mut self) -> Option<(u32, Lights)> {
        const LIGHTS: &Phrases = &Phrases::of(&[
            "light",
            "lights",
            "traffic light",
            "traffic lights",
            "stoplight",
            "stop light",
            "set of lights",
            "signal",
            "traffic signal",
            "signals",
            "set of traffic lights",
        ]);
        #[rustfmt::skip]
        const JUNCTIONS: &Phrases = &Phrases::of(&[
            "junction", "intersection", "crossroads", "crossroad", "corner", "crossing", "turning", "turn",
            "street corner", "side street", "street", "road", "opportunity", "turnoff", "one", "one after",
            "one after that", "one after it",
        ]);
        let start = self.at;
        if !self.eat_any(&[
            "at",
            "at the",
            "on",
            "into the",
            "into",
            "onto the",
            "when you reach the",
            "when you get to the",
            "when you come to the",
            "just after the",
            "down the",
        ]) {
            return None;
        }
        self.eat_any(&["the"]);
        let nth = if self.eat_any(&["next", "coming", "following", "very next"]) {
            1
        } else if let Some(nth) = numbers::ordinal(self.rest()) {
            self.at += 1;
            nth
        } else {
            1
        };
        if let Some(count) = longest_phrase(self.rest(), LIGHTS) {
            self.at += count;
            return Some((nth, Lights::Only));
        }
        if let Some(count) = longest_phrase(self.rest(), JUNCTIONS) {
            self.at += count;
            return Some((nth, Lights::Any));
        }
        self.at = start;
        None
    }

    /// "At the next light, turn left": the junction first.
    pub(super) fn at_junction(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        let start = self.at;
        let Some((nth, lights)) = self.junction() else { return Ok(None) };
        self.skip_joints();
        let turn = match self.order() {
            Ok(clauses) => match clauses[..] {
                [Clause::Turn { angle }] => Some(turn_of(angle)),
                [
                    Clause::Step { direction: StepDirection::Left, .. }
                    | Clause::Walk { course: Course::Relative(StepDirection::Left), .. },
                ] => Some(Turn::Left),
                [
                    Clause::Step { direction: StepDirection::Right, .. }
                    | Clause::Walk { course: Course::Relative(StepDirection::Right), .. },
                ] => Some(Turn::Right),
                [Clause::Step { direction: StepDirection::Backward, .. }] => None,
                [
                    Clause::Walk { course: Course::Relative(_), .. } | Clause::Forward | Clause::Step { .. },
                ] => Some(Turn::Straight),
                _ => None,
            },
            Err(error) => return Err(error),
        };
        if turn.is_none() {
            self.at = start;
        }
        Ok(turn.map(|turn| vec![Clause::TurnAt { turn, nth, lights }]))
    }

    /// After "take": "the next left", "the second turning on the right".
    pub(super) fn turn_to_take(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        self.eat_any(&["the", "a"]);
        let nth = if self.eat_any(&["next", "very next"]) { Some(1) } else { numbers::ordinal(self.rest()) };
        self.at += usize::from(nth.is_some() && numbers::ordinal(self.rest()).is_some());
        self.eat_any(&["possible", "available"]);
        let turning = self.eat_any(&["turn", "turning", "street", "road", "turnoff", "exit"]);
        let turn = if self.eat_any(&[
            "left",
            "on the left",
            "on your left",
            "to the left",
            "left turn",
            "left turning",
            "left hand turn",
        ]) {
            Some(Turn::Left)
        } else if self.eat_any(&[
            "right",
            "on the right",
            "on your right",
            "to the right",
            "right turn",
            "right turning",
            "right hand turn",
        ]) {
            Some(Turn::Right)
        } else {
            None
        };
        let said = nth.is_some() || turning || self.at > start + 1;
        if let Some(turn) = turn.filter(|_| nth.is_none() && !turning)
            && let Some((nth, lights)) = self.junction()
        {
            return Some(vec![Clause::TurnAt { turn, nth, lights }]);
        }
        let walks = self.view.scene.entity(self.view.who).is_some_and(|me| !me.kind.is_vehicle());
        if walks
            && nth.is_none()
            && !turning
            && let Some(turn) = turn.filter(|_| said && self.ends_clause())
        {
            // Who walks and takes a left turns where it stands.
            return Some(vec![Clause::Turn {
                angle: if turn == Turn::Left { FRAC_PI_2 } else { -FRAC_PI_2 },
            }]);
        }
        let turn = turn.filter(|_| said && self.ends_clause());
        if turn.is_none() {
            self.at = start;
        }
        turn.map(|turn| vec![Clause::TurnAt { turn, nth: nth.unwrap_or(1), lights: Lights::Any }])
    }

    /// After "drive".
    pub(super) fn drive(&mut self) -> Result<Vec<Clause>, PlanError> {
        #[rustfmt::skip]
        const TO: &Phrases = &Phrases::of(&[
            "to", "over to", "towards", "back to", "up to", "down to", "all the way to", "straight to", "on to",
            "as far as", "me to", "us to", "yourself to",
        ]);
        let pace = self.pace(Pace::Usual)?;
        if self.eat_any(TO) {
            let to = self.reference(0)?;
            if let Some(what) = self.mount()? {
                return Ok(vec![Clause::Board { what, to: Some(to) }]);
            }
            let pace = self.pace(pace)?;
            return self.after_place(Clause::Drive { to, pace }, pace);
        }
        if let Some(clauses) = self.straight_at_junction() {
            return Ok(clauses);
        }
        if let Some(clauses) = self.by_the_compass(pace)? {
            return Ok(clauses);
        }
        if let Some(clauses) = self.special_way(pace)? {
            return Ok(clauses);
        }
        let start = self.at;
        self.eat_any(&["on", "ahead", "straight ahead", "straight on", "straight", "forward", "forwards"]);
        self.eat_any(&["for"]);
        if let Some(distance) = self.length().filter(|distance| *distance > 0.0 && *distance <= 10_000.0) {
            self.eat_any(&[
                "ahead",
                "on",
                "straight ahead",
                "straight on",
                "forward",
                "forwards",
                "further",
                "farther",
            ]);
            let course = Course::Relative(StepDirection::Forward);
            return Ok(vec![Clause::Walk { course, distance, pace }]);
        }
        self.at = start;
        self.eat_any(&["me home", "us home"]);
        let what = self.reference(0)?;
        let to = self.tail_place(TO)?;
        Ok(vec![Clause::Board { what, to }])
    }

    /// "Straight on at the crossroads".
    pub(super) fn straight_at_junction(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        self.eat_any(&[
            "straight on",
            "straight ahead",
            "straight",
            "straight over",
            "straight across",
            "on",
            "ahead",
        ]);
        if self.at > start
            && let Some((nth, lights)) = self.junction_passed().or_else(|| self.junction())
        {
            return Some(vec![Clause::TurnAt { turn: Turn::Straight, nth, lights }]);
        }
        let drives = self.view.scene.entity(self.view.who).is_some_and(|me| me.kind.is_vehicle());
        let from = start.saturating_sub(2);
        let straight = self.lexemes[from..self.at]
            .iter()
            .any(|lexeme| matches!(&lexeme.token, Token::Word(word) if word == "straight"));
        if drives && straight && self.ends_clause() && !self.goes_on() && self.peek_interval().is_none() {
            return Some(vec![Clause::TurnAt { turn: Turn::Straight, nth: 1, lights: Lights::Any }]);
        }
        self.at = start;
        None
    }

    /// After "park".
    pub(super) fn park(&mut self) -> Result<Vec<Clause>, PlanError> {
        const KERB: &[&str] = &[
            "at the kerb",
            "at the curb",
            "by the kerb",
            "by the curb",
            "at the side of the road",
            "by the side of the road",
            "at the roadside",
        ];
        self.eat_any(&["up", "here", "there", "somewhere", "now"]);
        if self.eat_any(KERB) {
            return Ok(vec![Clause::Park { at: None }]);
        }
        let side = self.side().map(|side| Spot::Beside(side, None));
        if side.is_none() && self.ends_clause() {
            return Ok(vec![Clause::Park { at: None }]);
        }
        if side.is_none()
            && !self.eat_any(&["at", "by", "in", "on", "close to", "up at", "right by", "over at"])
        {
            return Err(self.not_understood("say where to park, as in \"park behind the van\""));
        }
        let at = self.reference(0)?;
        Ok(vec![Clause::Park { at: Some((at, side)) }])
    }
}

/// The turn at a junction for an angle that one is told, radians to the left.
fn turn_of(angle: f64) -> Turn {
    if angle.abs() < FRAC_PI_4 {
        Turn::Straight
    } else if angle.abs() > 3.0 * FRAC_PI_4 {
        Turn::UTurn
    } else if angle > 0.0 {
        Turn::Left
    } else {
        Turn::Right
    }
}

impl<'a> Draft<'a> {
    /// Whether one drives at this point of the plan.
    pub(super) fn drives(&self) -> bool {
        self.kind.is_vehicle() || self.posture == Posture::Aboard
    }

    /// The roads, and where on them one is by then.
    fn on_road(&self) -> Result<(&'a RoadNetwork, OnLane), PlanError> {
        if !self.drives() {
            let near = "that is for those who drive: get into a car first, or say where to walk".to_owned();
            return Err(PlanError::NotFound { wanted: "vehicle under you".to_owned(), near });
        }
        let roads = self.view.scene.roads().map(std::convert::AsRef::as_ref);
        let here = roads
            .and_then(|roads| lane_at(roads, self.view.from, Some(self.view.heading)).map(|on| (roads, on)));
        here.ok_or_else(|| {
            let near = "you are on no lane: say where to drive".to_owned();
            PlanError::NotFound { wanted: "road that leads your way".to_owned(), near }
        })
    }

    /// To the middle of the road that a turn at the nth junction leads into.
    pub(super) fn turn_at(&mut self, turn: Turn, nth: u32, lights: Lights) -> Result<(), PlanError> {
        let (roads, on) = self.on_road()?;
        let (mut at, mut counted) = (on.lane, 0);
        for _ in 0..MOST_JUNCTIONS {
            let place = &roads.intersections[lane(roads, at).to.index()];
            let counts = match lights {
                Lights::Only => place.control == Control::Signals,
                Lights::Any => place.roads.len() >= JUNCTION,
            };
            counted += u32::from(counts);
            let way =
                if counts && counted == nth { way_that(roads, at, turn) } else { straight_on(roads, at) };
            let Some(way) = way else {
                let wanted = if counted == nth {
                    format!("way to the {}", called(turn))
                } else {
                    format!("junction number {nth} ahead")
                };
                let near =
                    format!("the road leads past {counted} junctions that count before it ends or forks");
                return Err(PlanError::NotFound { wanted, near });
            };
            at = way.to;
            if counted == nth {
                let (point, heading) = middle(roads, at);
                return self.drive_by(point, heading, AT_POINT);
            }
        }
        Err(PlanError::NotFound {
            wanted: format!("junction number {nth} ahead"),
            near: "no road is as long".to_owned(),
        })
    }

    /// To a left, right or about turn without a word on where: at the next junction.
    pub(super) fn turn_driving(&mut self, angle: f64) -> Result<(), PlanError> {
        match turn_of(angle) {
            Turn::UTurn => {
                let near = "vehicles turn at junctions and dead ends: say where to drive".to_owned();
                Err(PlanError::NotFound { wanted: "room to turn round on the spot".to_owned(), near })
            }
            turn => self.turn_at(turn, 1, Lights::Any),
        }
    }

    /// So far along the road, straight on at junctions.
    pub(super) fn drive_on(&mut self, distance: f64) -> Result<(), PlanError> {
        let (roads, on) = self.on_road()?;
        let (mut at, mut station) = (on.lane, on.station + distance);
        for _ in 0..MOST_JUNCTIONS * 4 {
            let length = lane(roads, at).length;
            if station <= length {
                break;
            }
            let Some(way) = straight_on(roads, at) else { break };
            station = (station - length - way.length).max(0.0);
            at = way.to;
        }
        let (point, heading) = polyline::at(&lane(roads, at).path, station);
        self.drive_by(point, heading, AT_POINT)
    }

    /// Round the block: right at every corner or, where that does not lead back, left.
    pub(super) fn round_the_block(&mut self) -> Result<(), PlanError> {
        let (roads, on) = self.on_road()?;
        let start = self.view.from;
        let heading = self.view.heading;
        let Some(block) = [Turn::Right, Turn::Left].iter().find_map(|turn| block(roads, on.lane, *turn))
        else {
            let near = "turning right at every corner does not lead back, nor does turning left".to_owned();
            return Err(PlanError::NotFound { wanted: "block to drive round".to_owned(), near });
        };
        for passed in block {
            let (point, along) = middle(roads, passed);
            self.drive_by(point, along, ON_THE_WAY)?;
        }
        self.drive_by(start, heading, AT_POINT)
    }

    /// To the kerb: at a place, or a little ahead unless one has just come to a place by car.
    pub(super) fn park(&mut self, at: Option<&(Reference, Option<Spot>)>) -> Result<(), PlanError> {
        if let Some((at, side)) = at {
            if !self.drives() {
                self.can(ActionKind::Throttle)?;
            }
            return self.go(at, *side, Pace::Usual, None);
        }
        if self.drives() && matches!(self.last_step(), Some(PlanStep::Navigate { .. })) {
            return Ok(()); // who drives to a place parks there
        }
        let (roads, on) = self.on_road()?;
        let length = lane(roads, on.lane).length;
        let station = (on.station + PULL_OVER).min(length - 1.0).max(on.station);
        let (point, heading) = polyline::at(&lane(roads, on.lane).path, station);
        self.drive_by(point, heading, AT_POINT)
    }

    fn drive_by(&mut self, point: Point2, heading: f64, within: f64) -> Result<(), PlanError> {
        let to = Point3::new(point.x, point.y, self.on_level(point).z);
        self.beside = None;
        self.navigate(Goal::Point(to), within, None)?;
        self.view.heading = heading;
        Ok(())
    }
}

/// The roads round the block, less the one where one is; `None` if the turns do not lead back.
fn block(roads: &RoadNetwork, start: LaneId, turn: Turn) -> Option<Vec<LaneId>> {
    let own = beside(roads, start);
    let (mut at, mut passed) = (start, Vec::new());
    while passed.len() < MOST_JUNCTIONS {
        at = way_that(roads, at, turn).or_else(|| only_way(roads, at))?.to;
        if own.contains(&at) {
            return (passed.len() > 1).then_some(passed);
        }
        passed.push(at);
    }
    None
}

const fn called(turn: Turn) -> &'static str {
    match turn {
        Turn::Left => "left there",
        Turn::Right => "right there",
        Turn::Straight => "other side of it, straight on",
        Turn::UTurn => "place one came from",
    }
}
