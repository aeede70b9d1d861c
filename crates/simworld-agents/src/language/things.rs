//! Orders to a plan: taking, giving, sitting, riding, doors and shops.

use simworld_core::action::{Action, ActionKind};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, EntityRef, SELLS};
use simworld_core::seam::{Goal, PlanError, PlanStep};

use super::clause::{Choice, Grip, Manner, Pace, Reference, Target, Vehicle};
use super::draft::{Draft, Load, Posture};
use super::lexicon::{Category, class, is_animate};
use super::relate::PART;
use super::resolve::{Purpose, sells};

impl<'a> Draft<'a> {
    pub(super) fn take_to(
        &mut self,
        what: &Reference,
        to: Option<&Reference>,
        grip: Grip,
    ) -> Result<(), PlanError> {
        if self.is_mount(what) {
            return self.go_on_to(to); // "take the car: drive it to the museum"
        }
        // "The suitcase must go to the bus, carry it there" says one thing twice.
        let brought = |to: &Reference| {
            to.target == Target::There
                || self.beside.is_some()
                    && self.view.find(to, Purpose::Any).ok().map(|to| to.id) == self.beside
        };
        if what.target == Target::It && to.is_some_and(brought) && self.is_done(Some(what), None) {
            return Ok(());
        }
        if what.target == Target::It && to.is_none() && self.is_done(Some(what), None) {
            return Ok(()); // "the parcel is for Hana, take it and give it to her"
        }
        if let Some(other) = self.another(what) {
            return self.take_to(&other, to, grip); // "pick up the letter and the parcel"
        }
        if self.is_in_hand(what) {
            return to.map_or(Ok(()), |to| self.drop(Some(what), Some(to), Manner::Deliver));
        }
        let item = self.find(what, Purpose::Item)?;
        if item.kind == EntityKind::Bench && grip == Grip::LiftOrRide && to.is_none() {
            return self.sit(Some(what)); // "take the blue bench"
        }
        if item.kind == EntityKind::Person && self.drives() {
            self.go_beside(&item)?; // a driver picks people up
            return self.go_on_to(to);
        }
        if item.kind.is_vehicle() && grip == Grip::LiftOrRide {
            self.board(&Reference::to(Target::Id(item.id), what.text.clone()))?; // "take the taxi to the school"
            return self.go_on_to(to);
        }
        let there = self.there_now();
        self.take(what)?;
        if to.is_some_and(|to| to.target == Target::There) {
            self.leads_there(there); // and not to what was taken
        }
        to.map_or(Ok(()), |to| self.bring(to, Manner::PutDown))
    }

    /// Another thing of a class than the one in hand, which nobody takes twice.
    fn another(&self, what: &Reference) -> Option<Reference> {
        let is_class = matches!(what.target, Target::Any(_)) && what.relation.is_none();
        let held = match self.held {
            Some(Load::Thing(id)) if is_class => id,
            _ => return None,
        };
        let found = self.view.candidates(what, Purpose::Item).ok()?;
        let is_first = found.first().is_some_and(|(_, id)| *id == held);
        let (_, other) = found.iter().find(|(_, id)| *id != held).filter(|_| is_first)?;
        Some(Reference::to(Target::Id(*other), what.text.clone()))
    }

    /// Whether the words stand for what one sits in or rides.
    fn is_mount(&self, what: &Reference) -> bool {
        let aboard = matches!(self.posture, Posture::Aboard | Posture::Riding);
        let hands_empty = self.held.is_none() && self.carried.is_none();
        let spoken_of = what.target == Target::It && hands_empty
            || !matches!(what.target, Target::It | Target::Them | Target::There | Target::Here)
                && self.view.find(what, Purpose::Any).is_ok_and(|found| self.mount == Some(found.id));
        aboard && self.mount.is_some() && spoken_of
    }

    /// Whether the words stand for what is in hand already.
    fn is_in_hand(&self, what: &Reference) -> bool {
        let held = match self.held {
            Some(Load::Bought) => true,
            Some(Load::Thing(id)) => self.view.it == Some(id) || self.view.it.is_none(),
            None => self.carried.is_some(),
        };
        held && what.target == Target::It
    }

