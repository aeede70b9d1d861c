//! The manifest of a folder of assets: what its rows say, before any file is opened.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};
use simworld_core::asset::{AffordanceSet, Asset, Material, Seasons};
use simworld_core::scene::{EntityKind, Place, Shape};
use toml::Spanned;

use super::error::LibraryError;
use super::folder::MANIFEST;

/// A manifest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// What people call the library.
    pub name: String,
    /// The licence of every asset that has none of its own, as an SPDX expression.
    #[serde(default)]
    pub licence: String,
    /// Where every asset comes from that does not say so itself.
    #[serde(default)]
    pub source: String,
    /// The assets, in order.
    #[serde(default, rename = "asset")]
    pub assets: Vec<Spanned<Row>>,
}

/// An asset in a manifest.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Row {
    /// Its name: lower-case letters, digits and underscores.
    pub name: String,
    /// What it is, in words, by which it is measured and found; its name, if nothing is said.
    pub words: String,
    /// What it is; without it what its words say, if it has a model.
    pub kind: Option<EntityKind>,
    /// What it is used for.
    pub place: Option<Place>,
    /// Its GLB file, within the folder.
    pub model: Option<String>,
    /// Length, width and height, m; without it those of the model.
    pub size: Option<[f64; 3]>,
    /// What it is met as, without a model.
    pub form: Form,
    /// Mass, kg; without it that of the model, or it is fixed to the ground.
    pub mass: Option<f64>,
    /// What its surface is made of.
    pub material: Option<Material>,
    /// Surface colour, linear-light sRGB primaries in [0, 1].
    pub color: Option<[f32; 3]>,
    /// Its colours through the year.
    pub seasons: Option<Seasons>,
    /// What one can do with it; without it what its kind says.
    pub affords: Option<AffordanceSet>,
    /// Words by which people ask for it, beside those of its name.
    pub tags: Vec<String>,
    /// Where it comes from.
    pub source: String,
    /// Under which licence, as an SPDX expression.
    pub licence: String,
}

/// What a thing without a model is met as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// A box.
    #[default]
    Box,
    /// An upright cylinder as wide as it is long.
    Cylinder,
}

impl Manifest {
    /// Reads a manifest: its form, its names, its paths and its sizes, and no other file.
    ///
    /// # Errors
    /// Text that is no manifest, more assets than allowed, or a row that cannot be an asset.
    pub fn read(text: &str, most: usize) -> Result<Self, LibraryError> {
        let manifest: Self = toml::from_str(text).map_err(|error| {
            let start = error.span().map_or(0, |span| span.start);
            refused(line_of(text, start), error.message().to_owned())
        })?;
        if manifest.assets.len() > most {
            let line = line_of(text, manifest.assets[most].span().start);
            return Err(refused(
                line,
                format!("more than {most} assets: divide the library, or raise `LibraryLimits`"),
            ));
        }
        let mut names = BTreeSet::new();
        for row in &manifest.assets {
            let (line, row) = (line_of(text, row.span().start), row.get_ref());
            if !names.insert(row.name.as_str()) {
                return Err(refused(
                    line,
                    format!("{:?} is there already: give each asset a name of its own", row.name),
                ));
            }
            manifest.check(row, line)?;
        }
        Ok(manifest)
    }

    fn check(&self, row: &Row, line: usize) -> Result<(), LibraryError> {
        let why = |why: &str| Err(refused(line, format!("asset {:?} {why}", row.name)));
        if row.licence.is_empty() && self.licence.is_empty() {
            return why("has no licence: give `licence = \"...\"` here, or once at the top");
        }
        let size = row.size.unwrap_or([1.0; 3]);
        if !size.iter().all(|side| (1e-3..=1e4).contains(side)) {
            return why("has a size that is none: give three numbers of metres, 0.001 to 10000");
        }
        let Some(path) = &row.model else {
            if row.kind.is_none() {
                return why("has neither model nor kind: give `model = \"....glb\"` or `kind = \"prop\"`");
            }
            if row.size.is_none() {
                return why("has neither model nor size: give `size = [length, width, height]` in metres");
            }
            return self.asset_of(row).validate().map_err(|error| LibraryError::Asset {
                file: MANIFEST.to_owned(),
                line,
                error: Box::new(error),
            });
        };
        if row.form != Form::Box {
            return why("has a model and a form: leave one of them out");
        }
        match no_path_within(path) {
            None => Ok(()),
            Some(why) => Err(LibraryError::Path { file: MANIFEST.to_owned(), line, path: path.clone(), why }),
        }
    }

    /// The asset of a row without a model.
    pub(super) fn asset_of(&self, row: &Row) -> Asset {
        let [length, width, height] = row.size.unwrap_or([1.0; 3]);
        let shape = match row.form {
            Form::Box => Shape::cuboid(length, width, height),
            Form::Cylinder => Shape::Cylinder { radius: length * 0.5, height },
        };
        let bare = Asset::new(&row.name, row.kind.unwrap_or(EntityKind::Prop), shape);
        self.with_row(bare, row)
    }

