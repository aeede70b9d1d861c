//! Ways that are more than a place to go to: so far in a direction, past or round a thing, halfway, by way of another.

use simworld_core::action::StepDirection;
use simworld_core::geometry::{Point2, Vector2, direction, planar};
use simworld_core::scene::EntityRef;
use simworld_core::seam::{Goal, PlanError};

use super::clause::{Clause, Course, Pace, Reference, Target};
use super::draft::{AT_POINT, Draft, speed_of};
use super::lexer::Token;
use super::lexicon::longest_phrase;
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;
use super::resolve::Purpose;

/// Room between a thing and the way past or round it, m: half a body and an arm's breadth.
const CLEARANCE: f64 = 1.0;
/// The longest way in a direction, m.
const LONGEST_WALK: f64 = 10_000.0;
/// How far before a thing one stops short of it where nothing else is said, m.
const SHORT_OF: f64 = 3.0;

#[rustfmt::skip]
const HALFWAY: &Phrases = &Phrases::of(&[
    "halfway", "half way", "midway", "mid way", "half of the way", "half the way", "in the middle",
    "half the distance", "half of the distance", "half way along", "at the midpoint", "at the middle",
    "in the centre", "in the center", "the middle", "the midpoint", "the centre", "the center", "equidistant",
]);
/// How exactly something is meant, which changes nothing.
const EXACTLY: &Phrases = &Phrases::of(&[
    "right",
    "exactly",
    "precisely",
    "just",
    "about",
    "roughly",
    "somewhere",
    "directly",
    "squarely",
    "smack",
]);

/// Not round a thing, but behind it.
const BEHIND: &[&str] = &["round the back of", "around the back of", "around behind", "round behind"];
/// Not round a thing, but by it.
const ROUND_BY: &[&str] = &["round by", "around by", "round past", "around past"];

