//! Catalogues: assets by number and by name.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Asset, AssetError, library, standard};
use crate::id::AssetId;

/// Assets in the order in which they were added, each with a name of its own. In files it is a list.
///
/// ```
/// use simworld_core::asset::{Asset, Catalogue};
/// use simworld_core::geometry::Pose;
/// use simworld_core::scene::{EntityKind, Shape};
/// let mut catalogue = Catalogue::standard();
/// let red = Asset { color: Some([0.6, 0.02, 0.02]), mass: Some(1250.0), ..Asset::new(
///     "roadster", EntityKind::Car, Shape::cuboid(4.0, 1.75, 1.2),
/// ) }.tagged(["red", "sports"]);
/// let id = catalogue.add(red)?;
/// // "a red sports car": the asset that answers to most of the words.
/// assert_eq!(catalogue.best_match(&["red", "sports", "car"]), Some(id));
/// let entity = catalogue.get(id).unwrap().at(id, Pose::identity());
/// assert_eq!((entity.info.mass, entity.info.asset), (Some(1250.0), Some(id)));
/// # Ok::<(), simworld_core::asset::AssetError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<Asset>", into = "Vec<Asset>")]
pub struct Catalogue {
    assets: Vec<Asset>,
    names: BTreeMap<String, AssetId>,
    /// Those whose name has an address, by their noun.
    nouns: BTreeMap<String, Vec<AssetId>>,
}

impl Catalogue {
    /// No assets yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The ordinary things of a street: furniture, trees, vehicles, people and what they carry.
    pub fn standard() -> Self {
        Self::of_sound(standard::assets())
    }

    /// Everything that comes with the crate: the ordinary things of a street, then 180 more of streets, parks, playgrounds and building
    /// sites, 31 plants, 40 vehicles, 30 people, animals and robots, 100 kinds of buildings and the 124 of the Python release.
    /// Those whose kind says little of what they look like have a model, which all catalogues share.
    pub fn library() -> Self {
        Self::of_sound(standard::assets().chain(library::assets()))
    }

    fn of_sound(assets: impl Iterator<Item = Asset>) -> Self {
        let mut catalogue = Self::new();
        for asset in assets {
            let added = catalogue.add(asset);
            assert!(added.is_ok(), "{added:?}");
        }
        catalogue
    }

    /// Adds an asset and gives its id; one that is there already keeps its own.
    ///
    /// # Errors
    /// An asset that is none, or another one of the same name.
    pub fn add(&mut self, asset: Asset) -> Result<AssetId, AssetError> {
        asset.validate()?;
        if let Some(id) = self.find(&asset.name) {
            let same = self.assets[id.index()] == asset;
            return if same { Ok(id) } else { Err(AssetError::Taken { name: asset.name }) };
        }
        let id = AssetId::from_index(self.assets.len());
        self.names.insert(asset.name.clone(), id);
        if let Some(noun) = asset.noun() {
            self.nouns.entry(noun.to_owned()).or_default().push(id);
        }
        self.assets.push(asset);
        Ok(id)
    }

    /// The asset of an id.
    pub fn get(&self, id: AssetId) -> Option<&Asset> {
        self.assets.get(id.index())
    }

    /// The id of a name.
    pub fn find(&self, name: &str) -> Option<AssetId> {
        self.names.get(name).copied()
    }

    /// The assets that were made for words with this [noun](Asset::noun), in the order in which they were added; which of them answers to
    /// other words too [`Asset::is_called`] says.
    pub fn with_noun(&self, noun: &str) -> &[AssetId] {
        self.nouns.get(noun).map_or(&[][..], Vec::as_slice)
    }

    /// The id of a class of the Python release, such as `BP_Building_07_C` or `BP_Couch_C`.
    pub fn find_released(&self, class: &str) -> Option<AssetId> {
        self.find(&library::released_as(class)?)
    }

    /// The number of assets.
    pub fn len(&self) -> usize {
        self.assets.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.assets.is_empty()
    }

    /// Every asset with its id, in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = (AssetId, &Asset)> {
        self.assets.iter().enumerate().map(|(index, asset)| (AssetId::from_index(index), asset))
    }

    /// The asset that answers to most of some words, the first of several; none if no asset answers to any.
    pub fn best_match<W: AsRef<str>>(&self, words: &[W]) -> Option<AssetId> {
        let mut best = (0, None);
        for (id, asset) in self.iter() {
            let answered = asset.answers(words);
            if answered > best.0 {
                best = (answered, Some(id));
            }
        }
        best.1
    }
}