    /// What a row says of an asset.
    pub(super) fn with_row(&self, mut asset: Asset, row: &Row) -> Asset {
        asset.kind = row.kind.unwrap_or(asset.kind);
        asset.place = row.place.or(asset.place);
        asset.mass = row.mass.or(asset.mass);
        asset.material = row.material.or(asset.material);
        asset.color = row.color.or(asset.color);
        asset.seasons = row.seasons.or(asset.seasons);
        asset.affordances = row.affords.or(asset.affordances);
        for tag in &row.tags {
            if !asset.tags.contains(tag) {
                asset.tags.push(tag.clone());
            }
        }
        let own = |own: &str, all: &str| if own.is_empty() { all.to_owned() } else { own.to_owned() };
        if asset.source.is_empty() {
            asset.source = own(&row.source, &self.source);
        }
        asset.licence = own(&row.licence, &self.licence);
        asset
    }
}

pub(super) fn refused(line: usize, why: String) -> LibraryError {
    LibraryError::Manifest { file: MANIFEST.to_owned(), line, why }
}

/// The line on which a byte of a text stands, from 1.
pub(super) fn line_of(text: &str, at: usize) -> usize {
    1 + text.char_indices().take_while(|(index, _)| *index < at).filter(|(_, letter)| *letter == '\n').count()
}

/// Why a path names no file within the folder, on any system.
fn no_path_within(path: &str) -> Option<&'static str> {
    let is_glb = path.len() <= 255 && path.to_ascii_lowercase().ends_with(".glb");
    if path.contains(':') {
        Some("no addresses and no drives: give a path within the folder, such as models/post.glb")
    } else if path.contains('\\') || path.chars().any(char::is_control) {
        Some("give a path with / between its parts and no control characters")
    } else if path.starts_with('/') || path.split('/').any(|part| matches!(part, "" | "." | "..")) {
        Some(
            "it leads out of the folder, or nowhere: give a path that only goes down, such as models/post.glb",
        )
    } else if is_glb {
        None
    } else {
        Some("models are GLB files: give a path that ends with .glb")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "name = \"a\"\nlicence = \"CC0-1.0\"\n\n";

    fn read(row: &str) -> Result<Manifest, LibraryError> {
        Manifest::read(&format!("{HEAD}[[asset]]\n{row}"), 3)
    }

    #[test]
    fn a_row_is_an_asset() {
        let manifest = read(
            "name = \"net_rack\"\nkind = \"prop\"\nsize = [0.8, 2.5, 1.8]\nmass = 40.0\nmaterial = \"wood\"\naffords = [\"sit\"]",
        )
        .unwrap();
        let asset = manifest.asset_of(manifest.assets[0].get_ref());
        assert_eq!(
            (asset.mass, asset.material, asset.licence.as_str()),
            (Some(40.0), Some(Material::Wood), "CC0-1.0")
        );
        assert!(asset.affordances().contains(simworld_core::asset::Affordance::Sit));
        assert_eq!(asset.validate(), Ok(()));
    }

    #[test]
    fn what_leads_out_is_refused_before_a_file_is_opened() {
        for path in [
            "../post.glb",
            "a/../../post.glb",
            "/etc/post.glb",
            "C:/post.glb",
            "file:///post.glb",
            "http://x/post.glb",
            "a//post.glb",
            "./post.glb",
            "..\\\\post.glb",
            "post.gltf",
            "post",
            "",
            "a/\\u0000.glb",
        ] {
            let error = read(&format!("name = \"post\"\nmodel = \"{path}\"")).unwrap_err();
            assert!(matches!(error, LibraryError::Path { line: 4, .. }), "{path}: {error}");
        }
        assert!(read("name = \"post\"\nmodel = \"models/Post 2.GLB\"").is_ok());
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (row, word, at) in [
            ("name = \"a\"", "neither model nor kind", 4),
            ("name = \"a\"\nkind = \"prop\"", "neither model nor size", 4),
            ("name = \"a\"\nkind = \"ship\"\nsize = [1.0, 1.0, 1.0]", "ship", 6),
            ("name = \"a\"\nkind = \"prop\"\nsize = [1.0, 1.0, 0.0]", "metres", 4),
            ("name = \"A b\"\nkind = \"prop\"\nsize = [1.0, 1.0, 1.0]", "lower-case", 4),
            ("name = \"a\"\nsizes = 3", "sizes", 6),
            ("name = \"a\"\nmodel = \"a.glb\"\nform = \"cylinder\"", "form", 4),
            ("name = ", "", 5),
        ] {
            let error = read(row).unwrap_err().to_string();
            assert!(
                error.starts_with(&format!("library.toml:{at}:")) && error.contains(word),
                "{row}: {error}"
            );
        }
        let unlicensed =
            Manifest::read("name = \"a\"\n[[asset]]\nname = \"b\"\nmodel = \"b.glb\"", 3).unwrap_err();
        assert!(unlicensed.to_string().contains("licence"), "{unlicensed}");
        let twice = "[[asset]]\nname = \"b\"\nmodel = \"b.glb\"\n".repeat(2);
        let error = Manifest::read(&format!("{HEAD}{twice}"), 3).unwrap_err();
        assert!(error.to_string().starts_with("library.toml:7:"), "{error}");
        let asset = |index| format!("[[asset]]\nname = \"b{index}\"\nmodel = \"b.glb\"\n");
        let many = [0, 1, 2, 3].map(asset).concat();
        assert!(Manifest::read(&format!("{HEAD}{many}"), 3).unwrap_err().to_string().contains("more than 3"));
    }
}