    fn take(&mut self, what: &Reference) -> Result<(), PlanError> {
        self.can(ActionKind::PickUp)?;
        let item = self.find(what, Purpose::Item)?;
        if self.held == Some(Load::Thing(item.id)) || self.carried == Some(item.id) {
            return Ok(());
        }
        let id = item.id;
        let action = match item.kind {
            EntityKind::Parcel => Action::PickUp { item: id },
            EntityKind::Chair | EntityKind::Cone | EntityKind::Prop => Action::CarryHeavy { item: id },
            other => {
                let near = format!("a {other} cannot be taken; parcels, chairs, cones and props can");
                return Err(PlanError::NotFound { wanted: format!("{:?} to take", what.text), near });
            }
        };
        let full = match &action {
            Action::PickUp { .. } => self.held.is_some(),
            _ => self.carried.is_some(),
        };
        if full {
            let wanted = format!("free hand to take {:?}", what.text);
            return Err(PlanError::NotFound { wanted, near: self.in_hand() });
        }
        self.go_beside(&item)?;
        match action {
            Action::PickUp { .. } => self.held = Some(Load::Thing(id)),
            _ => self.carried = Some(id),
        }
        self.beside = None; // it comes along
        self.act(action)
    }

    pub(super) fn drop(
        &mut self,
        what: Option<&Reference>,
        at: Option<&Reference>,
        manner: Manner,
    ) -> Result<(), PlanError> {
        let bought = self.of_what_was_bought(what);
        let what = bought.as_ref().or(what);
        // "Go to the bin and drop it there": one is there.
        let in_hand = self.held.is_some() || self.carried.is_some();
        let at = at.filter(|at| !(at.target == Target::There && in_hand && self.stands_there()));
        let is_there = at.is_none_or(|at| matches!(at.target, Target::There | Target::Here));
        if is_there && self.is_done(what, None) {
            return Ok(());
        }
        if what.is_some_and(|what| self.is_mount(what)) {
            let stays = |at: &&Reference| at.target != Target::There;
            self.go_on_to(at.filter(stays))?; // "drive the car to the clinic and leave it there"
            return self.alight(Vehicle::Any);
        }
        // What one has in hand is what "it" is about here, whatever was spoken of since.
        let in_hand = self.held.is_some() || self.carried.is_some();
        if let Some(what) = what.filter(|what| !(in_hand && what.target == Target::It)) {
            let in_hand = self.what_is_in_hand(what);
            let item = in_hand.map_or_else(|| self.find(what, Purpose::Item), Ok)?;
            let in_hand = self.held == Some(Load::Thing(item.id)) || self.carried == Some(item.id);
            if !in_hand && (manner == Manner::Deliver || at.is_some()) {
                let there = self.there_now();
                self.take(what)?;
                if at.is_some_and(|at| at.target == Target::There) {
                    self.leads_there(there);
                }
            } else if !in_hand {
                return Err(self.nothing_in_hand(&what.text));
            }
        }
        match at {
            Some(at) => self.bring(at, manner),
            None => self.let_go(if manner == Manner::Deliver { Manner::PutDown } else { manner }),
        }
    }

