//! Edits as data: what a sentence, a model or a program asks of a scene, with things by their ids.

use serde::{Deserialize, Serialize};
use simworld_core::environment::Environment;
use simworld_core::geometry::Point2;
use simworld_core::id::{EntityId, IntersectionId, RoadId};
use simworld_core::passage::Passage;
use simworld_core::scene::Relation;

/// One change of a scene, or one question about it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Edit {
    /// Puts new things into the scene.
    Add {
        /// What.
        make: Make,
        /// How many, at least one.
        count: u32,
        /// How they stand to what is there; all of it must hold. Nothing: somewhere near the viewpoint.
        stands: Vec<Stand>,
    },
    /// Puts new things into a row, evenly: all of them, or with an answer that says how many places were left out.
    Row {
        /// What.
        make: Make,
        /// Along what.
        line: Line,
        /// How far apart, or how many.
        spacing: Spacing,
    },
    /// Takes things out; what stood on them, or was held by them, is set down on what is below, and the answer says so.
    Remove {
        /// Which.
        things: Vec<EntityId>,
    },
    /// Puts things elsewhere, with what stands on them.
    Move {
        /// Which.
        things: Vec<EntityId>,
        /// How they stand afterwards.
        stands: Vec<Stand>,
    },
    /// Turns things where they stand, with what stands on them.
    Rotate {
        /// Which.
        things: Vec<EntityId>,
        /// Radians, positive to the left.
        angle: f64,
    },
    /// Turns things towards another.
    Face {
        /// Which.
        things: Vec<EntityId>,
        /// Towards what.
        towards: EntityId,
    },
    /// Has two things change places, with what stands on them; each is turned as the other was.
    Swap {
        /// One.
        one: EntityId,
        /// The other.
        other: EntityId,
    },
    /// Gives things another colour.
    Paint {
        /// Which.
        things: Vec<EntityId>,
        /// Linear-light sRGB primaries in [0, 1].
        color: [f32; 3],
    },
    /// Makes things larger or smaller, in all three directions; what stands on them stands on their new tops.
    Scale {
        /// Which.
        things: Vec<EntityId>,
        /// 2 is twice as long, wide and high.
        factor: f64,
    },
    /// Makes more of a thing.
    Copy {
        /// Which.
        thing: EntityId,
        /// How many more.
        count: u32,
        /// How they stand. Nothing: near the thing itself.
        stands: Vec<Stand>,
    },
    /// Gives a thing a name.
    Name {
        /// Which.
        thing: EntityId,
        /// The name.
        name: String,
    },
    /// Sets sun and weather.
    SetEnvironment(Environment),
    /// Closes streets to traffic, both ways, or opens them.
    SetPassage {
        /// The pieces of streets, from junction to junction.
        roads: Vec<RoadId>,
        /// Whether traffic may enter from now on.
        passage: Passage,
    },
    /// Changes nothing, and says why: what was asked only on a condition that does not hold.
    Leave {
        /// Why.
        why: String,
    },
    /// Asks how many there are.
    Count {
        /// Of what, in the words of the question.
        what: String,
        /// Those that fit.
        things: Vec<EntityId>,
    },
    /// Asks what there is.
    List {
        /// Those that fit, the nearest first.
        things: Vec<EntityId>,
    },
    /// Asks what something is.
    Describe {
        /// What.
        thing: EntityId,
    },
}

/// What is to be made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Make {
    /// The name of an asset of the editor's catalogue.
    pub asset: String,
    /// Another colour than the asset's, linear-light sRGB.
    pub color: Option<[f32; 3]>,
    /// Its size over the asset's, 1 by default.
    pub scale: f64,
    /// What people are to call it.
    pub name: Option<String>,
}

impl Make {
    /// A thing just as the asset is.
    pub fn of(asset: impl Into<String>) -> Self {
        Self { asset: asset.into(), color: None, scale: 1.0, name: None }
    }
}