impl Parser<'_> {
    /// So many metres in a direction of the compass, in either order; a direction without a length only where one goes
    /// on until something happens.
    pub(super) fn by_the_compass(&mut self, pace: Pace) -> Result<Option<Vec<Clause>>, PlanError> {
        let start = self.at;
        self.eat_any(&["off", "out", "away", "straight", "for"]);
        // "Thirty metres to the south and then twenty to the east".
        let bare = numbers::number(self.rest()).filter(|(number, _)| *number >= 1.0 && self.length_before());
        let before = self.length().or_else(|| {
            let (number, words) = bare?;
            self.at += words;
            self.eat_any(&["more"]);
            Some(number)
        });
        if before.is_some() {
            self.eat_any(&[
                "further",
                "farther",
                "more",
                "away",
                "off",
                "further to the",
                "farther to the",
                "to the",
            ]);
        }
        let Some(compass) = self.compass() else {
            self.at = start;
            return Ok(None);
        };
        let number_at = self.at;
        let of_thing = longest_phrase(self.rest(), &["of", "from"]).is_some()
            && longest_phrase(
                self.rest(),
                &["of here", "from here", "of you", "from where you are", "of where you are"],
            )
            .is_none();
        if of_thing {
            self.at = start; // "two metres north of the hydrant" is a place
            return Ok(None);
        }
        let after = if before.is_none() {
            self.eat_any(&["for", "by"]);
            self.length()
        } else {
            None
        };
        let Some(distance) = before.or(after) else {
            self.at = number_at;
            if !self.ends_clause() {
                self.at = start;
                return Ok(None);
            }
            if self.goes_on() {
                return Ok(Some(vec![Clause::FaceCompass(compass), Clause::Forward]));
            }
            return Err(self.not_understood("say how far, as in \"go 20 metres north\""));
        };
        if !(distance > 0.0 && distance <= LONGEST_WALK) {
            self.at = start;
            return Err(self.not_understood("go more than 0 and at most 10000 metres"));
        }
        Ok(Some(vec![Clause::Walk { course: Course::Compass(compass), distance, pace }]))
    }

    /// Whether a unit of length was said earlier, which a bare number goes on with.
    pub(super) fn length_before(&self) -> bool {
        self.lexemes[..self.at].iter().any(|lexeme| {
            matches!(&lexeme.token, Token::Word(word) if ["metres", "metre", "meters", "meter", "m", "steps", "paces"].contains(&word.as_str()))
        })
    }

    /// A length, m; a step is taken for a metre.
    pub(super) fn length(&mut self) -> Option<f64> {
        let (length, words) = numbers::walked(self.rest())?;
        self.at += words;
        Some(length)
    }

    /// "Past the café", "round the fountain", "halfway to the museum".
    pub(super) fn special_way(&mut self, pace: Pace) -> Result<Option<Vec<Clause>>, PlanError> {
        let start = self.at;
        if longest_phrase(self.rest(), BEHIND).is_some() {
            return Ok(None);
        }
        self.at += longest_phrase(self.rest(), ROUND_BY).map_or(0, |_| 1);
        self.eat_any(&["right", "straight", "all the way", "once", "completely"]);
        if !self.peeks("around here")
            && self.eat_any(&["around", "round", "in a circle around", "in circles around", "all around"])
        {
            if self.eat_any(&["to", "over to"]) {
                let to = self.reference(0)?;
                return Ok(Some(vec![Clause::Go { to, side: None, pace, within: None }]));
            }
            return self.round(pace).map(Some);
        }
        if self.eat_any(&["past", "on past", "along past", "by past"]) {
            return self.past(pace).map(Some);
        }
        if self.peeks("along") {
            return Err(self.not_understood("going along things is not understood: say where to"));
        }
        self.at = start;
        if self.eat_up_to_middle() {
            return self.halfway(pace).map(Some);
        }
        self.at = start;
        Ok(None)
    }

    /// Whether a way to between things begins here: "to the exact middle between", "halfway"; what is said before them is passed.
    fn eat_up_to_middle(&mut self) -> bool {
        self.eat_any(EXACTLY);
        let at = self.at;
        self.eat_any(&[
            "to a",
            "to the",
            "at a",
            "at the",
            "to",
            "at",
            "into",
            "in",
            "the exact",
            "the",
            "a",
        ]);
        self.eat_any(&["point", "spot", "place", "position", "space", "gap"]);
        self.eat_any(&["that is", "thats", "which is"]);
        self.eat_any(EXACTLY);
        let middle = longest_phrase(self.rest(), &["middle", "midpoint", "centre", "center"]);
        if let Some(words) = middle.filter(|words| {
            longest_phrase(&self.rest()[*words..], &["between", "of the way", "in between"]).is_some()
        }) {
            self.at += words;
            return true;
        }
        if longest_phrase(self.rest(), HALFWAY).is_none()
            && longest_phrase(&self.lexemes[at..], HALFWAY).is_some()
        {
            self.at = at;
        }
        self.eat_any(HALFWAY) || longest_phrase(self.rest(), &["between", "in between"]).is_some()
    }

    /// Whether the middle of something is said next.
    pub(super) fn peeks_halfway(&self) -> bool {
        let exactly = longest_phrase(self.rest(), EXACTLY).unwrap_or(0);
        longest_phrase(&self.rest()[exactly..], HALFWAY).is_some()
    }

    /// "Do two laps around the table".
    pub(super) fn laps(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        let start = self.at;
        self.eat_any(&["do", "run", "walk", "make", "take", "complete", "go", "jog"]);
        let number = numbers::number(self.rest()).filter(|(number, _)| (1.0..=100.0).contains(number));
        self.at += number.map_or(0, |(_, count)| count);
        let laps = self
            .eat_any(&["laps", "lap", "circuits", "circuit", "rounds", "round", "circles", "circle"])
            && self.eat_any(&["around", "round", "of", "about"]);
        let Some((number, _)) = number.filter(|_| laps) else {
            self.at = start;
            return Ok(None);
        };
        let body = self.round(Pace::Usual)?;
        Ok(Some(if number < 2.0 { body } else { vec![Clause::Repeat { times: number as u32, body }] }))
    }

    /// After "past".
    pub(super) fn past(&mut self, pace: Pace) -> Result<Vec<Clause>, PlanError> {
        if longest_phrase(self.rest(), &["between", "in between"]).is_some() && self.eat_up_to_middle() {
            return self.halfway(pace);
        }
        let what = self.reference(0)?;
        let mut clauses = vec![Clause::Past { what, pace }];
        if self.eat_any(&[
            "to",
            "towards",
            "up to",
            "on to",
            "onto",
            "over to",
            "until you reach",
            "until you get to",
        ]) {
            clauses.push(Clause::Go { to: self.reference(0)?, side: None, pace, within: None });
        }
        Ok(clauses)
    }

    /// After "round": a thing, or the block.
    pub(super) fn round(&mut self, pace: Pace) -> Result<Vec<Clause>, PlanError> {
        if self.eat_any(&["the block", "this block", "a block"]) {
            return Ok(vec![Clause::Block]);
        }
        Ok(vec![Clause::Around { what: self.reference(0)?, pace }])
    }

    /// After "halfway".
    fn halfway(&mut self, pace: Pace) -> Result<Vec<Clause>, PlanError> {
        self.eat_any(&["along the way", "along"]);
        if self.eat_any(&["to", "towards", "toward", "over to", "up to"]) {
            return Ok(vec![Clause::Halfway { from: None, to: self.reference(0)?, pace }]);
        }
        self.eat_any(&["point", "spot"]);
        if !self.eat_any(&["between", "in between", "from", "of"]) {
            return Err(self.not_understood("say halfway to where, or between what"));
        }
        let from = self.reference(0)?;
        if self.eat_any(&["and", "to"]) {
            return Ok(vec![Clause::Halfway { from: Some(from), to: self.reference(0)?, pace }]);
        }
        let (one, other) = Self::pair(&from);
        Ok(vec![Clause::Halfway { from: Some(one), to: other, pace }])
    }

    /// "Within 3 metres of", before a place; m.
    pub(super) fn within(&mut self) -> Result<Option<f64>, PlanError> {
        let start = self.at;
        self.eat_any(&["to"]);
        if self.eat_any(&["within", "up to within", "to within"]) {
            let distance = self.length().filter(|distance| (0.1..=1000.0).contains(distance));
            let said = distance.is_some() && self.eat_any(&["of", "from"]);
            if !said {
                self.at = start;
                return Err(self.not_understood("say within how far of what, from 0.1 to 1000 metres"));
            }
            return Ok(distance);
        }
        self.at = start;
        Ok(None)
    }

    /// "Stop short of the statue", "stop five metres before the statue".
    pub(super) fn short_of(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        let start = self.at;
        let length = self.length();
        if !self.eat_any(&[
            "short of",
            "just short of",
            "before",
            "just before",
            "away from",
            "from",
            "before you reach",
        ]) {
            self.at = start;
            return Ok(None);
        }
        let within = Some(length.unwrap_or(SHORT_OF).clamp(0.1, 1000.0));
        Ok(Some(vec![Clause::Go { to: self.reference(0)?, side: None, pace: Pace::Usual, within }]))
    }

    /// "To the shop for a coffee".
    fn for_goods(&mut self, go: &Clause) -> Option<Clause> {
        let Clause::Go { to, .. } = go else { return None };
        let start = self.at;
        let goods = if self.eat_any(&["for", "and get", "to get", "to fetch"]) { self.goods() } else { None };
        let Some(goods) = goods else {
            self.at = start;
            return None;
        };
        let at = Some(to.clone());
        Some(Clause::Buy { goods: goods.name, times: goods.times, at, whom: None })
    }

    /// "To the fountain for a photo".
    fn for_photo(&mut self, go: &Clause) -> Option<Clause> {
        let Clause::Go { to, .. } = go else { return None };
        let start = self.at;
        let said = self.eat_any(&["for a", "for a quick", "for another", "for a nice"])
            && self.eat_any(super::orders::PHOTOS);
        if !said {
            self.at = start;
        }
        said.then(|| Clause::Photo { of: Some(to.clone()), times: 1 })
    }

    /// What is said of the way after where it leads.
    pub(super) fn after_place(&mut self, go: Clause, pace: Pace) -> Result<Vec<Clause>, PlanError> {
        if self.eat_via() || self.eat_any(&["passing by", "passing through", "through", "going through"]) {
            let over = |to| Clause::Go { to, side: None, pace, within: None };
            let mut ways = vec![over(self.reference(0)?)];
            while let Some(to) = self.another_on_the_way() {
                ways.push(over(to));
            }
            ways.push(go);
            return Ok(ways);
        }
        if let Some(first) = self.going_first() {
            return Ok(vec![Clause::Go { to: first, side: None, pace, within: None }, go]);
        }
        if let Some(buy) = self.for_goods(&go) {
            return Ok(vec![buy]);
        }
        if let Some(photo) = self.for_photo(&go) {
            return Ok(vec![go, photo]);
        }
        self.by_best_way();
        if let Clause::Go { to, .. } = &go
            && self.is_somebody(to)
            && self.eat_any(super::orders::BRINGS)
        {
            let to = self.reference(0)?; // "lead Omar to the hospital"
            return Ok(vec![go, Clause::Go { to, side: None, pace, within: None }]);
        }
        self.eat_any(&["on foot", "by foot"]);
        if let Some(board) = self.by_vehicle().or_else(|| self.in_vehicle()) {
            return Ok(vec![board, go]);
        }
        if self.eat_any(&["past", "going past", "passing"]) {
            return Ok(vec![Clause::Past { what: self.reference(0)?, pace }, go]);
        }
        match go {
            Clause::Go { to, .. } if self.eat_any(HALFWAY) => {
                Ok(vec![Clause::Halfway { from: None, to, pace }])
            }
            go => Ok(vec![go]),
        }
    }

    pub(super) fn reverse(&mut self) -> Result<Clause, PlanError> {
        match self.step()? {
            Clause::Step { distance, .. } => {
                Ok(Clause::Step { direction: StepDirection::Backward, distance })
            }
            other => Ok(other),
        }
    }
}

