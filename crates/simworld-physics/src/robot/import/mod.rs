//! Robots from files: what the readers share.
//!
//! Files may come from strangers. What is read is bounded, meshes lie in one folder, and nothing panics: what cannot be a robot
//! is a [`RobotError`] that says where, and what was approximated stands in the report.

pub(super) mod color;
mod mesh;
#[cfg(feature = "mjcf")]
pub mod mjcf;
#[cfg(feature = "mjcf")]
mod mjcf_contacts;
#[cfg(feature = "mjcf")]
mod mjcf_geoms;
#[cfg(feature = "mjcf")]
mod mjcf_motors;
#[cfg(feature = "mjcf")]
mod mjcf_read;
#[cfg(feature = "urdf")]
pub mod urdf;
mod xml;

use std::collections::BTreeMap;
use std::fmt;
use std::path::PathBuf;

use simworld_core::geometry::Pose;

use super::description::Base;
use super::{LinkDescription, LinkVisual, RobotDescription, RobotError, Surface, VisualForm};

/// As dense as water, kg/m³.
pub(super) const WATER: f64 = 1000.0;

/// Triangles that are seen of one robot at most.
const MOST_SEEN: usize = 1_000_000;

/// How a file is read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportOptions {
    /// The folder with the meshes, which no path leads out of; without one no meshes are read, and the report says so.
    /// `package://NAME/rest` is looked for as `NAME/rest` and as `rest` in it.
    pub folder: Option<PathBuf>,
    /// How the first link is held; by default as the file says.
    pub base: Option<Base>,
    /// What is too much.
    pub limits: ImportLimits,
}

/// What a file may hold at most.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImportLimits {
    /// Bytes of the file.
    pub bytes: usize,
    /// Elements of XML.
    pub elements: u32,
    /// Elements within one another.
    pub depth: usize,
    /// Bytes of a mesh.
    pub mesh_bytes: u64,
    /// Triangles of a mesh.
    pub triangles: usize,
    /// Convex solids that a mesh is taken apart into; 1 leaves it whole.
    pub parts: u32,
}

impl Default for ImportLimits {
    fn default() -> Self {
        Self {
            bytes: 16 << 20,
            elements: 100_000,
            depth: 200,
            mesh_bytes: 64 << 20,
            triangles: 200_000,
            parts: 8,
        }
    }
}

/// A robot from a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Imported {
    /// The robot.
    pub description: RobotDescription,
    /// What was approximated or passed over.
    pub report: Vec<Note>,
    /// Stiffness and damping of joints whose motors the file has go to positions or speeds, by name of the joint, N m/rad and
    /// N m s/rad.
    pub gains: BTreeMap<String, [f64; 2]>,
}

/// Something that was approximated or passed over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Where in the file.
    pub place: String,
    /// What was done, in words.
    pub what: String,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.what)
    }
}

/// What is on the way of reading a file.
struct Reading<'a> {
    options: &'a ImportOptions,
    report: Vec<Note>,
    /// Triangles of surfaces that are seen, so far.
    seen: usize,
}

impl<'a> Reading<'a> {
    fn new(options: &'a ImportOptions) -> Self {
        Self { options, report: Vec::new(), seen: 0 }
    }

    fn note(&mut self, place: String, what: impl Into<String>) {
        // A hostile file shall not fill the memory with remarks.
        if self.report.len() < 1000 {
            self.report.push(Note { place, what: what.into() });
        }
    }

    /// A surface as it is seen; none where nothing of it could be, or where a file shows more than anybody could look at.
    fn surface(
        &mut self,
        surface: &Surface,
        link_from_surface: &Pose,
        color: Option<[f32; 3]>,
    ) -> Option<LinkVisual> {
        self.seen += surface.triangles.len();
        if self.seen > MOST_SEEN {
            return None;
        }
        LinkVisual::of_surface(surface, link_from_surface, color)
    }

    /// Gives a link without mass that of its solids, as dense as water.
    #[cfg(feature = "urdf")]
    fn weigh(&mut self, link: &mut super::LinkDescription, place: &dyn Fn() -> String) {
        let mut mass = 0.0;
        let mut center = nalgebra::Vector3::zeros();
        for solid in &link.solids {
            let part = WATER * super::solids::volume(&solid.form);
            mass += part;
            center += solid.link_from_solid.translation.vector * part;
        }
        if mass > 0.0 {
            link.mass = mass;
            link.center = center / mass;
            self.note(place(), format!("has no mass: {mass:.3} kg are reckoned from its solids, as dense as water, and its inertia as that of a ball"));
        }
    }
}

/// Shows a link as these, each once. Where they are its solids one by one, these take their colours, and that is all.
fn see(link: &mut LinkDescription, all: Vec<LinkVisual>) {
    let mut visuals: Vec<LinkVisual> = Vec::with_capacity(all.len());
    for seen in all {
        let is_it = |other: &&mut LinkVisual| {
            other.form == seen.form && other.link_from_visual == seen.link_from_visual
        };
        match visuals.iter_mut().find(is_it) {
            Some(other) => other.color = other.color.or(seen.color),
            None => visuals.push(seen),
        }
    }
    let pairs = || link.solids.iter().zip(&visuals);
    let is_same = visuals.len() == link.solids.len()
        && pairs().all(|(solid, seen)| {
            let is_form = matches!(&seen.form, VisualForm::Solid(form) if *form == solid.form);
            is_form && seen.link_from_visual == solid.link_from_solid
        });
    if is_same {
        for (solid, seen) in link.solids.iter_mut().zip(&visuals) {
            solid.color = seen.color.or(solid.color);
        }
    } else {
        link.visuals = visuals;
    }
}

/// Checks a description that was read.
fn finish(
    mut description: RobotDescription,
    mut reading: Reading<'_>,
    gains: BTreeMap<String, [f64; 2]>,
) -> Result<Imported, RobotError> {
    description.validate()?;
    for [one, other] in description.part_at_rest()? {
        let place = format!("links {:?} and {:?}", xml::shortened(&one), xml::shortened(&other));
        reading.note(place, "are within one another where the joints rest: they pass through one another");
    }
    Ok(Imported { description, report: reading.report, gains })
}