/// Where a row of things stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Line {
    /// Beyond the kerb of a street, from its beginning to its end.
    Road {
        /// The pieces of the street.
        roads: Vec<RoadId>,
        /// On which side.
        sides: Sides,
    },
    /// As [`Line::Road`], on the side that lies in a direction.
    RoadSide {
        /// The pieces of the street.
        roads: Vec<RoadId>,
        /// To which side, radians from east.
        heading: f64,
    },
    /// Along one of the long sides of a thing.
    Along {
        /// Which thing.
        anchor: EntityId,
    },
    /// Straight from one thing to another, or beside that line if something stands on it.
    Between {
        /// From which.
        one: EntityId,
        /// To which.
        other: EntityId,
    },
    /// In a circle around a thing.
    Around {
        /// Which thing.
        anchor: EntityId,
    },
}

/// On which side of a street.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sides {
    /// On that which has more room.
    #[default]
    Either,
    /// On both.
    Both,
}

/// How the places of a row are told off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Spacing {
    /// One every so many metres. Where something is in the way it stands up to a tenth of that farther on or back, or is left out.
    Every(f64),
    /// So many, as far from each other as the line allows.
    Count(u32),
}

/// How a thing stands to what is there. Each is a test ([`Stand::holds`]) and a region that things are put into.
///
/// `left`, `right`, `front` and `behind` are seen from the thing that is named, as in [`Relation`]: in front of a
/// building is where its entrance looks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Stand {
    /// In a relation to one thing.
    To {
        /// Which relation.
        relation: Relation,
        /// To what.
        anchor: EntityId,
    },
    /// Between the middles of two things, and not farther beside the line than a third of its length or 2 m.
    Between {
        /// One of them.
        one: EntityId,
        /// The other.
        other: EntityId,
    },
    /// On the other side of the street, at most 60 m from the thing; where no street is within 60 m, 5 to 60 m off in the
    /// quarter before it.
    AcrossFrom {
        /// From what.
        anchor: EntityId,
    },
    /// Beside one of its long sides, at most 4 m off.
    Along {
        /// Along what.
        anchor: EntityId,
    },
    /// On the edge of a street, at most 6 m from its kerb.
    AlongRoad {
        /// The pieces of the street.
        roads: Vec<RoadId>,
    },
    /// On a side of a street, seen from its middle.
    OnSide {
        /// The pieces of the street.
        roads: Vec<RoadId>,
        /// To which side, radians from east.
        heading: f64,
    },
    /// At most 3 m from a corner of its footprint.
    AtCornerOf {
        /// Of what.
        anchor: EntityId,
    },
    /// Within 45° of a direction from a thing, at most 60 m from it.
    Towards {
        /// Radians from east.
        heading: f64,
        /// Seen from what.
        anchor: EntityId,
    },
    /// So far off in a direction: the gap between the two is the distance, within a quarter of a metre or a twentieth, and its
    /// middle lies within 6° of the direction, seen from the middle of the thing.
    Offset {
        /// From what.
        anchor: EntityId,
        /// Radians from east.
        heading: f64,
        /// m.
        distance: f64,
    },
    /// With a gap between the two that is no less and no more, m.
    Apart {
        /// From what.
        anchor: EntityId,
        /// The least gap, m.
        least: f64,
        /// The greatest gap, m.
        most: f64,
    },
    /// On the same block: no street lies between the middles of the two, which are at most 250 m apart.
    OnBlockOf {
        /// Of what.
        anchor: EntityId,
    },
    /// In the middle of an area: within a tenth of its size, or 2 m, of the middle.
    InMiddleOf {
        /// Of what.
        anchor: EntityId,
    },
    /// At most 2 m inside or outside the edge of an area.
    AtEdgeOf {
        /// Of what.
        anchor: EntityId,
    },
    /// At a junction: at most 20 m from where its streets meet.
    AtJunction {
        /// Which.
        junction: IntersectionId,
    },
    /// At a point, exactly.
    At {
        /// World frame, m.
        point: Point2,
    },
    /// Within 25 m of a point.
    Around {
        /// World frame, m.
        point: Point2,
    },
}