impl Draft<'_> {
    /// So far in a direction.
    pub(super) fn walk(&mut self, course: Course, distance: f64, pace: Pace) -> Result<(), PlanError> {
        let heading = match course {
            Course::Compass(compass) => compass.heading(),
            Course::Relative(StepDirection::Forward) if self.drives() => return self.drive_on(distance),
            Course::Relative(way) => {
                let turn = match way {
                    StepDirection::Forward => 0.0,
                    StepDirection::Backward => std::f64::consts::PI,
                    StepDirection::Left => std::f64::consts::FRAC_PI_2,
                    StepDirection::Right => -std::f64::consts::FRAC_PI_2,
                };
                self.view.heading + turn
            }
        };
        let to = self.view.from + direction(heading) * distance;
        self.beside = None;
        self.navigate(Goal::Point(self.on_level(to)), AT_POINT, speed_of(pace))
    }

    /// Along the side of a thing and beyond it: on the side of its door, or else with the thing on the left, as
    /// people keep right.
    pub(super) fn pass(&mut self, what: &Reference, pace: Pace) -> Result<(), PlanError> {
        let thing = self.find(what, Purpose::Any)?;
        let from = self.view.from;
        let Some(way) = (thing.planar() - from).try_normalize(1e-6) else {
            return Err(self.is_here(what));
        };
        let left = Vector2::new(-way.y, way.x);
        let reach = |along: Vector2| {
            let stations = thing.obb().footprint().map(|corner| (corner - from).dot(&along));
            stations
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(*at), high.max(*at)))
        };
        let ((begin, end), (right_edge, left_edge)) = (reach(way), reach(left));
        let door = thing.access_point().map_or(0.0, |access| (access.xy() - from).dot(&left));
        let aside = if door > CLEARANCE { left_edge + CLEARANCE } else { right_edge - CLEARANCE };
        self.beside = None;
        for along in [begin, end + CLEARANCE] {
            let place = from + way * along + left * aside;
            self.navigate(Goal::Point(self.on_level(place)), AT_POINT, speed_of(pace))?;
        }
        Ok(())
    }

    /// Once round a thing, counter-clockwise, from its nearest corner.
    pub(super) fn around(&mut self, what: &Reference, pace: Pace) -> Result<(), PlanError> {
        let thing = self.find(what, Purpose::Any)?;
        let corners = corners_around(&thing);
        let distance = |at: &usize| (corners[*at] - self.view.from).norm();
        let first = (0..4).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
        self.beside = None;
        for step in 0..=4 {
            let place = self.on_level(corners[(first + step) % 4]);
            self.navigate(Goal::Point(place), AT_POINT, speed_of(pace))?;
        }
        Ok(())
    }

    /// To the middle of the way to a thing, or of that between two.
    pub(super) fn halfway(
        &mut self,
        from: Option<&Reference>,
        to: &Reference,
        pace: Pace,
    ) -> Result<(), PlanError> {
        let start = match from {
            Some(from) => self.place(from)?,
            None => self.view.from,
        };
        let end = self.place(to)?;
        self.beside = None;
        let middle = self.on_level(start + (end - start) * 0.5);
        self.navigate(Goal::Point(middle), AT_POINT, speed_of(pace))
    }

    /// Where a phrase leads, m.
    fn place(&mut self, reference: &Reference) -> Result<Point2, PlanError> {
        match &reference.target {
            Target::Point { x, y, .. } => Ok(Point2::new(*x, *y)),
            Target::Here => Ok(self.view.origin),
            _ => Ok(self.find(reference, Purpose::Any)?.access().xy()),
        }
    }

    fn is_here(&self, what: &Reference) -> PlanError {
        let near = format!("you stand on it: {}", self.view.surroundings());
        PlanError::NotFound { wanted: format!("way past {:?}", what.text), near }
    }
}

/// The corners of the way round a thing, counter-clockwise.
fn corners_around(thing: &EntityRef<'_>) -> [Point2; 4] {
    let obb = thing.obb();
    let (x, y) = (obb.half_extents.x + CLEARANCE, obb.half_extents.y + CLEARANCE);
    let frame = planar(&obb.pose);
    let ahead = (obb.pose.rotation * simworld_core::geometry::Vector3::x()).xy();
    let ahead = ahead.try_normalize(1e-9).unwrap_or_else(Vector2::x);
    let left = Vector2::new(-ahead.y, ahead.x);
    [(x, y), (-x, y), (-x, -y), (x, -y)].map(|(along, aside)| frame + ahead * along + left * aside)
}
