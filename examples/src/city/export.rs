//! The files of a city, each whole or absent.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use simworld_citygen::City;
use simworld_citygen::files::atomic;
use simworld_citygen::files::gltf::GltfError;
use simworld_citygen::files::save::SaveError;
use simworld_citygen::map::{PngError, render_png};
use thiserror::Error;

/// Asked from outside to stop: what is being written is then left out.
#[derive(Clone, Debug, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Asks to stop.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether somebody asked.
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// A file that a city can be written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Format {
    /// The map, to print.
    Svg,
    /// The map, to look at.
    Png,
    /// The city in 3D.
    Glb,
    /// The city without loss, for `--city`.
    Saved,
    /// For geographic programs.
    GeoJson,
    /// The roads for SUMO.
    Sumo,
    /// The roads for driving simulators.
    OpenDrive,
    /// The layout of the Python release.
    Python,
}

impl Format {
    /// All of them, in the order in which they are written.
    pub const ALL: [Self; 8] = [
        Self::Svg,
        Self::Png,
        Self::Glb,
        Self::Saved,
        Self::GeoJson,
        Self::Sumo,
        Self::OpenDrive,
        Self::Python,
    ];

    /// The files, in the folder of the city.
    pub const fn files(self) -> &'static [&'static str] {
        match self {
            Self::Svg => &["map.svg"],
            Self::Png => &["map.png"],
            Self::Glb => &["city.glb"],
            Self::Saved => &["city.simcity"],
            Self::GeoJson => &["city.geojson"],
            Self::Sumo => &["city.net.xml"],
            Self::OpenDrive => &["city.xodr"],
            Self::Python => &[
                "python/roads.json",
                "python/buildings.json",
                "python/elements.json",
                "python/progen_world.json",
            ],
        }
    }
}

/// A file that was written.
#[derive(Clone, Debug)]
pub struct Written {
    /// Where.
    pub path: PathBuf,
    /// Its size.
    pub bytes: u64,
}

/// Why a file was not written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// Somebody asked to stop.
    #[error("interrupted; {path} was not written")]
    Interrupted {
        /// The file that was to be written.
        path: PathBuf,
    },
    /// The folder or file cannot be written.
    #[error("{path}: {source}")]
    Write {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The city does not fit the format.
    #[error("{path}: {source}")]
    Format {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}

/// Writes a city in one format, with that map, and says which files it took.
///
/// # Errors
/// A file that cannot be written, or somebody asked to stop.
pub fn export(
    city: &City,
    format: Format,
    map: &str,
    png_width: u32,
    folder: &Path,
    interrupt: &Interrupt,
) -> Result<Vec<Written>, ExportError> {
    let mut written = Vec::new();
    for name in format.files() {
        let path = folder.join(name);
        let result = atomic::write(&path, |file| {
            let mut out = Guarded { inner: file, interrupt };
            fill(city, name, map, png_width, &mut out)?;
            // The last word before the file takes its place.
            out.flush().map_err(Fault::Io)
        });
        match result {
            Err(_) if interrupt.is_asked() => return Err(ExportError::Interrupted { path }),
            Err(Fault::Io(source)) => return Err(ExportError::Write { path, source }),
            Err(Fault::Format(source)) => return Err(ExportError::Format { path, source }),
            Ok(()) => {}
        }
        let bytes = std::fs::metadata(&path)
            .map_err(|source| ExportError::Write { path: path.clone(), source })?
            .len();
        written.push(Written { path, bytes });
    }
    Ok(written)
}

fn fill(city: &City, name: &str, map: &str, png_width: u32, out: &mut impl Write) -> Result<(), Fault> {
    match name {
        "map.svg" => out.write_all(map.as_bytes())?,
        "map.png" => out.write_all(&render_png(map, png_width)?)?,
        "city.glb" => city.write_glb(out)?,
        "city.simcity" => city.write_to(out)?,
        "city.geojson" => city.write_geojson(out)?,
        "city.net.xml" => city.write_sumo(out)?,
        "city.xodr" => city.write_opendrive(out)?,
        "python/roads.json" => json(out, &city.roads_file())?,
        "python/buildings.json" => json(out, &city.buildings_file())?,
        "python/elements.json" => json(out, &city.elements_file())?,
        _ => json(out, &city.world_file())?,
    }
    Ok(())
}

fn json<T: serde::Serialize>(out: &mut impl Write, file: &T) -> Result<(), Fault> {
    Ok(out.write_all(simworld_citygen::python::write(file).as_bytes())?)
}

/// A writer that fails once somebody asked to stop.
struct Guarded<'a, W> {
    inner: &'a mut W,
    interrupt: &'a Interrupt,
}

impl<W: Write> Guarded<'_, W> {
    fn check(&self) -> io::Result<()> {
        // Not `Interrupted`: that kind means to try again.
        if self.interrupt.is_asked() { Err(io::Error::other("interrupted")) } else { Ok(()) }
    }
}

impl<W: Write> Write for Guarded<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.check()?;
        self.inner.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.check()?;
        self.inner.flush()
    }
}

enum Fault {
    Io(io::Error),
    Format(Box<dyn std::error::Error + Send + Sync>),
}

impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl From<PngError> for Fault {
    fn from(error: PngError) -> Self {
        Self::Format(error.into())
    }
}

impl From<GltfError> for Fault {
    fn from(error: GltfError) -> Self {
        match error {
            GltfError::Io(error) => Self::Io(error),
            other => Self::Format(other.into()),
        }
    }
}

impl From<SaveError> for Fault {
    fn from(error: SaveError) -> Self {
        match error {
            SaveError::Io(error) => Self::Io(error),
            other => Self::Format(other.into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use simworld_citygen::CityConfig;
    use simworld_core::seed::Seed;

    use super::*;

    #[test]
    fn every_format_leaves_its_files() {
        let folder = tempfile::tempdir().unwrap();
        let city = City::generate(&CityConfig::with_roads(4), Seed(1)).unwrap();
        assert_eq!(Format::ALL.len(), Format::Python as usize + 1, "every format is among all");
        let mut contents = Vec::new();
        for format in Format::ALL {
            let written =
                export(&city, format, &city.svg(), 64, folder.path(), &Interrupt::default()).unwrap();
            assert_eq!(written.len(), format.files().len());
            contents.extend(written.iter().map(|file| std::fs::read(&file.path).unwrap()));
        }
        assert!(contents.iter().all(|bytes| !bytes.is_empty()));
        contents.sort();
        let files = contents.len();
        contents.dedup();
        assert_eq!(contents.len(), files, "no two files are the same");
    }

    #[test]
    fn an_interrupted_export_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let city = City::generate(&CityConfig::with_roads(4), Seed(1)).unwrap();
        let interrupt = Interrupt::default();
        interrupt.ask();
        for format in Format::ALL {
            let error = export(&city, format, &city.svg(), 64, folder.path(), &interrupt).unwrap_err();
            assert!(matches!(error, ExportError::Interrupted { .. }));
        }
        let left: Vec<_> = walk(folder.path());
        assert!(left.is_empty(), "{left:?}");
    }

    fn walk(folder: &Path) -> Vec<PathBuf> {
        let entries =
            std::fs::read_dir(folder).expect("it is there").map(|entry| entry.expect("readable").path());
        entries.flat_map(|path| if path.is_dir() { walk(&path) } else { vec![path] }).collect()
    }
}
