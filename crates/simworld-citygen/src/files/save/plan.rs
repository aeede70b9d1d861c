//! The plan of streets: as it was saved before ways were known lane by lane, and a section of its own for those ways. Where
//! there are none that section is left out, so that the bytes are those of before.

use std::collections::BTreeMap;
use std::io::Write;

use serde::{Deserialize, Serialize, Serializer};
use simworld_core::geometry::Point2;
use simworld_core::net::{
    self, Control, CrossSection, DrivingSide, LaneWays, RoadClass, StreetPlan, TurnLanes, TurnSet,
};

use super::SaveError;
use super::frame::{Sections, Tag, Writer};

/// A plan, as it is written.
#[derive(Serialize)]
struct Written<'a> {
    nodes: &'a [Point2],
    #[serde(serialize_with = "streets")]
    streets: &'a [net::Street],
    sections: &'a [CrossSection],
    names: &'a [String],
    controls: &'a BTreeMap<usize, Control>,
    driving_side: DrivingSide,
    elevations: &'a [f64],
}

/// A street of it.
#[derive(Serialize)]
struct WrittenStreet<'a> {
    from: usize,
    to: usize,
    via: &'a [Point2],
    class: RoadClass,
    section: u32,
    name: Option<u32>,
    speed_limit: Option<f64>,
    turns: (&'a [TurnSet], &'a [TurnSet]),
    roundabout: bool,
    level: i8,
    turning: [f64; 2],
    profile: &'a [(f64, f64)],
    hammerhead: [bool; 2],
}

/// And as it is read.
#[derive(Deserialize)]
struct Plain {
    nodes: Vec<Point2>,
    streets: Vec<PlainStreet>,
    sections: Vec<CrossSection>,
    names: Vec<String>,
    controls: BTreeMap<usize, Control>,
    driving_side: DrivingSide,
    elevations: Vec<f64>,
}

#[derive(Deserialize)]
struct PlainStreet {
    from: usize,
    to: usize,
    via: Vec<Point2>,
    class: RoadClass,
    section: u32,
    name: Option<u32>,
    speed_limit: Option<f64>,
    turns: (Vec<TurnSet>, Vec<TurnSet>),
    roundabout: bool,
    level: i8,
    turning: [f64; 2],
    profile: Vec<(f64, f64)>,
    hammerhead: [bool; 2],
}

/// What is known lane by lane at the end and at the beginning of a street.
#[derive(Serialize, Deserialize)]
struct Known {
    /// Its index.
    street: u32,
    forward: Vec<LaneWays>,
    backward: Vec<LaneWays>,
}

fn streets<S: Serializer>(streets: &[net::Street], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(streets.iter().map(|street| WrittenStreet {
        from: street.from,
        to: street.to,
        via: &street.via,
        class: street.class,
        section: street.section,
        name: street.name,
        speed_limit: street.speed_limit,
        turns: (&street.turns.forward, &street.turns.backward),
        roundabout: street.roundabout,
        level: street.level,
        turning: street.turning,
        profile: &street.profile,
        hammerhead: street.hammerhead,
    }))
}

impl From<PlainStreet> for net::Street {
    fn from(plain: PlainStreet) -> Self {
        let (forward, backward) = plain.turns;
        Self {
            from: plain.from,
            to: plain.to,
            via: plain.via,
            class: plain.class,
            section: plain.section,
            name: plain.name,
            speed_limit: plain.speed_limit,
            turns: TurnLanes { forward, backward, ..TurnLanes::default() }.into(),
            roundabout: plain.roundabout,
            level: plain.level,
            turning: plain.turning,
            profile: plain.profile.into(),
            hammerhead: plain.hammerhead,
        }
    }
}

impl From<Plain> for StreetPlan {
    fn from(plain: Plain) -> Self {
        Self {
            nodes: plain.nodes,
            streets: plain.streets.into_iter().map(Into::into).collect(),
            sections: plain.sections,
            names: plain.names,
            controls: plain.controls,
            driving_side: plain.driving_side,
            elevations: plain.elevations,
        }
    }
}

pub(super) fn write<W: Write>(frames: &mut Writer<'_, W>, plan: &StreetPlan) -> Result<(), SaveError> {
    let StreetPlan { nodes, streets, sections, names, controls, driving_side, elevations } = plan;
    let driving_side = *driving_side;
    let written = Written { nodes, streets, sections, names, controls, driving_side, elevations };
    frames.section(Tag::Plan, &written)?;
    let are_known = |(_, street): &(u32, &net::Street)| {
        !(street.turns.forward_ways.is_empty() && street.turns.backward_ways.is_empty())
    };
    let known = (0..).zip(streets).filter(are_known).map(|(index, street)| Known {
        street: index,
        forward: street.turns.forward_ways.clone(),
        backward: street.turns.backward_ways.clone(),
    });
    let known: Vec<Known> = known.collect();
    if known.is_empty() { Ok(()) } else { frames.section(Tag::Ways, &known) }
}

/// Not yet validated.
pub(super) fn read(sections: &Sections<'_>) -> Result<StreetPlan, SaveError> {
    let mut plan: StreetPlan = sections.one::<Plain>(Tag::Plan)?.into();
    let known: Vec<Known> = if sections.have(Tag::Ways) { sections.one(Tag::Ways)? } else { Vec::new() };
    for Known { street: index, forward, backward } in known {
        let lost = SaveError::Unsound {
            what: Tag::Ways.name(),
            index: index as usize,
            fault: "are those of a street that is not there",
        };
        let street = plan.streets.get_mut(index as usize).ok_or(lost)?;
        (street.turns.forward_ways, street.turns.backward_ways) = (forward, backward);
    }
    Ok(plan)
}
