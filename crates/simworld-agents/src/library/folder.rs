//! The folder: files within it and nothing else, checked against the lock.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use simworld_core::asset::{Asset, AssetError, Catalogue, ContentId};
use toml::Spanned;

use super::error::LibraryError;
use super::manifest::{Manifest, Row, line_of, refused};
use crate::assets::{ImportConfig, Thing, import_glb};
use crate::generation::SizeHint;

/// The name of the manifest in its folder.
pub const MANIFEST: &str = "library.toml";
/// The name of the lock in its folder.
pub const LOCK: &str = "library.lock";

/// How much a folder may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LibraryLimits {
    /// Of the manifest and of the lock, bytes.
    pub manifest: u64,
    /// Assets.
    pub assets: usize,
    /// Of one model, bytes.
    pub file: u64,
    /// Of all models together, bytes.
    pub total: u64,
}

impl Default for LibraryLimits {
    /// A manifest of 4 MiB with 10,000 assets, models of 64 MiB, 1 GiB together.
    fn default() -> Self {
        Self { manifest: 4 << 20, assets: 10_000, file: 64 << 20, total: 1 << 30 }
    }
}

/// The assets of a folder.
#[derive(Clone, Debug, PartialEq)]
pub struct Library {
    /// What people call it.
    pub name: String,
    /// Its assets, valid, in the order of the manifest.
    pub assets: Vec<Asset>,
    /// The files that were read, by their path within the folder, with their content addresses.
    pub files: BTreeMap<String, ContentId>,
}

/// The lock of a folder, as it is written.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Lock {
    files: BTreeMap<String, ContentId>,
}

impl Library {
    /// Reads a folder: its manifest, then each model that it names; where there is a lock, everything must be as it says.
    ///
    /// # Errors
    /// A file that is missing, too large, a link, or out of the folder; a manifest, a model or an asset that is none; anything that
    /// differs from the lock.
    pub fn read(folder: &Path, config: &ImportConfig, limits: &LibraryLimits) -> Result<Self, LibraryError> {
        let root = folder
            .canonicalize()
            .map_err(|error| LibraryError::Io { path: folder.display().to_string(), error })?;
        let mut reader = Reader { root, files: BTreeMap::new(), left: limits.total };
        let text = reader.text(MANIFEST, limits.manifest)?;
        let manifest = Manifest::read(&text, limits.assets)?;
        let mut assets = Vec::with_capacity(manifest.assets.len());
        for row in &manifest.assets {
            let line = line_of(&text, row.span().start);
            assets.push(reader.asset(&manifest, row, line, config, limits)?);
        }
        if reader.is_there(LOCK) {
            let text = reader.text(LOCK, limits.manifest)?;
            reader.files.remove(LOCK);
            reader.check(&text)?;
        }
        Ok(Self { name: manifest.name, assets, files: reader.files })
    }

    /// Adds every asset to a catalogue, or none.
    ///
    /// # Errors
    /// The catalogue has another asset of one of the names.
    pub fn add_to(&self, catalogue: &mut Catalogue) -> Result<(), AssetError> {
        let mut with = catalogue.clone();
        for asset in &self.assets {
            with.add(asset.clone())?;
        }
        *catalogue = with;
        Ok(())
    }

    /// The text of the lock for the files as they are.
    pub fn lock(&self) -> String {
        // Paths have no control characters and no backslashes; what else TOML gives a meaning is escaped.
        let line =
            |(path, id): (&String, &ContentId)| format!("\"{}\" = \"{id}\"\n", path.replace('"', "\\\""));
        let lines: String = self.files.iter().map(line).collect();
        format!("# The content addresses of the files of this library (XXH3, 128 bits).\n[files]\n{lines}")
    }
}

struct Reader {
    root: PathBuf,
    files: BTreeMap<String, ContentId>,
    left: u64,
}

impl Reader {
    fn asset(
        &mut self,
        manifest: &Manifest,
        row: &Spanned<Row>,
        line: usize,
        config: &ImportConfig,
        limits: &LibraryLimits,
    ) -> Result<Asset, LibraryError> {
        let row = row.get_ref();
        let file = || MANIFEST.to_owned();
        let asset = match &row.model {
            None => manifest.asset_of(row),
            Some(path) => {
                self.no_link(path, line)?;
                let bytes = self.bytes(path, limits.file)?;
                let thing = thing_of(manifest, row);
                let imported = import_glb(&bytes, &thing, config).map_err(|error| LibraryError::Import {
                    file: file(),
                    line,
                    path: path.clone(),
                    error: Box::new(error),
                })?;
                manifest.with_row(imported.asset, row)
            }
        };
        let checked = asset.validate();
        checked.map_err(|error| LibraryError::Asset { file: file(), line, error: Box::new(error) })?;
        Ok(asset)
    }

