//! Patches of cities: an edit as data, and what takes it back.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::net::{Control, CrossSection, NetworkPatch, Street, StreetPlan};
use simworld_core::patch::{ArrayPatch, Misfit};

use super::EditError;
use crate::City;
use crate::building::Building;
use crate::element::Element;

/// What changes of a plan of streets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanPatch {
    /// Nodes.
    pub nodes: ArrayPatch<Point2>,
    /// Their heights.
    pub elevations: ArrayPatch<f64>,
    /// Streets.
    pub streets: ArrayPatch<Street>,
    /// Cross-sections.
    pub sections: ArrayPatch<CrossSection>,
    /// Names of streets.
    pub names: ArrayPatch<String>,
    /// Who may go at some nodes; ascending.
    pub controls: Vec<(u32, Option<Control>)>,
}

impl PlanPatch {
    pub(super) fn unchanged(plan: &StreetPlan) -> Self {
        Self {
            nodes: ArrayPatch::unchanged(&plan.nodes),
            elevations: ArrayPatch::unchanged(&plan.elevations),
            streets: ArrayPatch::unchanged(&plan.streets),
            sections: ArrayPatch::unchanged(&plan.sections),
            names: ArrayPatch::unchanged(&plan.names),
            controls: Vec::new(),
        }
    }

    fn check(&self, plan: &StreetPlan) -> Result<(), Misfit> {
        self.nodes.check(&plan.nodes, "nodes")?;
        self.elevations.check(&plan.elevations, "elevations")?;
        self.streets.check(&plan.streets, "streets")?;
        self.sections.check(&plan.sections, "cross-sections")?;
        self.names.check(&plan.names, "names")
    }

    /// Puts the patch on a plan; gives the patch that takes it off again.
    ///
    /// # Errors
    /// It does not fit; then the plan is as it was.
    pub fn put_on(self, plan: &mut StreetPlan) -> Result<Self, Misfit> {
        self.check(plan)?;
        let mut controls = Vec::with_capacity(self.controls.len());
        for (node, control) in self.controls {
            let key = node as usize;
            let old = match control {
                Some(control) => plan.controls.insert(key, control),
                None => plan.controls.remove(&key),
            };
            controls.push((node, old));
        }
        Ok(Self {
            nodes: self.nodes.put_on(&mut plan.nodes, "nodes")?,
            elevations: self.elevations.put_on(&mut plan.elevations, "elevations")?,
            streets: self.streets.put_on(&mut plan.streets, "streets")?,
            sections: self.sections.put_on(&mut plan.sections, "cross-sections")?,
            names: self.names.put_on(&mut plan.names, "names")?,
            controls,
        })
    }
}

/// What changes of a city: its size is that of the change.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CityPatch {
    /// Streets as they are planned.
    pub plan: PlanPatch,
    /// Roads that are derived from them.
    pub network: NetworkPatch,
    /// Buildings.
    pub buildings: ArrayPatch<Building>,
    /// Street elements.
    pub elements: ArrayPatch<Element>,
    /// Length of the frontage of the whole city, m.
    pub frontage: f64,
}

impl CityPatch {
    /// The patch that changes nothing of a city.
    pub(super) fn unchanged(city: &City) -> Self {
        Self {
            plan: PlanPatch::unchanged(&city.plan),
            network: NetworkPatch::unchanged(&city.network),
            buildings: ArrayPatch::unchanged(&city.buildings),
            elements: ArrayPatch::unchanged(&city.elements),
            frontage: city.frontage,
        }
    }

    /// Puts the patch on a city; gives the patch that takes it off again.
    ///
    /// # Errors
    /// It does not fit; then the city is as it was.
    pub fn put_on(self, city: &mut City) -> Result<Self, EditError> {
        self.plan.check(&city.plan)?;
        self.buildings.check(&city.buildings, "buildings")?;
        self.elements.check(&city.elements, "elements")?;
        // What another one holds of the network stays with it.
        let network = std::sync::Arc::make_mut(&mut city.network).put(self.network)?;
        Ok(Self {
            plan: self.plan.put_on(&mut city.plan)?,
            network,
            buildings: self.buildings.put_on(&mut city.buildings, "buildings")?,
            elements: self.elements.put_on(&mut city.elements, "elements")?,
            frontage: std::mem::replace(&mut city.frontage, self.frontage),
        })
    }
}
