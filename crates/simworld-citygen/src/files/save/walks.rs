//! Ways for walkers: as they were saved before they had levels, and sections of their own for those that lie off the ground
//! or are built over, for those of them that are steps, and for plazas. Where there are none a section is left out, so that
//! the bytes are those of before.

use std::io::Write;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::id::PlazaId;
use simworld_core::net::{Footpath, Plaza, RoadNetwork};

use super::SaveError;
use super::frame::{Sections, Tag, Writer};

/// A way on the ground, as it is written.
#[derive(Serialize)]
struct Written<'a> {
    path: &'a [Point2],
    width: f64,
    joins: [bool; 2],
}

/// And as it is read.
#[derive(Deserialize)]
struct Plain {
    path: Vec<Point2>,
    width: f64,
    joins: [bool; 2],
}

/// What is not so of one of them.
#[derive(Serialize, Deserialize)]
struct OffGround {
    /// Its index.
    way: u32,
    level: i8,
    covered: bool,
}

/// Open ground, and the indices of the ways across it.
#[derive(Serialize, Deserialize)]
struct Open<P> {
    plaza: P,
    ways: Vec<u32>,
}

pub(super) fn write<W: Write>(frames: &mut Writer<'_, W>, network: &RoadNetwork) -> Result<(), SaveError> {
    let ways = &network.footpaths;
    let written: Vec<Written<'_>> =
        ways.iter().map(|way| Written { path: &way.path, width: way.width, joins: way.joins }).collect();
    frames.list(Tag::Footpaths, &written)?;
    let off_ground = ways.iter().enumerate().filter(|(_, way)| way.level != 0 || way.covered);
    let levels: Vec<OffGround> = off_ground
        .map(|(index, way)| OffGround { way: index as u32, level: way.level, covered: way.covered })
        .collect();
    if !levels.is_empty() {
        frames.section(Tag::Levels, &levels)?;
    }
    let steps = ways.iter().enumerate().filter(|(_, way)| way.steps);
    let steps: Vec<u32> = steps.map(|(index, _)| index as u32).collect();
    if !steps.is_empty() {
        frames.section(Tag::Steps, &steps)?;
    }
    let mut open: Vec<Open<&Plaza>> =
        network.plazas.iter().map(|plaza| Open { plaza, ways: Vec::new() }).collect();
    for (way, path) in (0..).zip(ways) {
        if let Some(open) = path.plaza.and_then(|plaza| open.get_mut(plaza.index())) {
            open.ways.push(way);
        }
    }
    if open.is_empty() { Ok(()) } else { frames.section(Tag::Plazas, &open) }
}

/// The ways and the plazas.
pub(super) fn read(sections: &Sections<'_>, count: u64) -> Result<(Vec<Footpath>, Vec<Plaza>), SaveError> {
    let plain: Vec<Plain> = sections.list(Tag::Footpaths, count)?;
    let ways = plain.into_iter().map(|Plain { path, width, joins }| Footpath {
        path,
        width,
        joins,
        ..Footpath::default()
    });
    let mut ways: Vec<Footpath> = ways.collect();
    let levels: Vec<OffGround> =
        if sections.have(Tag::Levels) { sections.one(Tag::Levels)? } else { Vec::new() };
    for OffGround { way, level, covered } in levels {
        let way = named(&mut ways, way, Tag::Levels)?;
        (way.level, way.covered) = (level, covered);
    }
    let steps: Vec<u32> = if sections.have(Tag::Steps) { sections.one(Tag::Steps)? } else { Vec::new() };
    for way in steps {
        named(&mut ways, way, Tag::Steps)?.steps = true;
    }
    let open: Vec<Open<Plaza>> =
        if sections.have(Tag::Plazas) { sections.one(Tag::Plazas)? } else { Vec::new() };
    let mut plazas = Vec::with_capacity(open.len());
    for Open { plaza, ways: across } in open {
        for index in across {
            named(&mut ways, index, Tag::Plazas)?.plaza = Some(PlazaId::from_index(plazas.len()));
        }
        plazas.push(plaza);
    }
    Ok((ways, plazas))
}

/// The way that a section names.
fn named(ways: &mut [Footpath], index: u32, section: Tag) -> Result<&mut Footpath, SaveError> {
    let lost = SaveError::Unsound {
        what: section.name(),
        index: index as usize,
        fault: "refers to a way that is not there",
    };
    ways.get_mut(index as usize).ok_or(lost)
}