    /// A path of the manifest goes through no link, and ends at a file.
    fn no_link(&self, path: &str, line: usize) -> Result<(), LibraryError> {
        let refused =
            |why| LibraryError::Path { file: MANIFEST.to_owned(), line, path: path.to_owned(), why };
        let mut at = self.root.clone();
        let mut is_file = false;
        for part in path.split('/') {
            at.push(part);
            let kind =
                std::fs::symlink_metadata(&at).map_err(|_| refused("there is no such file"))?.file_type();
            if kind.is_symlink() {
                return Err(refused("links are not followed: put the file itself there"));
            }
            is_file = kind.is_file();
        }
        if is_file { Ok(()) } else { Err(refused("it is no file")) }
    }

    fn is_there(&self, name: &str) -> bool {
        std::fs::symlink_metadata(self.root.join(name)).is_ok()
    }

    fn text(&mut self, name: &str, limit: u64) -> Result<String, LibraryError> {
        let kind = std::fs::symlink_metadata(self.root.join(name))
            .map_err(|error| LibraryError::Io { path: name.to_owned(), error })?
            .file_type();
        if !kind.is_file() {
            let (path, why) = (name.to_owned(), "it is no file of its own: put it into the folder itself");
            return Err(LibraryError::Path { file: MANIFEST.to_owned(), line: 1, path, why });
        }
        let bytes = self.bytes(name, limit)?;
        String::from_utf8(bytes).map_err(|error| {
            let good = error.utf8_error().valid_up_to();
            let before = String::from_utf8_lossy(&error.as_bytes()[..good]).into_owned();
            refused(line_of(&before, good), format!("{name} is no text in UTF-8"))
        })
    }

    /// The bytes of a file within the folder, which was looked at before.
    fn bytes(&mut self, path: &str, limit: u64) -> Result<Vec<u8>, LibraryError> {
        let io = |error| LibraryError::Io { path: path.to_owned(), error };
        let limit = limit.min(self.left);
        let file = std::fs::File::open(self.root.join(path)).map_err(io)?;
        let large = || LibraryError::Large { path: path.to_owned(), limit };
        // A file that says it is huge is not even begun; one that grows meanwhile is cut off.
        if file.metadata().map_err(io)?.len() > limit {
            return Err(large());
        }
        let mut bytes = Vec::new();
        file.take(limit + 1).read_to_end(&mut bytes).map_err(io)?;
        if bytes.len() as u64 > limit {
            return Err(large());
        }
        self.left -= bytes.len() as u64;
        self.files.insert(path.to_owned(), ContentId::of_bytes(&bytes));
        Ok(bytes)
    }

    fn check(&self, text: &str) -> Result<(), LibraryError> {
        let lock: Lock = toml::from_str(text).map_err(|error| LibraryError::Manifest {
            file: LOCK.to_owned(),
            line: line_of(text, error.span().map_or(0, |span| span.start)),
            why: error.message().to_owned(),
        })?;
        for (path, got) in &self.files {
            match lock.files.get(path) {
                Some(wanted) if wanted == got => {}
                Some(wanted) => {
                    return Err(LibraryError::Changed { path: path.clone(), wanted: *wanted, got: *got });
                }
                None => {
                    return Err(LibraryError::Unlocked { path: path.clone(), has: "folder", lacks: "lock" });
                }
            }
        }
        match lock.files.keys().find(|path| !self.files.contains_key(*path)) {
            Some(path) => Err(LibraryError::Unlocked { path: path.clone(), has: "lock", lacks: "manifest" }),
            None => Ok(()),
        }
    }
}

/// What a row says of its model.
fn thing_of(manifest: &Manifest, row: &Row) -> Thing {
    let side = |axis: usize| row.size.map(|size| size[axis]);
    let words = if row.words.is_empty() { row.name.replace('_', " ") } else { row.words.clone() };
    let own = |own: &str, all: &str| if own.is_empty() { all.to_owned() } else { own.to_owned() };
    Thing {
        name: row.name.clone(),
        words,
        size: SizeHint { length: side(0), width: side(1), height: side(2) },
        source: own(&row.source, &manifest.source),
        licence: own(&row.licence, &manifest.licence),
    }
}
