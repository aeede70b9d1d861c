//! A scene file as data, and as text.

use std::io::Read;
use std::path::Path;

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use simworld_core::spec::SceneSpec;
use toml::Spanned;

use super::aside::Aside;
use super::error::{SceneFileError, Where};
use super::rows::{EmptyGround, Say, StreetRow, Thing};
use super::sky::Sky;

/// The version of the format that is read and written.
pub const VERSION: u32 = 1;
/// A file has so many bytes at the most.
pub const MOST_BYTES: u64 = 4 << 20;

/// A scene that is written by hand: every key stands in `docs/scenes.md`.
///
/// What it says is checked by [`load`](Self::load), all of it at once; reading checks the form alone.
///
/// ```
/// use simworld_agents::scenes::file::{NoPlaces, SceneFile};
/// use simworld_core::asset::Catalogue;
/// let scene = SceneFile::parse(
///     r#"
///     version = 1
///
///     [[thing]]
///     asset = "table"
///     name = "desk"
///     at = [4.0, -2.0]
///     facing = "north"
///
///     [[thing]]
///     asset = "parcel"
///     on = "desk"
///     "#,
/// )?;
/// let loaded = scene.load(&Catalogue::library(), &mut NoPlaces)?;
/// assert!(loaded.problems.is_empty());
/// assert_eq!(SceneFile::parse(&scene.to_toml()?)?, scene);
/// # Ok::<(), simworld_agents::scenes::file::SceneFileError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// The version of the format: 1.
    pub version: u32,
    /// What it is called.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Seed of what the generator and the sentences leave open; 1 without it.
    #[serde(default = "first_seed")]
    pub seed: u64,
    /// What the generator is to make: a place around all else.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place: Option<SceneSpec>,
    /// Empty ground in place of that; the default one where neither a place nor streets are said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ground: Option<EmptyGround>,
    /// Date, hour and weather; those of the place, or else the default ones, without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub environment: Option<Sky>,
    /// Streets on level ground, in place of a place.
    #[serde(default, rename = "street", skip_serializing_if = "Vec::is_empty")]
    pub streets: Vec<StreetRow>,
    /// What stands where.
    #[serde(default, rename = "thing", skip_serializing_if = "Vec::is_empty")]
    pub things: Vec<Thing>,
    /// What is said when all of that is there.
    #[serde(default, rename = "say", skip_serializing_if = "Vec::is_empty")]
    pub says: Vec<Say>,
    /// Where it was read.
    #[serde(skip)]
    pub origin: Aside<Origin>,
}

/// Where a scene file was read: lines from 1.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// The path of the file.
    pub file: Option<String>,
    /// The line of `[place]`.
    pub place: Option<usize>,
    /// The line of `[ground]`.
    pub ground: Option<usize>,
    /// The line of `[environment]`.
    pub environment: Option<usize>,
}

const fn first_seed() -> u64 {
    1
}

impl Default for SceneFile {
    /// Empty ground.
    fn default() -> Self {
        Self {
            version: VERSION,
            title: None,
            seed: first_seed(),
            place: None,
            ground: None,
            environment: None,
            streets: Vec::new(),
            things: Vec::new(),
            says: Vec::new(),
            origin: Aside::default(),
        }
    }
}

/// Where the tables of a text begin. What is of another form has no line here, and is refused by who reads it as a scene.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Lines {
    version: Option<u32>,
    place: Option<Spanned<IgnoredAny>>,
    ground: Option<Spanned<IgnoredAny>>,
    environment: Option<Spanned<IgnoredAny>>,
    street: Vec<Spanned<IgnoredAny>>,
    thing: Vec<Spanned<IgnoredAny>>,
    say: Vec<Spanned<IgnoredAny>>,
}