    /// What one has in hand, if the words fit it and do not choose among others: who took the nearest package means that one by "the
    /// package", also where another is nearer by then.
    fn what_is_in_hand(&mut self, what: &Reference) -> Option<EntityRef<'a>> {
        let held = match self.held {
            Some(Load::Thing(id)) => Some(id),
            _ => self.carried,
        };
        let item = held.and_then(|id| self.view.scene.entity(id))?;
        let is_plain = what.choice == Choice::Open && what.relation.is_none() && !what.traits.other;
        let is_meant = is_plain && self.view.fits(&item, what, Purpose::Any);
        is_meant.then(|| {
            self.mention(&item);
            item
        })
    }

    /// Goes with what is in hand, and gives it to whoever is there, or puts it down.
    fn bring(&mut self, to: &Reference, manner: Manner) -> Result<(), PlanError> {
        let it = self.view.it;
        let goes_to_thing = !matches!(to.target, Target::There | Target::Here | Target::Point { .. });
        let is_there = goes_to_thing
            && self.beside.is_some()
            && self.view.find(to, Purpose::Any).ok().map(|to| to.id) == self.beside;
        if !is_there {
            self.go(to, None, Pace::Usual, None)?;
        }
        let receiver = self.beside.and_then(|id| self.view.scene.entity(id));
        if let Some(receiver) = receiver.filter(|receiver| self.held.is_some() && takes(receiver)) {
            self.let_out(self.held, Some(receiver.id));
            self.held = None;
            return self.act(Action::Give { to: receiver.id });
        }
        self.view.it = it.or(self.view.it);
        self.let_go(if manner == Manner::Deliver { Manner::PutDown } else { manner })
    }

    pub(super) fn give(&mut self, what: Option<&Reference>, to: &Reference) -> Result<(), PlanError> {
        let bought = self.of_what_was_bought(what);
        let what = bought.as_ref().or(what);
        let receiver = self.view.find(to, Purpose::Any)?;
        if !takes(&receiver) {
            let near = format!("a {} takes nothing: {}", receiver.kind, self.view.surroundings());
            return Err(PlanError::NotFound { wanted: format!("{:?} to give things to", to.text), near });
        }
        if self.is_done(what, Some(receiver.id)) {
            return Ok(());
        }
        let to = Reference::to(Target::Id(receiver.id), to.text.clone());
        if let Some(what) = what.filter(|what| !self.is_in_hand(what)) {
            self.take(what)?;
        } else if self.held.is_none() {
            return Err(self.nothing_in_hand("thing"));
        }
        self.bring(&to, Manner::DropOff)
    }

    /// Throws what is in hand, or is taken first, at somebody, from near enough.
    pub(super) fn throw(&mut self, what: Option<&Reference>, to: &Reference) -> Result<(), PlanError> {
        /// From so far an arm throws everything that a hand lifts, m, and what is light.
        const REACHES: [f64; 2] = [2.5, 8.0];
        /// The most that is light, kg.
        const LIGHT: f64 = 2.0;
        let receiver = self.view.find(to, Purpose::Any)?;
        if !takes(&receiver) {
            let near = format!("nothing is thrown at a {}: {}", receiver.kind, self.view.surroundings());
            return Err(PlanError::NotFound { wanted: format!("{:?} to throw things to", to.text), near });
        }
        if let Some(what) = what.filter(|what| !self.is_in_hand(what)) {
            self.take(what)?;
        } else if self.held.is_none() && self.carried.is_none() {
            return Err(self.nothing_in_hand("thing"));
        }
        let to = Reference::to(Target::Id(receiver.id), to.text.clone());
        let load = self.held.take().or_else(|| self.carried.take().map(Load::Thing));
        let mass = match load {
            Some(Load::Thing(item)) => self.view.scene.entity(item).and_then(|it| it.mass(self.view.scene)),
            _ => None,
        };
        let is_light = mass.is_some_and(|mass| mass <= LIGHT);
        self.go(&to, None, Pace::Usual, Some(REACHES[usize::from(is_light)]))?;
        self.beside = None; // it stands apart
        self.push(PlanStep::Face { to: Goal::Entity(receiver.id) });
        self.let_out(load, None);
        self.act(Action::ThrowTo { to: receiver.id })
    }

    fn let_go(&mut self, manner: Manner) -> Result<(), PlanError> {
        let heavy = manner == Manner::PutDown && self.carried.is_some()
            || self.held.is_none() && self.carried.is_some();
        if heavy {
            self.view.it = self.carried.take();
            self.let_out(self.view.it.map(Load::Thing), None);
            return self.act(Action::PutDownHeavy);
        }
        let held = self.held.take();
        self.let_out(held, None);
        match held {
            Some(Load::Thing(item)) => self.view.it = Some(item),
            Some(Load::Bought) => {}
            None => return Err(self.nothing_in_hand("thing")),
        }
        self.act(Action::DropOff)
    }

    /// Remembers what left the hands: it stands elsewhere by then than the scene shows.
    fn let_out(&mut self, load: Option<Load>, to: Option<EntityId>) {
        if let Some(Load::Thing(item)) = load {
            self.view.gone.push(item);
        }
        self.delivered = load.map(|load| (load, to));
    }

    /// Whether the words say again what was done by the last order: "carry it there and leave it there".
    fn is_done(&self, what: Option<&Reference>, to: Option<EntityId>) -> bool {
        let Some((load, receiver)) = self.delivered else { return false };
        let same = what.is_none_or(|what| what.target == Target::It);
        let spoken_of = match load {
            Load::Thing(item) => self.view.it == Some(item),
            Load::Bought => self.view.it.is_none(),
        };
        self.held.is_none() && self.carried.is_none() && same && spoken_of && (to.is_none() || to == receiver)
    }

    /// "Buy matches, bring them to Oscar": goods in the plural are what one has in hand.
    fn of_what_was_bought(&self, what: Option<&Reference>) -> Option<Reference> {
        let plural = what.filter(|what| what.target == Target::Them && what.text == "them")?;
        (self.held == Some(Load::Bought)).then(|| Reference { target: Target::It, ..plural.clone() })
    }

    fn nothing_in_hand(&self, wanted: &str) -> PlanError {
        PlanError::NotFound { wanted: format!("{wanted} in hand"), near: self.in_hand() }
    }

    fn in_hand(&self) -> String {
        let held = match self.held {
            Some(Load::Thing(id)) => Some(id),
            Some(Load::Bought) => return "you hold what you bought".to_owned(),
            None => self.carried,
        };
        match held.and_then(|id| self.view.scene.entity(id)) {
            Some(item) => format!("you hold {} {}", item.label(), item.id),
            None => "your hands are empty".to_owned(),
        }
    }

    pub(super) fn sit(&mut self, on: Option<&Reference>) -> Result<(), PlanError> {
        // A dog that is told to sit by the tree goes there.
        if self.kind == EntityKind::Dog
            && let Some(Reference { relation: Some(super::clause::Stands::To(_, anchor)), .. }) = on
        {
            return self.go(anchor, None, Pace::Usual, None);
        }
        self.can(ActionKind::SitDown)?;
        let seat = match on {
            Some(reference) => {
                let seat = self.find(reference, Purpose::Seat)?;
                if seat.kind.is_vehicle() && !self.drives() {
                    return self.board(&Reference::to(Target::Id(seat.id), reference.text.clone())); // "sit in the car"
                }
                seat
            }
            None => self.any_seat()?,
        };
        if !seat.kind.is_seat() {
            let near = format!("{} {} is no seat: {}", seat.label(), seat.id, self.view.surroundings());
            return Err(PlanError::NotFound { wanted: "seat of that description".to_owned(), near });
        }
        self.mention(&seat);
        self.go_beside(&seat)?;
        self.posture = Posture::Seated;
        self.act(Action::SitDown { seat: seat.id })
    }

    /// The seat that was spoken of, or else the nearest free one.
    fn any_seat(&self) -> Result<EntityRef<'a>, PlanError> {
        let spoken_of = self.view.it.and_then(|id| self.view.scene.entity(id));
        if let Some(seat) = spoken_of.filter(|entity| entity.kind.is_seat()) {
            return Ok(seat);
        }
        self.view.find(&Reference { indefinite: true, ..Reference::nearest(Category::seat()) }, Purpose::Seat)
    }

    pub(super) fn board(&mut self, what: &Reference) -> Result<(), PlanError> {
        self.can(ActionKind::EnterCar)?;
        let vehicle = self.find(what, Purpose::Any)?;
        let action = match vehicle.kind {
            EntityKind::Scooter => Action::RideScooter { scooter: vehicle.id },
            EntityKind::Car
            | EntityKind::Truck
            | EntityKind::Bus
            | EntityKind::Motorcycle
            | EntityKind::Bicycle => Action::EnterCar { car: vehicle.id },
            EntityKind::Door if what.target == Target::It => {
                let house =
                    self.view.scene.nearest(vehicle.planar(), PART, &|at| at.kind == EntityKind::Building);
                return self.go_beside(&house.unwrap_or(vehicle)); // "go in"
            }
            EntityKind::Building | EntityKind::Door | EntityKind::Crosswalk => {
                return self.go_beside(&vehicle);
            }
            other => {
                let near = format!(
                    "a {other} cannot be; scooters, bicycles, motorcycles, cars, trucks and buses can"
                );
                return Err(PlanError::NotFound {
                    wanted: format!("{:?} to get on or into", what.text),
                    near,
                });
            }
        };
        if matches!(self.posture, Posture::Aboard | Posture::Riding) && self.mount == Some(vehicle.id) {
            return Ok(()); // one sits in it already
        }
        self.mount = Some(vehicle.id);
        self.go_beside(&vehicle)?;
        self.posture = if vehicle.kind == EntityKind::Scooter { Posture::Riding } else { Posture::Aboard };
        self.act(action)
    }

    pub(super) fn alight(&mut self, from: Vehicle) -> Result<(), PlanError> {
        let scooter = match from {
            Vehicle::Scooter => true,
            Vehicle::Car => false,
            Vehicle::Any => self.posture != Posture::Aboard,
        };
        self.posture = Posture::Standing;
        self.act(if scooter { Action::GetOffScooter } else { Action::ExitCar })
    }

    /// Goes by what one is in or on, or else by the nearest car.
    pub(super) fn drive(&mut self, to: &Reference, pace: Pace) -> Result<(), PlanError> {
        if !self.drives() && !matches!(self.posture, Posture::Aboard | Posture::Riding) {
            self.board(&Reference { indefinite: true, ..Reference::nearest(class("car")) })?;
        }
        self.go(to, None, pace, None)
    }

    pub(super) fn door(&mut self, what: Option<&Reference>, open: bool) -> Result<(), PlanError> {
        self.can(ActionKind::OpenDoor)?;
        let nearest = Reference { indefinite: true, ..Reference::nearest(class("door")) };
        let door = self.find(what.unwrap_or(&nearest), Purpose::Any)?;
        let is_door =
            door.kind == EntityKind::Door || door.kind == EntityKind::Building && door.info.access.is_some();
        if !is_door {
            let near = format!("a {} has no door", door.kind);
            let text = what.map_or("door", |what| what.text.as_str());
            return Err(PlanError::NotFound { wanted: format!("{text:?} to open or close"), near });
        }
        self.go_beside(&door)?;
        self.act(if open { Action::OpenDoor { door: door.id } } else { Action::CloseDoor { door: door.id } })
    }

    /// At the nearest place that sells it.
    pub(super) fn buy(
        &mut self,
        goods: &str,
        times: u32,
        at: Option<&Reference>,
        whom: Option<&Reference>,
    ) -> Result<(), PlanError> {
        let before = self.steps_so_far();
        self.purchase(goods, at)?;
        if let Some(whom) = whom {
            self.give(None, whom)?;
        }
        if times > 1 {
            let steps = self.take_back(before);
            self.push(PlanStep::Repeat { times, steps });
        }
        Ok(())
    }

    /// The house whose door was spoken of last.
    fn house_of_door(&self) -> Option<EntityRef<'a>> {
        let door = self
            .view
            .it
            .and_then(|id| self.view.scene.entity(id))
            .filter(|it| it.kind == EntityKind::Door)?;
        self.view.scene.nearest(door.planar(), PART, &|at| at.kind == EntityKind::Building)
    }

    /// The place that "there" stands for, if anything is sold there or nothing else is done in it; with a door its house.
    fn shop_there(&self) -> Option<EntityRef<'a>> {
        let there = self.gone_to().and_then(|id| self.view.scene.entity(id))?;
        match there.kind {
            EntityKind::Building => Some(there),
            EntityKind::Door => {
                self.view.scene.nearest(there.planar(), PART, &|at| at.kind == EntityKind::Building)
            }
            _ => Some(there).filter(|there| there.info.attributes.contains_key(SELLS)),
        }
    }

    fn purchase(&mut self, goods: &str, at: Option<&Reference>) -> Result<(), PlanError> {
        let sells = |place: &EntityRef<'_>| sells(place, goods);
        self.can(ActionKind::Buy)?;
        let not_sold = |near: String| PlanError::NotFound { wanted: format!("{goods} to buy"), near };
        let there = at.filter(|at| at.target == Target::There).and_then(|_| self.shop_there());
        let place = if let Some(there) = there {
            there
        } else if let Some(at) = at.filter(|at| at.target != Target::There) {
            self.find(at, Purpose::Any)?
        } else {
            let here = self.beside.and_then(|id| self.view.scene.entity(id)).filter(sells);
            let here = here.or_else(|| self.house_of_door().filter(sells));
            let nearest = || self.view.scene.nearest(self.view.from, self.view.range, &sells);
            here.or_else(nearest).ok_or_else(|| not_sold(self.view.surroundings()))?
        };
        if !sells(&place) {
            return Err(not_sold(format!("{} {} does not sell it", place.label(), place.id)));
        }
        if self.held.is_some() {
            let wanted = format!("free hand to buy {goods:?}");
            return Err(PlanError::NotFound { wanted, near: self.in_hand() });
        }
        self.go_beside(&place)?;
        self.held = Some(Load::Bought);
        self.view.it = None;
        self.act(Action::Buy { goods: goods.to_owned(), from: place.id })
    }
}

fn takes(entity: &EntityRef<'_>) -> bool {
    is_animate(entity.kind) && entity.kind != EntityKind::Dog
}
