//! Edits of a city: streets, buildings and elements come, move and go, and only what they touch is made anew.
//!
//! An edit of a street cuts and joins the streets that it meets, derives the roads round it anew, and divides and builds on
//! the blocks on both its sides by the rules of the whole city, of the open land round a town as much as the change reaches.
//! Every block, lot, sidewalk and green draws from a stream of its own place, so what comes out is what the whole city would
//! be on the new streets; buildings that come out as they were keep their names and uses. What a map or a hand put there
//! ([`Building::given`], [`Element::along`]) stays as long as it has room.
//!
//! Numbers of roads, intersections, buildings and elements stay as they are, but for the last ones, which take the numbers
//! of what is gone. Every edit gives a [`CityPatch`] that takes it back to the bit.

mod around;
mod cells;
mod error;
mod faces;
mod in_world;
mod index;
mod moved;
mod outskirts;
mod patch;
mod reach;
mod replace;
mod scope;
mod sides;
mod streets;
mod things;
mod touched;

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, bounds};
use simworld_core::id::{IntersectionId, RoadId};
use simworld_core::net::{CrossSection, RoadClass, Street};

pub use error::EditError;
pub use in_world::{CityInWorld, FollowError, Followed};
pub use patch::{CityPatch, PlanPatch};

use crate::City;
use crate::building::Building;
use crate::element::Element;
use crate::graph::{NodeId, StreetId};
use crate::range::is_place;
use cells::inflated;
use index::Index;
use streets::with_neighbours;

/// A street to be built.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NewStreet {
    /// Its centreline, at least two points, m. It joins what it meets: a node within 1 m of an end or of a crossing, or else
    /// the street there, which is cut in two.
    pub course: Vec<Point2>,
    /// Its rank.
    pub class: RoadClass,
    /// Its cross-section.
    pub section: CrossSection,
    /// Its name, if it has one; that of another street makes it a part of that street.
    pub name: Option<String>,
    /// Its speed limit, m/s; that of its class if there is none.
    pub speed_limit: Option<f64>,
    /// 0 on the ground, above it for a bridge, which rises over what it crosses; see [`Street::level`].
    pub level: i8,
}

impl NewStreet {
    /// A local street with one lane each way.
    pub fn local(course: impl Into<Vec<Point2>>) -> Self {
        Self {
            course: course.into(),
            class: RoadClass::Local,
            section: CrossSection::default(),
            name: None,
            speed_limit: None,
            level: 0,
        }
    }
}

/// One change asked of a city.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum CityEdit {
    /// Builds a street.
    AddStreet(NewStreet),
    /// Takes a street away, and its ends where no other street meets it.
    RemoveStreet(RoadId),
    /// Moves a junction or an end of a street; the streets that meet there follow.
    MoveIntersection {
        /// Which.
        intersection: IntersectionId,
        /// Where to, m.
        to: Point2,
    },
    /// Puts up a building. Its door, road and zone follow from where it stands.
    AddBuilding(Box<Building>),
    /// Puts a building elsewhere.
    MoveBuilding {
        /// Its index in [`City::buildings`].
        building: usize,
        /// Where its middle goes, m.
        to: Point2,
        /// Where its entrance looks, radians.
        facing: f64,
    },
    /// Takes a building away.
    RemoveBuilding(usize),
    /// Sets an element.
    AddElement(Element),
    /// Puts an element elsewhere.
    MoveElement {
        /// Its index in [`City::elements`].
        element: usize,
        /// Where to, m.
        to: Point2,
        /// Where it looks, radians.
        facing: f64,
    },
    /// Takes an element away.
    RemoveElement(usize),
}

/// A city under edits, with what has to be known to find out what an edit touches.
///
/// ```
/// use simworld_citygen::edit::{CityEdit, CityEditor, NewStreet};
/// use simworld_citygen::{City, CityConfig};
/// use simworld_core::geometry::Point2;
/// use simworld_core::net::StreetPlan;
/// use simworld_core::seed::Seed;
/// // One large block and its surroundings.
/// let city = City::from_plan(StreetPlan::grid(2, 2, 220.0), &CityConfig::default(), Seed(5))?;
/// let mut editor = CityEditor::new(city.clone());
/// let street = NewStreet::local([Point2::new(0.0, 100.0), Point2::new(220.0, 110.0)]);
/// let undo = editor.apply(&CityEdit::AddStreet(street))?;
/// assert_eq!(editor.city().network.roads.len(), 7);
/// editor.put(undo)?;
/// assert_eq!(editor.into_city(), city);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct CityEditor {
    city: City,
    index: Index,
}