impl TryFrom<Vec<Asset>> for Catalogue {
    type Error = AssetError;

    fn try_from(assets: Vec<Asset>) -> Result<Self, AssetError> {
        let mut catalogue = Self::new();
        for asset in assets {
            if catalogue.find(&asset.name).is_some() {
                return Err(AssetError::Taken { name: asset.name });
            }
            catalogue.add(asset)?;
        }
        Ok(catalogue)
    }
}

impl From<Catalogue> for Vec<Asset> {
    fn from(catalogue: Catalogue) -> Self {
        catalogue.assets
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{EntityKind, Shape};

    fn crate_of(size: f64) -> Asset {
        Asset::new("crate", EntityKind::Prop, Shape::cuboid(size, size, size))
    }

    #[test]
    fn the_standard_assets_are_all_there() {
        let catalogue = Catalogue::standard();
        assert_eq!(
            catalogue.len(),
            standard::assets().count(),
            "every row is sound and has a name of its own"
        );
        for kind in
            [EntityKind::Tree, EntityKind::Bench, EntityKind::Car, EntityKind::Person, EntityKind::Parcel]
        {
            assert!(catalogue.iter().any(|(_, asset)| asset.kind == kind), "{kind}");
        }
    }

    #[test]
    fn a_name_stands_for_one_asset() {
        let mut catalogue = Catalogue::new();
        let id = catalogue.add(crate_of(1.0)).unwrap();
        assert_eq!(catalogue.add(crate_of(1.0)), Ok(id));
        assert!(matches!(catalogue.add(crate_of(2.0)), Err(AssetError::Taken { .. })));
        assert_eq!(catalogue.len(), 1);
    }

    #[test]
    fn what_was_made_is_found_by_its_noun() {
        let mut catalogue = Catalogue::standard();
        let made = |name: &str, size| Asset { name: name.to_owned(), ..crate_of(size) };
        let one = catalogue.add(made("obelisk_00ab12cd34ef", 1.0)).unwrap();
        let other = catalogue.add(made("a_stone_obelisk_with_steps_1a2b3c4d", 2.0)).unwrap();
        assert_eq!(catalogue.add(made("obelisk_00ab12cd34ef", 1.0)), Ok(one));
        assert_eq!(catalogue.with_noun("obelisk"), [one, other]);
        assert!(catalogue.with_noun("steps").is_empty() && catalogue.with_noun("bench").is_empty());
        let text = serde_json::to_string(&catalogue).unwrap();
        assert_eq!(serde_json::from_str::<Catalogue>(&text).unwrap().with_noun("obelisk"), [one, other]);
    }

    #[test]
    fn a_catalogue_is_a_list_in_files() {
        let catalogue = Catalogue::standard();
        let text = serde_json::to_string(&catalogue).unwrap();
        assert_eq!(serde_json::from_str::<Catalogue>(&text).unwrap(), catalogue);
        let doubled = serde_json::to_string(&[crate_of(1.0), crate_of(1.0)]).unwrap();
        assert!(serde_json::from_str::<Catalogue>(&doubled).unwrap_err().to_string().contains("crate"));
        let flat = serde_json::to_string(&[crate_of(0.0)]).unwrap();
        assert!(serde_json::from_str::<Catalogue>(&flat).is_err());
    }

    #[test]
    fn absurd_assets_are_refused() {
        for mass in [0.0, -1.0, f64::NAN, 1e12] {
            assert!(Asset { mass: Some(mass), ..crate_of(1.0) }.validate().is_err(), "{mass} kg");
        }
        for name in ["", "Red Car", "a/../b"] {
            assert!(Asset { name: name.to_owned(), ..crate_of(1.0) }.validate().is_err(), "{name:?}");
        }
        assert!(Asset { color: Some([2.0, 0.0, 0.0]), ..crate_of(1.0) }.validate().is_err());
    }

    #[test]
    fn nobody_answers_to_nothing() {
        let none: [&str; 0] = [];
        assert_eq!(Catalogue::standard().best_match(&none), None);
        assert_eq!(Catalogue::standard().best_match(&["zeppelin"]), None);
    }
}