impl SceneFile {
    /// Reads a file.
    ///
    /// # Errors
    /// A file that cannot be read, is larger than [`MOST_BYTES`] or is no scene file.
    pub fn read(path: &Path) -> Result<Self, SceneFileError> {
        let name = path.display().to_string();
        let io = |error| SceneFileError::Io { path: name.clone(), error };
        let file = std::fs::File::open(path).map_err(io)?;
        let mut bytes = Vec::new();
        file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(io)?;
        if bytes.len() as u64 > MOST_BYTES {
            return Err(SceneFileError::Large { path: name, limit: MOST_BYTES });
        }
        match String::from_utf8(bytes) {
            Ok(text) => Self::parse_as(&text, Some(name)),
            Err(error) => {
                let good = error.utf8_error().valid_up_to();
                let before = String::from_utf8_lossy(&error.as_bytes()[..good]);
                let line = Some(Newlines::of(&before).line(good));
                let at = Where { file: Some(name), line, row: String::new() };
                Err(SceneFileError::Form { at, why: "this is no text in UTF-8: save it as such".to_owned() })
            }
        }
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// Text that is no scene file.
    pub fn parse(text: &str) -> Result<Self, SceneFileError> {
        Self::parse_as(text, None)
    }

    fn parse_as(text: &str, file: Option<String>) -> Result<Self, SceneFileError> {
        let newlines = Newlines::of(text);
        let form = |at: usize, why: String| {
            let at = Where { file: file.clone(), line: Some(newlines.line(at)), row: String::new() };
            SceneFileError::Form { at, why }
        };
        let lines: Lines = toml::from_str(text).unwrap_or_default();
        if let Some(version) = lines.version.filter(|version| *version != VERSION) {
            let at = text.find("version").unwrap_or(0);
            let why = format!("version {version} of the format is not known: write version = {VERSION}");
            return Err(form(at, why));
        }
        let mut scene: Self = toml::from_str(text).map_err(|error: toml::de::Error| {
            form(error.span().map_or(0, |span| span.start), with_remedy(error.message()))
        })?;
        let line = |table: &Spanned<IgnoredAny>| newlines.line(table.span().start);
        for (row, table) in scene.streets.iter_mut().zip(&lines.street) {
            row.line = Aside(Some(line(table)));
        }
        for (row, table) in scene.things.iter_mut().zip(&lines.thing) {
            row.line = Aside(Some(line(table)));
        }
        for (row, table) in scene.says.iter_mut().zip(&lines.say) {
            row.line = Aside(Some(line(table)));
        }
        scene.origin = Aside(Origin {
            place: lines.place.as_ref().map(line),
            ground: lines.ground.as_ref().map(line),
            environment: lines.environment.as_ref().map(line),
            file,
        });
        Ok(scene)
    }

    /// The text of the file. Comments of a file that it was read from are gone.
    ///
    /// # Errors
    /// What TOML cannot say.
    pub fn to_toml(&self) -> Result<String, SceneFileError> {
        toml::to_string(self).map_err(|error| SceneFileError::Write { why: error.to_string() })
    }

    /// Writes the file: beside it first, and then in its place, so that one that is there is never half gone.
    ///
    /// # Errors
    /// What TOML cannot say, or a file that cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), SceneFileError> {
        let text = self.to_toml()?;
        let io = |error| SceneFileError::Io { path: path.display().to_string(), error };
        let mut beside = path.as_os_str().to_owned();
        beside.push(".part");
        std::fs::write(&beside, text).map_err(io)?;
        std::fs::rename(&beside, path).map_err(io)
    }

    /// A place in the file.
    pub(super) fn place_of(&self, line: Option<usize>, row: impl Into<String>) -> Where {
        Where { file: self.origin.0.file.clone(), line, row: row.into() }
    }
}

/// What the reader of TOML says, and what to do about it where that is not in it.
fn with_remedy(message: &str) -> String {
    let remedy = if message.starts_with("missing field") {
        ": write it, docs/scenes.md has every key"
    } else if message.starts_with("unknown field") {
        ": take it out, or write the one that is meant"
    } else if message.starts_with("invalid") {
        ": docs/scenes.md says what it takes"
    } else {
        ""
    };
    format!("{message}{remedy}")
}

/// Where the lines of a text end.
struct Newlines(Vec<usize>);

impl Newlines {
    fn of(text: &str) -> Self {
        Self(text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at).collect())
    }

    /// The line on which a byte stands, from 1.
    fn line(&self, at: usize) -> usize {
        1 + self.0.partition_point(|newline| *newline < at)
    }
}