impl CityEditor {
    /// Takes a city to be edited. The time grows with the city, that of an edit with what it touches.
    pub fn new(mut city: City) -> Self {
        // Whoever else holds the network keeps theirs, now and not at the first edit.
        Arc::make_mut(&mut city.network);
        let index = Index::of(&city);
        Self { city, index }
    }

    /// The city as it is.
    pub fn city(&self) -> &City {
        &self.city
    }

    /// The city, edited.
    pub fn into_city(self) -> City {
        self.city
    }

    /// Carries out an edit; gives the patch that takes it back.
    ///
    /// # Errors
    /// The edit is impossible; then the city is as it was.
    pub fn apply(&mut self, edit: &CityEdit) -> Result<CityPatch, EditError> {
        match edit {
            CityEdit::AddStreet(street) => self.add_street(street),
            CityEdit::RemoveStreet(road) => self.remove_street(road.index()),
            CityEdit::MoveIntersection { intersection, to } => {
                self.move_intersection(intersection.index(), *to)
            }
            CityEdit::AddBuilding(building) => self.add_building(building),
            CityEdit::MoveBuilding { building, to, facing } => self.move_building(*building, *to, *facing),
            CityEdit::RemoveBuilding(building) => self.remove_building(*building),
            CityEdit::AddElement(element) => self.add_element(*element),
            CityEdit::MoveElement { element, to, facing } => self.move_element(*element, *to, *facing),
            CityEdit::RemoveElement(element) => self.remove_element(*element),
        }
    }

    /// Puts a patch on the city, as one that takes an edit back; gives the patch that takes it off again.
    ///
    /// # Errors
    /// A patch that is for another city; then this one is as it was.
    pub fn put(&mut self, patch: CityPatch) -> Result<CityPatch, EditError> {
        let back = patch.put_on(&mut self.city)?;
        self.index.follow(&self.city, &back);
        Ok(back)
    }

    fn add_street(&mut self, new: &NewStreet) -> Result<CityPatch, EditError> {
        let near = bounds(&new.course).filter(|(low, high)| is_place(low) && is_place(high));
        let near = near.map(|near| self.index.roads.near(inflated(near, 20.0))).unwrap_or_default();
        let part = self.city.plan.part(with_neighbours(&self.city.network, near));
        let like = Street {
            class: new.class,
            section: part.sections.len() as u32,
            name: new.name.as_ref().map(|_| part.names.len() as u32),
            speed_limit: new.speed_limit,
            level: new.level,
            ..Street::simple(0, 0)
        };
        let changed = self.change_streets(part, |graph| graph.add_street(&new.course, &like), Some(new))?;
        self.follow_streets(changed)
    }

    fn remove_street(&mut self, street: usize) -> Result<CityPatch, EditError> {
        missing("road", street, self.city.network.roads.len())?;
        let part = self.city.plan.part(with_neighbours(&self.city.network, [street].into()));
        // A street of the whole is one of its part.
        let local = part.street(street).unwrap_or(0) as u32;
        let changed = self.change_streets(part, |graph| graph.remove_street(StreetId(local)), None)?;
        self.follow_streets(changed)
    }

    fn move_intersection(&mut self, node: usize, to: Point2) -> Result<CityPatch, EditError> {
        missing("intersection", node, self.city.network.intersections.len())?;
        if !is_place(&to) {
            return Err(EditError::Size { what: "intersection" });
        }
        let at = &self.city.network.intersections[node].roads;
        let courses = at.iter().flat_map(|road| &self.city.network.roads[road.index()].centerline);
        let around = bounds(courses.chain([&to]));
        let mut near = around.map(|around| self.index.roads.near(inflated(around, 20.0))).unwrap_or_default();
        near.extend(at.iter().map(|road| road.index()));
        let part = self.city.plan.part(with_neighbours(&self.city.network, near));
        let local = part.node(node).map(|local| NodeId(local as u32));
        let Some(local) = local else { return Err(EditError::Size { what: "intersection without streets" }) };
        let changed = self.change_streets(part, |graph| graph.move_node(local, to), None)?;
        self.follow_streets(changed)
    }

    /// The network, copied first if somebody else holds it too.
    fn network_mut(&mut self) -> &mut simworld_core::net::RoadNetwork {
        Arc::make_mut(&mut self.city.network)
    }
}

fn missing(what: &'static str, index: usize, count: usize) -> Result<(), EditError> {
    if index < count { Ok(()) } else { Err(EditError::Missing { what, index, count }) }
}
