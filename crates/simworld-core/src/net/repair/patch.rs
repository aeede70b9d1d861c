//! Patches: entries of arrays that are set anew, so that a change of a large thing is as small as what it changes.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::net::{
    Connection, Crossing, Intersection, Lane, NetworkFault, Road, RoadNetwork, Sidewalk, SignalPlan,
};

/// Some entries of an array, and its length: the array gets that length and those entries, and keeps the others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ArrayPatch<T> {
    /// Length of the array with the patch.
    pub len: u32,
    /// Entries by index, ascending; all of those beyond the length of the array before are among them.
    pub set: Vec<(u32, T)>,
}

/// A patch that does not fit its array.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PatchError {
    /// Entries out of order, beyond the end, or missing.
    #[error(
        "the patch of {what} does not fit an array of {present} entries: make it from the network that it is for"
    )]
    Misfit {
        /// What the array holds.
        what: &'static str,
        /// Its length.
        present: usize,
    },
    /// There are no roads to be changed.
    #[error("there are no roads: give the world its roads before they are changed")]
    NoRoads,
    /// The network with the patch would not hold together.
    #[error(transparent)]
    Fault(#[from] NetworkFault),
}

impl<T> ArrayPatch<T> {
    /// The patch that changes nothing of an array.
    pub fn unchanged(array: &[T]) -> Self {
        Self { len: array.len() as u32, set: Vec::new() }
    }

    /// Whether it changes nothing of an array.
    pub fn is_unchanged(&self, array: &[T]) -> bool {
        self.len as usize == array.len() && self.set.is_empty()
    }

    /// Whether it can be put on an array.
    fn fits(&self, array: &[T]) -> bool {
        let (len, present) = (self.len as usize, array.len());
        let ascending = self.set.is_sorted_by(|a, b| a.0 < b.0);
        let within = self.set.last().is_none_or(|(index, _)| (*index as usize) < len);
        let beyond = self.set.iter().filter(|(index, _)| *index as usize >= present).count();
        ascending && within && beyond == len.saturating_sub(present)
    }

    /// Puts the patch on an array; gives the patch that takes it off again.
    ///
    /// ```
    /// use simworld_core::net::ArrayPatch;
    /// let mut array = vec!['a', 'b', 'c'];
    /// let back = ArrayPatch { len: 2, set: vec![(0, 'z')] }.put_on(&mut array, "letters")?;
    /// assert_eq!(array, ['z', 'b']);
    /// back.put_on(&mut array, "letters")?;
    /// assert_eq!(array, ['a', 'b', 'c']);
    /// # Ok::<(), simworld_core::net::PatchError>(())
    /// ```
    ///
    /// # Errors
    /// It does not fit; then the array is as it was.
    pub fn put_on(self, array: &mut Vec<T>, what: &'static str) -> Result<Self, PatchError> {
        if !self.fits(array) {
            return Err(PatchError::Misfit { what, present: array.len() });
        }
        let (len, present) = (self.len as usize, array.len());
        let mut back = Vec::with_capacity(self.set.len() + present.saturating_sub(len));
        let mut cut = array.split_off(len.min(present));
        for (index, value) in self.set {
            match array.get_mut(index as usize) {
                Some(entry) => back.push((index, std::mem::replace(entry, value))),
                None => array.push(value),
            }
        }
        back.extend((len as u32..).zip(cut.drain(..)));
        Ok(Self { len: present as u32, set: back })
    }
}

impl<T: Clone> ArrayPatch<T> {
    /// The patch that would bring an array to how it is now, after this one was put on it: what does again what this
    /// one takes back.
    fn mirrored(&self, array: &[T]) -> Self {
        let overwritten =
            self.set.iter().map(|(index, _)| *index).filter(|index| (*index as usize) < array.len());
        let added = self.len..array.len() as u32;
        let set = overwritten.filter(|index| *index < self.len).chain(added);
        Self {
            len: array.len() as u32,
            set: set.map(|index| (index, array[index as usize].clone())).collect(),
        }
    }
}

/// What changes of a network: its size is that of the change.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NetworkPatch {
    /// Roads.
    pub roads: ArrayPatch<Road>,
    /// Lanes.
    pub lanes: ArrayPatch<Lane>,
    /// Connections.
    pub connections: ArrayPatch<Connection>,
    /// Intersections.
    pub intersections: ArrayPatch<Intersection>,
    /// Sidewalks.
    pub sidewalks: ArrayPatch<Sidewalk>,
    /// Crossings.
    pub crossings: ArrayPatch<Crossing>,
    /// Signal plans.
    pub signals: ArrayPatch<SignalPlan>,
    /// Names of roads.
    pub names: ArrayPatch<String>,
}

impl RoadNetwork {
    /// Puts a patch on the network; gives the patch that takes it off again.
    ///
    /// # Errors
    /// A patch that is for another network; then the network is as it was.
    pub fn put(&mut self, patch: NetworkPatch) -> Result<NetworkPatch, PatchError> {
        let fits = [
            ("roads", patch.roads.fits(&self.roads), self.roads.len()),
            ("lanes", patch.lanes.fits(&self.lanes), self.lanes.len()),
            ("connections", patch.connections.fits(&self.connections), self.connections.len()),
            ("intersections", patch.intersections.fits(&self.intersections), self.intersections.len()),
            ("sidewalks", patch.sidewalks.fits(&self.sidewalks), self.sidewalks.len()),
            ("crossings", patch.crossings.fits(&self.crossings), self.crossings.len()),
            ("signals", patch.signals.fits(&self.signals), self.signals.len()),
            ("names", patch.names.fits(&self.names), self.names.len()),
        ];
        if let Some((what, _, present)) = fits.into_iter().find(|(_, fits, _)| !fits) {
            return Err(PatchError::Misfit { what, present });
        }
        Ok(NetworkPatch {
            roads: patch.roads.put_on(&mut self.roads, "roads")?,
            lanes: patch.lanes.put_on(&mut self.lanes, "lanes")?,
            connections: patch.connections.put_on(&mut self.connections, "connections")?,
            intersections: patch.intersections.put_on(&mut self.intersections, "intersections")?,
            sidewalks: patch.sidewalks.put_on(&mut self.sidewalks, "sidewalks")?,
            crossings: patch.crossings.put_on(&mut self.crossings, "crossings")?,
            signals: patch.signals.put_on(&mut self.signals, "signals")?,
            names: patch.names.put_on(&mut self.names, "names")?,
        })
    }

    /// Puts a patch from outside on the network and checks that the network then holds together. Takes as long as a look at
    /// the whole network.
    ///
    /// # Errors
    /// A patch that does not fit, or a network that would not hold together; then the network is as it was.
    pub fn put_checked(&mut self, patch: NetworkPatch) -> Result<NetworkPatch, PatchError> {
        let back = self.put(patch)?;
        if let Err(fault) = self.check() {
            self.put(back)?;
            return Err(fault.into());
        }
        Ok(back)
    }
}

impl NetworkPatch {
    /// The patch that does again what this one takes back; the network is the one that this one is for.
    #[must_use]
    pub fn mirrored(&self, network: &RoadNetwork) -> Self {
        Self {
            roads: self.roads.mirrored(&network.roads),
            lanes: self.lanes.mirrored(&network.lanes),
            connections: self.connections.mirrored(&network.connections),
            intersections: self.intersections.mirrored(&network.intersections),
            sidewalks: self.sidewalks.mirrored(&network.sidewalks),
            crossings: self.crossings.mirrored(&network.crossings),
            signals: self.signals.mirrored(&network.signals),
            names: self.names.mirrored(&network.names),
        }
    }
}
